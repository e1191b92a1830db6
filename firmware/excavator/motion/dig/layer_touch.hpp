// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Finds the ground before a dig in layers: the bucket's floor is set down on it, flat, and what
/// the sensors then say of its height is where heights are counted from. Zeros of stroke sensors
/// put the edge centimetres off in the same way all over a task's small area; so they drop out.

#include "firmware/excavator/motion/dig/layer_run.hpp"

namespace graben {

/// Where along the line, 0 .. 1, the machine can set its bucket's floor on the ground; -1: nowhere.
[[nodiscard]] double touch_share(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                                 const TaskProgram& program);

/// True while the ground has yet to be found.
[[nodiscard]] bool touches_next(const TaskProgram& program, const TaskState& state);

/// The bucket with its floor level, so high over the ground as the task says it is.
[[nodiscard]] TeethPose touch_pose(const SwingKinematics& kinematics, const TaskProgram& program,
                                   int strip, double height_m);
/// The same as it begins, at a strip.
[[nodiscard]] TeethPose first_touch_pose(const SwingKinematics& kinematics,
                                         const TaskProgram& program, int strip);

void begin_touch(TaskState& state);

/// A cycle on: down until the ground bears the bucket, then up again. True: it is up again, and
/// `layers.zero_m` is known, or 0 where there was no ground within 50 mm of where the task has it.
[[nodiscard]] bool touch_on(const TaskProgram& program, const CutSeen& seen, double advance_s,
                            double period_s, TaskState& state);

[[nodiscard]] TaskAim aim_of_touch(const SwingKinematics& kinematics, const TaskProgram& program,
                                   const TaskState& state);

}  // namespace graben
