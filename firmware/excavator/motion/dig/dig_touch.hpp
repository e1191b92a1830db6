// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the bucket's floor is set down to find the ground, see TouchPhase.

#include "firmware/excavator/motion/program/task_run.hpp"

namespace graben {

/// Where along the line, 0 .. 1, the machine can set its bucket's floor on the ground; -1: nowhere.
[[nodiscard]] double touch_share(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                                 const TaskProgram& program);

/// The bucket with its floor level, so high over the ground as the task says it is.
[[nodiscard]] TeethPose touch_pose(const SwingKinematics& kinematics, const TaskProgram& program,
                                   int strip, double height_m);
/// The same as it begins, at a strip.
[[nodiscard]] TeethPose first_touch_pose(const SwingKinematics& kinematics,
                                         const TaskProgram& program, int strip);

[[nodiscard]] TaskAim aim_of_touch(const SwingKinematics& kinematics, const TaskProgram& program,
                                   const TaskState& state);

}  // namespace graben
