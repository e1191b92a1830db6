// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Commissioning of a simulated excavator, see led_commission.hpp.

#include <filesystem>

#include "app/commission/commission_sequence.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/runs/led_commission.hpp"

namespace graben::runs {

struct CommissionOptions {
  commission::SequenceOptions sequence;
  Eigen::Vector3d start_strokes_m = Eigen::Vector3d::Zero();
  std::filesystem::path log_file;  ///< candump log; none if empty.
};

[[nodiscard]] CommissionResult run_commission(const machines::SimulatedExcavator& machine,
                                              const CommissionOptions& options,
                                              const TakeFrame& take, const Progress& progress);

/// In the middle of all strokes.
[[nodiscard]] CommissionOptions usual_commission(const machines::SimulatedExcavator& machine);

}  // namespace graben::runs
