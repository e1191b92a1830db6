#include "firmware/drives/cylinder_servo.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

int dead_cycles(double dead_time_s) {
  return static_cast<int>(
      std::clamp(dead_time_s / ServoState::kCycle_s + 0.5, 0.0, ServoState::kMostDelayed - 1.0));
}

/// Weight of the newest value in one of the two lags.
double newest_share(double response_s, double period_s) {
  return 1.0 - std::exp(-period_s / (0.5 * response_s));
}

/// What was asked for so many cycles ago.
const DriveVector& asked_before(const ServoState& servo, int cycles) {
  const int place = servo.newest - cycles;
  return servo
      .asked_mps[static_cast<unsigned>(place < 0 ? place + ServoState::kMostDelayed : place)];
}

/// The ring's places that are not due yet, and what two equal lags, left alone, still give.
DriveVector under_way(const ControlProfile& control, const ServoState& servo) {
  const double newest = newest_share(control.response_s, ServoState::kCycle_s);
  DriveVector sum_mps = (1.0 - newest) / newest * (servo.lag_mps[0] + servo.lag_mps[1]);
  for (int n = 0; n < dead_cycles(control.dead_time_s); ++n) {
    sum_mps += asked_before(servo, n);
  }
  return ServoState::kCycle_s * sum_mps;
}

/// What was asked for goes on its way; nothing is owed yet.
ServoState with_asked(const ControlProfile& control, const ServoState& last,
                      const DriveVector& asked_mps, double period_s) {
  ServoState next = last;
  next.newest = (last.newest + 1) % ServoState::kMostDelayed;
  next.asked_mps[static_cast<unsigned>(next.newest)] = asked_mps;
  const double newest = newest_share(control.response_s, period_s);
  next.lag_mps[0] +=
      newest * (asked_before(next, dead_cycles(control.dead_time_s)) - last.lag_mps[0]);
  next.lag_mps[1] += newest * (next.lag_mps[0] - last.lag_mps[1]);
  next.under_way_m = under_way(control, next);
  return next;
}

DriveVector bounded_debt(const ControlProfile& control, const DriveVector& owed_m) {
  return owed_m.cwiseMax(-control.servo_most_m).cwiseMin(control.servo_most_m);
}

/// One step of y'' = w^2 (owed - y) - 2 zeta w y', implicit: stable at any period.
void repay(const ControlProfile& control, ServoState& next, double period_s) {
  const double turn = kTwoPi * control.servo_frequency_hz * period_s;
  const double slowed = 1.0 + turn * (2.0 * control.servo_damping + turn);
  const DriveVector pull_m = turn * turn * (next.owed_m - next.repay_m);
  const DriveVector step_m = (period_s * next.repay_mps + pull_m) / slowed;
  next.repay_m += step_m;
  if (period_s > 0.0) {
    next.repay_mps = step_m / period_s;
  }
}

}  // namespace

ServoState servo_at_rest(const DriveVector& strokes_m) {
  ServoState servo;
  servo.strokes_m = strokes_m;
  return servo;
}

ServoState next_servo(const ControlProfile& control, const ServoState& last,
                      const DriveVector& asked_mps, const DriveVector& strokes_m, double period_s) {
  ServoState next = with_asked(control, last, asked_mps, period_s);
  const DriveVector expected_m = period_s * next.lag_mps[1];
  next.owed_m = bounded_debt(control, last.owed_m + (expected_m - (strokes_m - last.strokes_m)));
  next.trim_mps.setZero();
  next.strokes_m = strokes_m;
  repay(control, next, period_s);
  return next;
}

ServoState next_servo_on_plan(const ExcavatorProfile& profile, const ServoState& last,
                              const DriveVector& asked_mps, const DriveVector& strokes_m,
                              const DriveVector& planned_m, bool new_plan, double period_s) {
  const ControlProfile& control = profile.control;
  ServoState next = with_asked(control, last, asked_mps, period_s);
  if (new_plan) {
    next.trim_mps.setZero();
  }
  next.owed_m = bounded_debt(control, planned_m - next.under_way_m - strokes_m);
  const double swing_most_m = control.swing_servo_most_rad * profile.swing.lever_m;
  next.owed_m[kSwing] = std::clamp(next.owed_m[kSwing], -swing_most_m, swing_most_m);
  next.strokes_m = strokes_m;
  repay(control, next, period_s);
  next.trim_mps += period_s * profile.line.trim_ps2 * next.owed_m;
  next.trim_mps =
      next.trim_mps.cwiseMax(-profile.line.trim_most_mps).cwiseMin(profile.line.trim_most_mps);
  return next;
}

DriveVector strokes_then(const ExcavatorProfile& profile, const ServoState& servo) {
  DriveVector then = servo.strokes_m + servo.under_way_m;
  for (int i = 0; i < profile.drive_count; ++i) {
    then[i] = std::clamp(then[i], profile.least_travel_m(i), profile.most_travel_m(i));
  }
  return then;
}

ServoState servo_released(const ControlProfile& control, const ServoState& last,
                          const DriveVector& strokes_m, double period_s) {
  ServoState next = next_servo(control, last, DriveVector::Zero(), strokes_m, period_s);
  next.owed_m.setZero();
  next.repay_m.setZero();
  next.repay_mps.setZero();
  next.trim_mps.setZero();
  return next;
}

DriveVector corrected_velocity(const ExcavatorProfile& profile, const DriveVector& wanted_mps,
                               const ServoState& servo, double last_lambda,
                               double speed_override_ratio, bool holds) {
  if (!holds && wanted_mps.isZero(0.0)) {
    return wanted_mps;
  }
  const ControlProfile& control = profile.control;
  const double raised = std::max(last_lambda, control.servo_least_lambda);
  DriveVector corrected = wanted_mps;
  for (int i = 0; i < profile.drive_count; ++i) {
    if (i == kSwing && !holds && wanted_mps[i] == 0.0) {
      continue;
    }
    const double servo_gain_ps = i == kSwing ? control.swing_servo_gain_ps : control.servo_gain_ps;
    const double gain_ps = speed_override_ratio * servo_gain_ps / raised;
    const double stroke_m = servo.strokes_m[i];
    const double in_mps = -control.stroke_end_gain_ps * (stroke_m - profile.least_travel_m(i));
    const double out_mps = control.stroke_end_gain_ps * (profile.most_travel_m(i) - stroke_m);
    corrected[i] = std::clamp(
        wanted_mps[i] + gain_ps * servo.repay_m[i] + speed_override_ratio * servo.trim_mps[i],
        std::min(in_mps, wanted_mps[i]), std::max(out_mps, wanted_mps[i]));
  }
  return corrected;
}

}  // namespace graben
