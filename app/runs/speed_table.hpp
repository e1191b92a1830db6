// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What bounding the speed is worth: design by design, against the fastest constant speed.

#include <optional>
#include <string>
#include <vector>

#include "app/runs/fastest_speed.hpp"
#include "app/runs/scenarios.hpp"

namespace graben::runs {

struct SpeedRow {
  std::string design;
  std::string refused;  ///< Why it can't be made; empty: it can.
  GradeEnd end = GradeEnd::kDone;
  GradeSummary bounded;
  std::optional<SpeedTrial> same_error;  ///< Fastest constant speed with no more than its error.
  std::optional<SpeedTrial> tolerance;   ///< And with no more than the task allows.
};

/// Sample designs on this machine, in the scenario but for its speed mode. `most` of them, from the
/// first.
[[nodiscard]] std::vector<SpeedRow> compare_speeds(const machines::SimulatedDozer& machine,
                                                   const GradeScenario& scenario,
                                                   std::uint64_t seed, std::size_t most,
                                                   const Progress& progress);

/// One table, and below it what the simulated machine has and does not have there.
[[nodiscard]] std::string speed_table(const std::vector<SpeedRow>& rows,
                                      const GradeScenario& scenario, double tolerance_m);

}  // namespace graben::runs
