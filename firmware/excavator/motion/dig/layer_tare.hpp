// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The empty bucket is raised and the arm reached out once, before it first goes back: friction
/// that way is only told from a load by the same motion without one.

#include "firmware/excavator/motion/program/task_run.hpp"

namespace graben {

/// A part that gets on more slowly is let be: it has told what it can.
inline constexpr double kTaresMost_s = 4.0;

/// The step is the first return from where a bucket that was weighed has been emptied.
[[nodiscard]] bool tares_next(const TaskProgram& program, int step, const LayerState& layers);

/// At the step's pace, from these drives: the boom up and the arm in; then the arm out again.
[[nodiscard]] DrivePlan tare_move(const ExcavatorProfile& profile, const TaskStep& step,
                                  TarePart part, const DriveVector& from);

}  // namespace graben
