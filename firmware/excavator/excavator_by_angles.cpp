// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "firmware/excavator/excavator_controller.hpp"
#include "firmware/excavator/inputs/measured_joints.hpp"

namespace graben {

ExcavatorValid ExcavatorController::read_by_angles(const ExcavatorInputs& inputs, TimeUs now_us) {
  std::array<Signal<double>, kAxisCount> joint_rad = inputs.joint_rad;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    joint_rad[axis] =
        foretold(inputs.joint_rad[axis], profile_.bus.joint_latency_s, memory_.foretold[axis]);
  }
  const std::array<Signal<double>, kAxisCount> strokes_m =
      strokes_of_joints(setup_.kinematics.planar(), joint_rad);
  memory_.joints = {};
  memory_.joints.known = true;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    memory_.joints.known = memory_.joints.known && strokes_m[axis].validity == Validity::kValid;
    memory_.joints.joint[axis].angle_rad = joint_rad[axis].value;
    memory_.joints.stroke_m[axis] = strokes_m[axis].value;
  }
  return validate(profile_, drives(), inputs, memory_.last.moving, now_us, memory_.accepted,
                  strokes_m);
}

}  // namespace graben
