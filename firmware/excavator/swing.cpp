// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/swing.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/tuning.hpp"

namespace graben {
namespace {

/// Angle as far as which the swing is sensed, either way. [rad; standard: range of SwingAngle in
/// excavator.dbc]
constexpr double kSensedMost_rad = 3.2;

}  // namespace

DriveVector travel_of(const ExcavatorProfile& profile, const DriveVector& drives) {
  return with_swing(drives, swing_of(drives) * (profile.has_swing() ? profile.swing.lever_m : 0.0));
}

DriveVector drives_of(const ExcavatorProfile& profile, const DriveVector& travel_m) {
  return with_swing(travel_m,
                    profile.has_swing() ? swing_of(travel_m) / profile.swing.lever_m : 0.0);
}

DriveRow swing_row(const ExcavatorProfile& profile) {
  const SwingProfile& swing = profile.swing;
  const double lever_m = swing.lever_m;
  DriveRow row = section_row(profile, kSwing);
  row.least_travel_m = swing.right_end_rad * lever_m;
  row.most_travel_m = swing.left_end_rad * lever_m;
  row.extend_area_m2 = swing.area_m2();
  row.retract_area_m2 = swing.area_m2();
  row.control.end_slack_m = kSwingEndSlack_rad * lever_m;
  row.control.deceleration_mps2 = swing.acceleration_max_radps2 * lever_m;
  row.control.at_end = {LimitKind::kSwingEnd, 0};
  row.control.has_end_stops = false;
  row.control.holds_itself = true;
  if (profile.control.law != ControlLaw::kKim) {
    row.feedback.gain_ps = profile.control.swing_servo_gain_ps;
  }
  row.feedback.plan_most_m =
      std::min(row.feedback.error_most_m, profile.control.swing_servo_most_rad * lever_m);
  row.watch.fastest_mps =
      std::min(fastest_mps(profile, row), kFasterThanPumps * swing.speed_max_radps * lever_m);
  row.watch.jump_margin_m = kSwingJumpMargin_rad * lever_m;
  row.watch.sensed_least_m = -(kSensedMost_rad * lever_m);
  row.watch.sensed_most_m = kSensedMost_rad * lever_m;
  row.watch.uncommanded_m = profile.safety.swing_uncommanded_rad * lever_m;
  row.watch.rest_m = kSwingRest_rad * lever_m;
  row.watch.brakes_s = 0.5 * swing.speed_max_radps / swing.acceleration_max_radps2;
  row.watch.wrong_m = kSwingWrong_rad * lever_m;
  row.watch.stuck_m = profile.safety.swing_stuck_rad * lever_m;
  row.watch.unseen_m = kSwingUnseen_rad * lever_m;
  row.watch.off_m = kSwingOff_rad * lever_m;
  row.watch.still_mps = kSwingStill_radps * lever_m;
  row.watch.leak_mpspa =
      kSwingLeakShare * swing.speed_max_radps * lever_m / row.watch.pressure_rail_pa;
  // A platform at full speed goes on turning against its reliefs when its spool closes at once.
  row.watch.rest_s = rest_s(row) + swing.speed_max_radps / swing.acceleration_max_radps2;
  return row;
}

DriveInputs swing_inputs(const SwingInputs& swing, const SwingProfile& profile) {
  DriveInputs inputs = {swing.angle_rad, swing.left_pressure_pa, swing.right_pressure_pa,
                        swing.spool_ratio};
  inputs.stroke_m.value *= profile.lever_m;
  return inputs;
}

double swing_lead_mps(const ExcavatorProfile& profile, double wanted_mps, double last_wanted_mps,
                      double period_s) {
  if (!profile.has_swing() || !(period_s > 0.0)) {
    return 0.0;
  }
  const double most_mps2 = profile.swing.acceleration_max_radps2 * profile.swing.lever_m;
  const double change_mps2 = (wanted_mps - last_wanted_mps) / period_s;
  return profile.control.swing_lead_s * std::clamp(change_mps2, -most_mps2, most_mps2);
}

void next_swing_push(const ValidDrive& swing, double period_s, SwingPush& push) {
  if (!swing.load_known) {
    push.known = false;
    push.unseen_s += period_s;
    return;
  }
  const double now_pa = swing.cap_pressure_pa - swing.rod_pressure_pa;
  if (!push.known) {
    push = {true, now_pa, push.unseen_s < kSwingPushSlow_s ? push.slow_pa : now_pa, 0.0};
  }
  push.fast_pa += period_s / (period_s + kSwingPushFast_s) * (now_pa - push.fast_pa);
  push.slow_pa += period_s / (period_s + kSwingPushSlow_s) * (now_pa - push.slow_pa);
}

double swing_damping_mps(const ExcavatorProfile& profile, const SwingPush& push) {
  const SwingProfile& swing = profile.swing;
  if (!profile.has_swing() || !push.known || !(swing.inertia_kgm2 > 0.0)) {
    return 0.0;
  }
  const double most_radps2 = kSwingDampsMost * swing.acceleration_max_radps2;
  const double push_pa = push.fast_pa - push.slow_pa;
  const double beyond_pa =
      std::copysign(std::max(0.0, std::abs(push_pa) - kSwingFriction_pa), push_pa);
  const double pushed_radps2 = swing.displacement_m3prad * beyond_pa / swing.inertia_kgm2;
  return -profile.control.swing_lead_s * swing.lever_m *
         std::clamp(pushed_radps2, -most_radps2, most_radps2);
}

double swing_speed_max_radps(const ExcavatorProfile& profile) {
  const double own_radps = profile.swing.speed_max_radps;
  return profile.has_swing() ? std::min(own_radps, most_flow_m3ps(profile, kSwing) /
                                                       profile.swing.displacement_m3prad)
                             : own_radps;
}

}  // namespace graben
