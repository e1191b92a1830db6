// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/excavator_drives.hpp"

#include <algorithm>

#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/excavator/swing.hpp"
#include "firmware/excavator/tuning.hpp"
#include "firmware/hydraulics/flow.hpp"

namespace graben {
namespace {

/// Slack before a cylinder's ends. [m; derived: half of the 0.1 mm that a stroke sensor resolves,
/// Kim et al. section 5]
constexpr double kEndSlack_m = 0.05e-3;

bool is_quick(const SpoolAnswer& answer) {
  return answer.dead_time_s <= kOilDeadTimeMost_s && answer.lag_s <= kOilLagMost_s &&
         answer.spool_time_constant_s <= kLedSpoolMost_s;
}

/// From a command to this side until the drive goes by it.
double answer_s(const DriveRow& row, double way) {
  const SpoolAnswer& answer = row.answer.towards(way);
  return answer.dead_time_s + answer.lag_s;
}

/// Way of the tip over each stroke in the middle of all, 1.
Eigen::Vector3d leverage(const ExcavatorProfile& profile) {
  Eigen::Vector3d strokes_m;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    strokes_m[axis] = 0.5 * profile.geometry.cylinder[static_cast<unsigned>(axis)].stroke_m;
  }
  const ExcavatorKinematics kinematics(profile.geometry);
  return kinematics.state(strokes_m).jacobian.topRows<2>().colwise().norm();
}

double said_or(double said_s, double whole_s) { return said_s == kUnsaid_s ? whole_s : said_s; }

/// Longest of each of the two lags of a spool's side that says it, else 0, s. What a drive's speed
/// lags its spool is within its oil and load as well, the spool's share is no more than that.
double slowest_lag_s(const SaidAnswer& said) {
  return said.spool_time_constant_s == kUnsaid_s ? 0.5 * std::max(0.0, said.lag_s)
                                                 : kTimeBand * said.spool_time_constant_s;
}

/// Enough for a side that is slower than the profile's slowest spool.
double settle_s(const ExcavatorProfile& profile, int drive) {
  const SaidAnswers& said = profile.valve.answer[static_cast<unsigned>(drive)];
  const double slowest_s = std::max(slowest_lag_s(said.extend), slowest_lag_s(said.retract));
  return std::max(profile.safety.settle_s, slowest_s / kLagShare);
}

const PumpProfile& pump_of(const ExcavatorProfile& profile, const SpoolProfile& spool) {
  return profile.pump[static_cast<unsigned>(spool.pump)];
}

DriveRow cylinder_row(const ExcavatorProfile& profile, int axis, double leverage) {
  const CylinderGeometry& cylinder = profile.geometry.cylinder[static_cast<unsigned>(axis)];
  DriveRow row = section_row(profile, axis);
  set_cylinder_range(cylinder.stroke_m, row);
  row.watch.rest_s = rest_s(row);
  if (!profile.bus.pressures) {
    row.feedback.gain_ps *= kGainWithoutPressures;
    row.feedback.frequency_hz *= kFrequencyWithoutPressures;
    row.feedback.damping *= kDampingWithoutPressures;
  }
  row.extend_area_m2 = cylinder.cap_area_m2();
  row.retract_area_m2 = cylinder.rod_area_m2();
  row.control.end_slack_m = kEndSlack_m;
  row.control.deceleration_mps2 =
      profile.line.cylinder_acceleration_mps2[static_cast<unsigned>(axis)];
  row.control.at_end = {LimitKind::kStrokeEnd, static_cast<std::uint8_t>(axis)};
  row.watch.fastest_mps = fastest_mps(profile, row);
  row.watch.uncommanded_m = profile.safety.uncommanded_m;
  row.watch.sink_mps = profile.safety.sink_mps;
  row.watch.wrong_m = kStrokeWrong_m;
  row.watch.stuck_m = profile.safety.stuck_m;
  row.watch.off_m = std::clamp(kStrokeOffTip_m / leverage, kStrokeOffLeast_m, kStrokeOffMost_m) +
                    (profile.foretells_joints() ? kForetoldShaken_m : 0.0);
  row.watch.unseen_m = kStrokeUnseenShare * row.watch.off_m;
  // Under an open bypass a drive stands until its line presses as hard as its load; where lambda is
  // fixed it falls behind when its pump gives too little.
  const bool follows = !row.spool.bypass_closes_at.is_gradual() &&
                       profile.control.lambda_policy != McvPolicy::kFixed;
  row.watch.way_m =
      follows ? std::clamp(kStrokeWayTip_m / leverage, kStrokeWayLeast_m, kStrokeWayMost_m) : 0.0;
  return row;
}

}  // namespace

SpoolAnswer answer_of(const ExcavatorProfile& profile, int drive, bool extends) {
  const ValveProfile& valve = profile.valve;
  const SaidAnswer& said = valve.answer[static_cast<unsigned>(drive)].side(extends);
  return {said.spool_to_duty.size() == 0 ? valve.spool_to_duty : said.spool_to_duty,
          said_or(said.dead_time_s, profile.control.dead_time_s),
          said_or(said.lag_s, profile.control.response_s),
          said_or(said.spool_time_constant_s, profile.oil.spool_time_constant_s)};
}

double fastest_mps(const ExcavatorProfile& profile, const DriveRow& row) {
  return kFasterThanPumps * rated_flow_m3ps(pump_of(profile, row.spool)) / row.retract_area_m2;
}

double most_flow_m3ps(const ExcavatorProfile& profile, int drive) {
  const SpoolProfile& spool = profile.valve.spool[static_cast<unsigned>(drive)];
  return std::min(profile.valve.section_flow_m3ps, rated_flow_m3ps(pump_of(profile, spool)));
}

DriveRow section_row(const ExcavatorProfile& profile, int drive) {
  const ControlProfile& control = profile.control;
  const SafetyProfile& safety = profile.safety;
  DriveRow row;
  row.spool = profile.valve.spool[static_cast<unsigned>(drive)];
  row.metering = static_cast<const SpoolMetering&>(profile.valve);
  row.answer.extend = answer_of(profile, drive, true);
  row.answer.retract = answer_of(profile, drive, false);
  row.control.spool_rate_ps = control.spool_rate_ps;
  row.control.duty_rate_ps = control.duty_rate_ps;
  row.control.spool_threshold = control.spool_threshold;
  row.control.stroke_end_gain_ps = control.stroke_end_gain_ps;
  row.feedback = {control.servo_gain_ps,      control.servo_most_m,       control.servo_most_m,
                  control.servo_least_lambda, control.servo_frequency_hz, control.servo_damping,
                  profile.line.trim_ps2,      profile.line.trim_most_mps};
  row.control.learns = control.learns;
  row.control.learn_share = control.learn_share;
  if (control.law == ControlLaw::kKim) {
    row.feedback.gain_ps = 0.0;
  }
  if (control.law == ControlLaw::kKim || !control.learns) {
    row.feedback.bias_ps2 = 0.0;
  }
  row.watch.senses_spool = profile.bus.spool_feedback;
  row.watch.senses_load = profile.bus.pressures;
  row.watch.settle_s = settle_s(profile, drive);
  row.watch.spool_late_s = profile.bus.spool_by_pilot ? spool_arrives_s(row) : 0.0;
  row.watch.spool_tolerance = safety.spool_tolerance;
  row.watch.relief_pa = pump_of(profile, row.spool).relief_pa;
  row.watch.pressure_rail_pa = safety.pressure_rail_pa;
  return row;
}

ExcavatorBank excavator_bank(const ExcavatorProfile& profile) {
  ExcavatorBank bank;
  bank.count = profile.drive_count;
  const Eigen::Vector3d tip_over_stroke = leverage(profile);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    bank.row[static_cast<unsigned>(axis)] = cylinder_row(profile, axis, tip_over_stroke[axis]);
  }
  if (profile.has_swing()) {
    bank.row.back() = swing_row(profile);
  }
  return bank;
}

bool are_quick(DriveRows drives) {
  bool quick = true;
  for (int axis = 0; axis < 2; ++axis) {
    const SpoolAnswers& answer = drives[axis].answer;
    quick = quick && is_quick(answer.extend) && is_quick(answer.retract);
  }
  return quick;
}

McvMachine mcv_machine(const ExcavatorProfile& profile) {
  const ExcavatorBank bank = excavator_bank(profile);
  return mcv_machine(bank.rows(), {profile.pump.data(), profile.pump_count});
}

DriveVector ExcavatorServo::strokes_m() const {
  return {drive[0].stroke_m, drive[1].stroke_m, drive[2].stroke_m, drive[3].stroke_m};
}

DriveVector ExcavatorServo::under_way_m() const {
  return {drive[0].under_way_m, drive[1].under_way_m, drive[2].under_way_m, drive[3].under_way_m};
}

DriveVector strokes_then_m(DriveRows drives, const ExcavatorServo& servo) {
  DriveVector then_m = DriveVector::Zero();
  for (int i = 0; i < drives.count(); ++i) {
    then_m[i] = stroke_then_m(drives[i], servo.drive[static_cast<unsigned>(i)]);
  }
  return then_m;
}

DriveVector strokes_when_m(DriveRows drives, const ExcavatorServo& servo,
                           const DriveVector& asked_mps, int drive) {
  const double when_s = answer_s(drives[drive], asked_mps[drive]);
  DriveVector when_m = strokes_then_m(drives, servo);
  for (int i = 0; i < drives.count(); ++i) {
    const DriveRow& row = drives[i];
    when_m[i] += (when_s - answer_s(row, asked_mps[i])) * asked_mps[i];
    if (row.control.has_end_stops) {
      when_m[i] = std::clamp(when_m[i], row.least_travel_m, row.most_travel_m);
    }
  }
  return when_m;
}

DriveVector corrected_velocity(DriveRows drives, const DriveVector& wanted_mps,
                               const ExcavatorServo& servo, double last_lambda,
                               double speed_override_ratio, bool hold) {
  if (!hold && wanted_mps.isZero(0.0)) {
    return wanted_mps;
  }
  DriveVector corrected = wanted_mps;
  for (int i = 0; i < drives.count(); ++i) {
    corrected[i] = corrected_mps(drives[i], servo.drive[static_cast<unsigned>(i)], wanted_mps[i],
                                 last_lambda, speed_override_ratio, hold);
  }
  return corrected;
}

}  // namespace graben
