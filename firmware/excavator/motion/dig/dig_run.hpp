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

/// How a dig that was paused goes on at once, where that is safe, from where the machine stands.
struct DigResume {
  bool can = false;        ///< Else it comes back by an approach, with an empty bucket.
  bool in_ground = false;  ///< Out of it, then to where the bucket is emptied.
  double share = 0.0;      ///< Of the strip's line, where the teeth are.
  TeethPose teeth;
};

/// Looks for it. Where there is none, the bucket counts as empty from now on.
[[nodiscard]] DigResume way_to_resume(const SwingKinematics& kinematics, const TaskProgram& program,
                                      const DriveVector& drives_now, TaskState& state);

/// Goes on by a way that can be gone: in the ground as told there; a loaded bucket in the air, to
/// the end of its step.
void dig_resume(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                const TaskProgram& program, const DriveVector& drives_now, const CutSeen& seen,
                const DigResume& way, TaskState& state);

/// How fast a plan in layers goes on while the teeth are behind it: `state.pace_ratio` a cycle on.
/// The sooner the nearer they are to the design: half at one slow_error, a fifth at two.
void follow_pace(const DigCycle& cycle, TaskState& state);

}  // namespace graben
