// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A dozer against ground that resists: every soil with every sample design at three engine speeds,
/// a cell each, so many draws a cell.

#include <cstdint>
#include <string>

#include "app/runs/campaign_run.hpp"

namespace graben::runs {

/// One of the soils with one of the designs at one engine speed.
struct GroundCell {
  std::string soil;
  std::size_t design = 0;  ///< Of sample_designs().
  double engine_rpm = 0.0;
};

/// Cell and draw of a campaign's seed, from 1 on: the cells change first, so that a campaign that
/// is broken off has tried all of them alike.
struct GroundDraw {
  GroundCell cell;
  std::uint64_t seed = 0;
};
[[nodiscard]] std::uint64_t ground_cells();
[[nodiscard]] GroundDraw ground_draw(std::uint64_t seed);

/// What a draw may leave and cost at most.
inline constexpr double kMostOverCut_m = 0.030;
inline constexpr double kMostLeft_m = 0.030;
inline constexpr double kMostHalt_s = 1.0;

[[nodiscard]] const CampaignKind& ground_kind();

/// Errors and soils drawn; `options.draws` counts seeds. Its table ends with a row for each soil
/// and design, the engine speeds together.
[[nodiscard]] CampaignOutcome campaign_ground(const CampaignOptions& options,
                                              const machines::SimulatedDozer& nominal,
                                              const Progress& progress);

}  // namespace graben::runs
