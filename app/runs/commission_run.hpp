// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Commissioning of a simulated excavator over a bus in memory: the sequence of app/commission at
/// the operator's station, the controller's guard, the plant. Nothing but frames between them.

#include <filesystem>
#include <optional>
#include <vector>

#include "app/commission/commission_sequence.hpp"
#include "app/identify/machine/machine_log.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/runs/logged_run.hpp"

namespace graben::runs {

struct CommissionOptions {
  commission::SequenceOptions sequence;
  Eigen::Vector3d start_strokes_m = Eigen::Vector3d::Zero();
  std::filesystem::path log_file;  ///< candump log; none if empty.
};

enum class CommissionEnd { kDone, kFault, kWrongWay, kTooLong };

struct CommissionResult {
  CommissionEnd end = CommissionEnd::kDone;
  Fault fault = Fault::kNone;                 ///< With kFault.
  std::optional<commission::WrongWay> wrong;  ///< With kWrongWay.
  std::size_t step = 0;                       ///< It came to.
  double machine_s = 0.0;  ///< In which the machine moved or waited for the next step.
  std::vector<commission::StepResult> steps;
};

/// Longest that it may take, s.
inline constexpr double kCommissionMost_s = 600.0;

/// Each frame of the bus goes to `take` as well, if it is not empty.
[[nodiscard]] CommissionResult run_commission(
    const machines::SimulatedExcavator& machine, const CommissionOptions& options,
    const std::function<void(const identify::LoggedFrame&)>& take, const Progress& progress);

/// In the middle of all strokes.
[[nodiscard]] CommissionOptions usual_commission(const machines::SimulatedExcavator& machine);

}  // namespace graben::runs
