// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/executor.hpp"

#include "firmware/excavator/motion/dig/dig_run.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/program/step_run.hpp"

namespace graben {

TaskAim task_aim(const SwingKinematics& kinematics, const TaskProgram& program,
                 const TaskState& state) {
  return in_layers(program) && state.phase == TaskPhase::kSteps
             ? layer_aim(kinematics, program, state)
             : aim_of_steps(kinematics, program, state);
}

void execute(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
             const TaskProgram& program, double advance_s, double period_s, const CutSeen& seen,
             TaskState& state) {
  if (in_layers(program)) {
    dig_advance(profile, kinematics, program, advance_s, period_s, seen, state);
  } else {
    steps_advance(profile, kinematics, program, advance_s, period_s, seen, state);
  }
}

}  // namespace graben
