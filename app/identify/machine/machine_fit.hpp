// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine from its logs, all parts together.

#include <functional>
#include <string>
#include <vector>

#include "app/identify/machine/drive_model.hpp"
#include "app/identify/machine/estimate.hpp"
#include "app/identify/machine/machine_log.hpp"

namespace graben::identify {

/// Share of the work done, 0 .. 1, and what is being done.
using MachineProgress = std::function<void(double share, const std::string& what)>;

/// What the profile says, before any log: nothing is `known`.
[[nodiscard]] MachineEstimate estimate_of(const DriveModel& model);

/// Fits what the logs support; the rest keeps the profile's values and is named in `missing`.
/// Throws std::runtime_error where nothing moves.
[[nodiscard]] MachineEstimate identify_machine(const DriveModel& model,
                                               const std::vector<MachineLog>& logs,
                                               const MachineProgress& progress);

}  // namespace graben::identify
