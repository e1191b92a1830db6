// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far the machine goes on after a stop from outside (app/runs/stopping_run.hpp), as `graben
/// check` says it.

#include <vector>

#include "app/reports/check/machine_check.hpp"
#include "app/runs/stopping_run.hpp"

namespace graben::reports {

[[nodiscard]] FactTable stop_table(const std::vector<runs::Stopping>& stops);

/// One for each motion and load that at any of its speeds goes on for more than `within_m`, with
/// the speed up to which it does not.
[[nodiscard]] std::vector<Warning> stop_warnings(const std::vector<runs::Stopping>& stops,
                                                 double within_m);

}  // namespace graben::reports
