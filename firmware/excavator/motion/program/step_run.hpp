// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Executes a program of steps: how it goes on from step to step and from round to round, and what
/// ends a step before its planned end.

#include "firmware/excavator/motion/dig/dig_cycle.hpp"

namespace graben {

/// As task_advance() has it, of a program that is not in layers. A step that `until` ends comes to
/// rest on its line, kStepBrakes times as fast as its pace changes otherwise; the next one leads on
/// from where the teeth are then.
void steps_advance(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                   const TaskProgram& program, double advance_s, double period_s,
                   const CutSeen& seen, TaskState& state);

}  // namespace graben
