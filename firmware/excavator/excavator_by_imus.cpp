// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "firmware/excavator/excavator_controller.hpp"

namespace graben {
namespace {

/// No spool is open, as far as anybody knows: by where the spools are, or, where nobody says that,
/// by our own commands. What then moves a link moves it slowly.
bool is_still(const ExcavatorProfile& profile, const ExcavatorInputs& inputs, EcuMode last_mode) {
  if (!profile.bus.spool_feedback) {
    return last_mode != EcuMode::kActive;
  }
  bool still = true;
  for (const AxisInputs& axis : inputs.axis) {
    still = still && axis.spool_ratio.validity == Validity::kValid &&
            std::abs(axis.spool_ratio.value) <= profile.safety.spool_tolerance;
  }
  return still;
}

}  // namespace

ExcavatorValid ExcavatorController::read_by_imus(const ExcavatorInputs& inputs, const Cycle& cycle,
                                                 TimeUs now_us) {
  const ImuStrokes by_imus =
      next_imu_strokes(setup_.kinematics.planar(), profile_.imu, inputs,
                       is_still(profile_, inputs, cycle.last_mode), cycle.period_s, memory_.imus);
  memory_.joints = by_imus.joints;
  return validate(profile_, drives(), inputs, memory_.last.moving, now_us, memory_.accepted,
                  by_imus.stroke_m);
}

}  // namespace graben
