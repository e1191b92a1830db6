// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Programs are executed step by step (step_run.hpp) or dug in layers (dig_run.hpp): here one is
/// asked for without knowing which.

#include "firmware/excavator/motion/dig/dig_cycle.hpp"

namespace graben {

/// Where the plan is now.
[[nodiscard]] TaskAim task_aim(const SwingKinematics& kinematics, const TaskProgram& program,
                               const TaskState& state);

/// One cycle on, as task_advance() has it.
void execute(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
             const TaskProgram& program, double advance_s, double period_s, const CutSeen& seen,
             TaskState& state);

}  // namespace graben
