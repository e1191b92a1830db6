// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The fastest constant speed at which the grade still comes out within a bound.

#include <optional>
#include <vector>

#include "app/runs/grade_run.hpp"

namespace graben::runs {

struct SpeedTrial {
  double speed_mps = 0.0;
  GradeEnd end = GradeEnd::kDone;
  GradeSummary summary;

  [[nodiscard]] bool within(double most_m) const {
    return end == GradeEnd::kDone && summary.max_error_true_m <= most_m;
  }
};

struct FastestSpeed {
  std::vector<SpeedTrial> trials;   ///< In the order of their speeds, the slowest first.
  std::optional<SpeedTrial> found;  ///< None where not even the slowest is within.
};

inline constexpr double kSlowestTrial_mps = 0.05;
inline constexpr double kCoarseTrial_mps = 0.1;
inline constexpr double kFineTrial_mps = 0.01;

/// Whole multiples of kFineTrial_mps, up to that of the machine's profile, which should have the
/// constant policy. The error need not rise with the speed: so every kCoarseTrial_mps from the
/// fastest down until one is within `most_m`, then every kFineTrial_mps from the one above it
/// down.
[[nodiscard]] FastestSpeed find_fastest(const machines::SimulatedDozer& machine, double most_m,
                                        const Progress& progress);

/// A line for each trial.
[[nodiscard]] std::string fastest_table(const FastestSpeed& result, double most_m);

}  // namespace graben::runs
