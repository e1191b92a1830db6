// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the teeth are to be in a program that digs in layers: on a cut, into it and out of it.

#include "firmware/excavator/motion/program/task_run.hpp"

namespace graben {

[[nodiscard]] inline bool in_layers(const TaskProgram& program) { return program.layers.step >= 0; }

/// The line that the edge follows now: the step's, over its layer and at its strip.
[[nodiscard]] TeethLine cut_line(const TaskProgram& program, const TaskState& state);

/// As task_aim() has it, of a step of a program in layers.
[[nodiscard]] TaskAim layer_aim(const SwingKinematics& kinematics, const TaskProgram& program,
                                const TaskState& state);

/// Where a dig begins: over the ground that is felt for, or else where the first cut begins, as
/// steep as the machine can be there.
[[nodiscard]] TeethPose first_dig_pose(const SwingKinematics& kinematics,
                                       const TaskProgram& program);

/// The way back that teeth which soil holds have come into the ground; without a way where they are
/// not near it any more, or the machine can't take it.
[[nodiscard]] LinePlan way_back(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                                const LayerPlan& plan, const TeethPose& from,
                                const TeethPose& entered);

/// The way of teeth that have ended a cut here: first the bucket is folded in while its edge still
/// stands before soil, which keeps the fill in; then it is lifted out of the ground. Without a way
/// where the machine can't lift it. Not in a cycle: there a lift tries one line each (lift_try()).
[[nodiscard]] LinePlan lift_line(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                                 const LayerPlan& plan, const TeethPose& from, LiftPart part);

/// How many ways a lift tries, of less and less height, and less and less turned. [-; derived:
/// kLiftUps, kLiftTurns]
inline constexpr unsigned kLiftTries = 12;

/// The `n`th of them, 0 .. kLiftTries - 1; without a way where the machine can't take it.
[[nodiscard]] LinePlan lift_try(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                                const LayerPlan& plan, const TeethPose& from, LiftPart part,
                                unsigned n);

/// Teeth on a cut, so high over the line; the bucket stands steep as it goes into uncut ground,
/// its floor along its way, and is turned to the line's attitude on the first half metre.
[[nodiscard]] TeethPose cut_pose(const TaskProgram& program, const Cut& cut, double share,
                                 double height_m);

/// Share of the steep attitude that the machine can have where a cut begins.
[[nodiscard]] double steepest(const SwingKinematics& kinematics, const TaskProgram& program,
                              Cut cut);

/// A sweep begins before its line, as far as the machine can: there the wall falls in. Not where
/// the task has fences besides its design, the last of them.
void begin_beyond(const SwingKinematics& kinematics, const TaskProgram& program, Cut& cut);

/// The step's line at a strip, so high over itself.
[[nodiscard]] TeethLine line_over(const TaskProgram& program, int strip, double height_m);

/// True while the layered step runs.
[[nodiscard]] bool at_cut(const TaskProgram& program, const TaskState& state);

/// Swing of a strip, from the line's own.
[[nodiscard]] double strip_rad(const LayerPlan& plan, int strip);

/// About the swing axis, to the left.
[[nodiscard]] Eigen::Vector3d turned(const Eigen::Vector3d& at, double angle_rad);

/// How much steeper than the line's attitude a cut begins.
[[nodiscard]] double steep_rad(const TaskProgram& program, const Cut& cut);

/// Share of that which is left at this place of the line, and its change by the line's share.
[[nodiscard]] Progress steepness(const TaskProgram& program, const Cut& cut, double share);

/// On the first part of a cut the bucket is coming to its attitude.
[[nodiscard]] bool turns(const TaskProgram& program, const TaskState& state);

/// A cut's speed: that of the plan, less while the bucket turns, and on the design itself, where
/// its force is to be small.
[[nodiscard]] double most_rate_ps(const TaskProgram& program, const TaskState& state);

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
