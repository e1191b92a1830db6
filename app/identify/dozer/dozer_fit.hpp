// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A dozer from its logs, the profile that comes of it, and how well that predicts.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "app/identify/dozer/dozer_estimate.hpp"
#include "app/identify/dozer/dozer_log.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::identify {

/// Throws std::runtime_error where nothing in the logs moves.
[[nodiscard]] DozerEstimate identify_dozer(const DozerProfile& profile,
                                           const std::vector<DozerLog>& logs);

/// `profile` with all that was found; what was not stays.
[[nodiscard]] DozerProfile identified_dozer(const DozerProfile& profile,
                                            const DozerEstimate& found);

/// Openings of the tables that are made.
inline constexpr std::array<double, 12> kBladeOpenings = {0.0,  0.02, 0.05, 0.09, 0.15, 0.23,
                                                          0.33, 0.45, 0.58, 0.72, 0.86, 1.0};

/// Of a drive's measured speed while it moves, what a profile's prediction by the duties is off,
/// RMS over the speed's own; of lift, tilt, tracks. Below 0: it did not move.
using DozerScore = std::array<double, 3>;
[[nodiscard]] DozerScore score_dozer(const DozerProfile& profile,
                                     const std::vector<DozerLog>& logs);

/// Speed that a profile makes of a duty that stands, m/s: of lift (0) or tilt (1).
[[nodiscard]] double steady_blade_mps(const DozerProfile& profile, std::size_t drive, double duty,
                                      double engine_radps);

/// A line for each thing that was found but has no key: each track by itself, slip, the motors,
/// the lines' pressure.
[[nodiscard]] std::vector<std::string> dozer_sentences(const DozerEstimate& found);

}  // namespace graben::identify
