// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The empty bucket is raised once, before it first goes back: friction upwards is only told from a
/// load by a lift without one.

#include "firmware/excavator/tasks/task_run.hpp"

namespace graben {

/// A boom that gets on more slowly is let be: it has told what it can.
inline constexpr double kTaresMost_s = 4.0;

/// The step is the first return from where a bucket that was weighed has been emptied.
[[nodiscard]] bool tares_next(const TaskProgram& program, int step, const LayerState& layers);

/// By the boom alone, at the step's pace, from these drives.
[[nodiscard]] DrivePlan tare_move(const ExcavatorProfile& profile, const TaskStep& step,
                                  const DriveVector& from);

}  // namespace graben
