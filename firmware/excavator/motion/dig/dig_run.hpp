// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Executes a program whose dig step is done in layers: each round the step is another cut, and the
/// moves round it are planned from where the last one ended to where the next one begins.

#include "firmware/excavator/motion/dig/dig_cycle.hpp"

namespace graben {

/// As task_advance() has it, of a program in layers. Ends where no soil is left over the design.
void dig_advance(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                 const TaskProgram& program, double advance_s, double period_s, const CutSeen& seen,
                 TaskState& state);

/// A dig that was paused goes on at once where that is safe, from where the machine stands: out of
/// the ground, then to where the bucket is emptied; a loaded bucket in the air, to the end of its
/// step. False: it comes back by an approach, with an empty bucket.
[[nodiscard]] bool dig_resume(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                              const TaskProgram& program, const DriveVector& drives_now,
                              const CutSeen& seen, TaskState& state);

/// How fast a plan in layers goes on while the teeth are behind it: `state.pace_ratio` a cycle on.
/// The sooner the nearer they are to the design: half at one slow_error, a fifth at two.
void follow_pace(const DigCycle& cycle, TaskState& state);

}  // namespace graben
