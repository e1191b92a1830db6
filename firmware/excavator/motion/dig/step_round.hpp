// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Steps as they are in a later round of a program, whose digs each round lays an offset farther,
/// and steps that begin elsewhere than where they were planned to.

#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben {

/// Most rounds of a program. [-; size: rounds that planning walks]
inline constexpr int kRoundsMost = 50;

/// Where a round has what a dig begins or ends with: `offset_m` farther with each round from 0 on,
/// and straight up to the design's clearance where it would be lower.
[[nodiscard]] Eigen::Vector3d place_in_round_m(const RoundsPlan& rounds,
                                               const Eigen::Vector3d& at_m, int round);

/// A step as it is in a round; `blind` where the machine can't be at one of its ends.
struct RoundStep {
  BlindPlace blind;
  TaskStep step;
};

/// The last step ends where the next round begins, `next_round`; the same number: there is none. A
/// few poses. A line's pace is that of the program's step, as far as it is longer slower.
[[nodiscard]] RoundStep step_in_round(const ExcavatorProfile& profile,
                                      const SwingKinematics& kinematics, const TaskProgram& program,
                                      int number, int round, int next_round);

/// The step to the same end from elsewhere: a line from `from`, at the step's speed, or where the
/// machine can't follow it a move of the drives, from `drives`, where it was planned to be.
[[nodiscard]] TaskStep step_from(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                                 const TaskStep& step, const TeethPose& from,
                                 const DriveVector& drives);

/// Checks and completes a program whose steps are planned for the first round: which ends a round
/// moves, how often it is done, and every later round as a whole, slowed where a drive's limit asks
/// for it. True, or the result has the refusal. Not for a control cycle.
[[nodiscard]] bool plan_rounds(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                               const ProgramRequest& request, ProgramResult& result);

/// Checks what follows steps that may end early: the step after each, from places all along its
/// line, in the first round and the last. True, or the result has the refusal.
[[nodiscard]] bool plan_early_ends(const ExcavatorProfile& profile,
                                   const SwingKinematics& kinematics, ProgramResult& result);

}  // namespace graben
