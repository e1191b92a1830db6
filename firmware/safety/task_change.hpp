// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A change of task in motion passes standstill: what was begun is let go, the machine comes to
/// rest, and only then does the next task begin.

#include <array>

#include "firmware/core/span.hpp"
#include "firmware/machine/drive_bank.hpp"
#include "firmware/signals/machine_signals.hpp"

namespace graben {

/// A task as the operator asks for it.
struct TaskChoice {
  Task task = Task::kNone;
  int number = -1;  ///< Of Task::kProgram.

  [[nodiscard]] bool operator==(const TaskChoice& other) const;
};

/// State from cycle to cycle.
struct TaskChangeState {
  TaskChoice followed;   ///< That the machine works at; kNone: at none yet.
  TaskChoice asked;      ///< In the last cycle.
  bool waiting = false;  ///< For standstill.
  double still_s = 0.0;
  std::array<double, kMostDrives> still_m{};  ///< Where each drive has been since.
};

/// The task to be followed now: `asked`, or none while standstill is waited for. Once a task has
/// been followed in motion, any other one, none included, ends it; what is asked for after that
/// begins when every drive has stood still, and `at_rest` has held, for kStandstill_s in which the
/// same was asked for. Not `in_motion`, the first task begins at once: arming has looked at rest.
/// `travel_m` are the drives' measured travels.
[[nodiscard]] TaskChoice task_after_change(TaskChangeState& state, const TaskChoice& asked,
                                           bool in_motion, bool at_rest,
                                           Span<const double> travel_m, double period_s);

}  // namespace graben
