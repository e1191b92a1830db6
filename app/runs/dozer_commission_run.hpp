// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Commissioning of a simulated dozer over a bus in memory: the sequence of app/commission at the
/// operator's station, the controller's guard, the plant. Nothing but frames between them.

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "app/commission/dozer_sequence.hpp"
#include "app/identify/machine/candump_reader.hpp"
#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/runs/logged_run.hpp"

namespace graben::runs {

enum class DozerCommissionEnd { kDone, kFault, kWrongWay, kTooLong };

struct DozerCommissionResult {
  DozerCommissionEnd end = DozerCommissionEnd::kDone;
  Fault fault = Fault::kNone;                 ///< With kFault.
  std::optional<commission::WrongWay> wrong;  ///< With kWrongWay.
  std::size_t step = 0;                       ///< It came to.
  double machine_s = 0.0;  ///< In which the machine moved or waited for the next step.
  std::vector<commission::StepResult> steps;
};

/// `log_file`: candump log; none if empty. Each frame of the bus goes to `take` as well, if it is
/// not empty.
[[nodiscard]] DozerCommissionResult run_dozer_commission(
    const machines::SimulatedDozer& machine, const commission::DozerOptions& options,
    const std::filesystem::path& log_file,
    const std::function<void(const identify::LoggedFrame&)>& take, const Progress& progress);

}  // namespace graben::runs
