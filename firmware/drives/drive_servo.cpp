// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/drive_servo.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/tuning.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {

double due_mps(const ServoState& servo) { return servo.lag_mps[0][1] + servo.lag_mps[1][1]; }

namespace {

int dead_cycles(double dead_time_s) {
  return static_cast<int>(
      std::clamp(dead_time_s / kCyclePeriod_s + 0.5, 0.0, ServoState::kMostDelayed - 1.0));
}

/// Weight of the newest value in one of the two lags.
double newest_share(double lag_s, double period_s) {
  return 1.0 - std::exp(-period_s / (0.5 * lag_s));
}

/// What was asked for so many cycles ago.
double asked_before(const ServoState& servo, int cycles) {
  const int place = servo.newest - cycles;
  return servo
      .asked_mps[static_cast<unsigned>(place < 0 ? place + ServoState::kMostDelayed : place)];
}

/// What two equal lags, left alone, still give.
double left_mps(double lag_s, const std::array<double, 2>& lag_mps) {
  const double newest = newest_share(lag_s, kCyclePeriod_s);
  return (1.0 - newest) / newest * (lag_mps[0] + lag_mps[1]);
}

/// That, and the ring's places that are not due yet.
double under_way_m(const SpoolAnswers& answer, const ServoState& servo) {
  double sum_mps = left_mps(answer.extend.lag_s, servo.lag_mps[0]);
  if (!answer.same_times()) {
    sum_mps += left_mps(answer.retract.lag_s, servo.lag_mps[1]);
  }
  const int extending = dead_cycles(answer.extend.dead_time_s);
  const int retracting = dead_cycles(answer.retract.dead_time_s);
  for (int n = 0; n < std::max(extending, retracting); ++n) {
    const double asked_mps = asked_before(servo, n);
    sum_mps += n < (asked_mps > 0.0 ? extending : retracting) ? asked_mps : 0.0;
  }
  return kCyclePeriod_s * sum_mps;
}

void lag(double due_mps, double newest, std::array<double, 2>& lag_mps) {
  lag_mps[0] += newest * (due_mps - lag_mps[0]);
  lag_mps[1] += newest * (lag_mps[0] - lag_mps[1]);
}

/// One place of the ring on.
void ask_once(const SpoolAnswers& answer, double asked_mps, double period_s, ServoState& servo) {
  servo.newest = (servo.newest + 1) % ServoState::kMostDelayed;
  servo.asked_mps[static_cast<unsigned>(servo.newest)] = asked_mps;
  const double due_mps = asked_before(servo, dead_cycles(answer.extend.dead_time_s));
  const double newest = newest_share(answer.extend.lag_s, period_s);
  if (answer.same_times()) {
    lag(due_mps, newest, servo.lag_mps[0]);
  } else {
    // Each side by itself, or an order to turn round would be lost or doubled between the two.
    const double back_mps = asked_before(servo, dead_cycles(answer.retract.dead_time_s));
    lag(std::max(0.0, due_mps), newest, servo.lag_mps[0]);
    lag(std::min(0.0, back_mps), newest_share(answer.retract.lag_s, period_s), servo.lag_mps[1]);
  }
}

/// What was asked for goes on its way for all the time that it stood; the error is as it was.
/// Travel that was due meanwhile.
double ask(const SpoolAnswers& answer, double asked_mps, double period_s, ServoState& servo) {
  const int cycles = cycles_in(period_s);
  const double each_s = period_s / cycles;
  double due_m = 0.0;
  for (int n = 0; n < cycles; ++n) {
    ask_once(answer, asked_mps, each_s, servo);
    due_m += each_s * due_mps(servo);
  }
  servo.under_way_m = under_way_m(answer, servo);
  return due_m;
}

double within(double value, double most) { return std::min(std::max(value, -most), most); }

/// Most that a drive is behind which its load holds to that side.
double unblocked_m(int side, double step_m) { return side * step_m > 0.0 ? 0.0 : step_m; }

/// One step of y'' = w^2 (integral - y) - 2 zeta w y', implicit: stable at any period.
void filter(const DriveFeedback& feedback, double period_s, ServoState& servo) {
  const double turn = kTwoPi * feedback.frequency_hz * period_s;
  const double slowed = 1.0 + turn * (2.0 * feedback.damping + turn);
  const double pull_m = turn * turn * (servo.integral_m - servo.correction_m);
  const double step_m = (period_s * servo.correction_mps + pull_m) / slowed;
  servo.correction_m += step_m;
  if (period_s > 0.0) {
    servo.correction_mps = step_m / period_s;
  }
}

/// A correction never pushes a drive faster at its end than that allows.
double within_ends(const DriveRow& drive, const ServoState& servo, double wanted_mps,
                   double correction_mps) {
  const double end_gain_ps = drive.control.stroke_end_gain_ps;
  const double in_mps = -end_gain_ps * (servo.stroke_m - drive.least_travel_m);
  const double out_mps = end_gain_ps * (drive.most_travel_m - servo.stroke_m);
  return std::clamp(wanted_mps + correction_mps, std::min(in_mps, wanted_mps),
                    std::max(out_mps, wanted_mps));
}

}  // namespace

void servo_at_rest(double stroke_m, ServoState& servo) {
  servo = {};
  servo.stroke_m = stroke_m;
}

void next_servo(const DriveRow& drive, double asked_mps, double stroke_m, double period_s,
                ServoState& servo, int blocked_side) {
  const double due_m = ask(drive.answer, asked_mps, period_s, servo);
  const double behind_m = due_m - (stroke_m - servo.stroke_m);
  servo.integral_m =
      within(servo.integral_m + unblocked_m(blocked_side, behind_m), drive.feedback.error_most_m);
  if (blocked_side * servo.integral_m > 0.0) {
    servo.integral_m *= 1.0 - std::min(1.0, period_s / kServoForget_s);
  }
  servo.bias_mps = 0.0;
  servo.stroke_m = stroke_m;
  filter(drive.feedback, period_s, servo);
}

void next_servo_on_plan(const DriveRow& drive, double asked_mps, double stroke_m, double planned_m,
                        bool new_plan, double period_s, ServoState& servo, int blocked_side) {
  static_cast<void>(ask(drive.answer, asked_mps, period_s, servo));
  if (new_plan) {
    servo.bias_mps = 0.0;
  }
  servo.integral_m = within(planned_m - servo.under_way_m - stroke_m, drive.feedback.plan_most_m);
  servo.stroke_m = stroke_m;
  filter(drive.feedback, period_s, servo);
  const double lasting_m = unblocked_m(blocked_side, servo.integral_m);
  servo.bias_mps = within(servo.bias_mps + period_s * drive.feedback.bias_ps2 * lasting_m,
                          drive.feedback.bias_most_mps);
}

void release_servo(const DriveRow& drive, double stroke_m, double period_s, ServoState& servo) {
  static_cast<void>(ask(drive.answer, 0.0, period_s, servo));
  servo.stroke_m = stroke_m;
  servo.integral_m = 0.0;
  servo.correction_m = 0.0;
  servo.correction_mps = 0.0;
  servo.bias_mps = 0.0;
}

void servo_after(const DriveRow& drive, EcuMode mode, double asked_mps, double stroke_m,
                 double period_s, ServoState& servo, int blocked_side) {
  if (mode == EcuMode::kActive) {
    next_servo(drive, asked_mps, stroke_m, period_s, servo, blocked_side);
  } else if (mode == EcuMode::kFault) {
    servo_at_rest(stroke_m, servo);
  } else {
    release_servo(drive, stroke_m, period_s, servo);
  }
}

double stroke_then_m(const DriveRow& drive, const ServoState& servo) {
  const double then_m = servo.stroke_m + servo.under_way_m;
  return drive.control.has_end_stops ? std::clamp(then_m, drive.least_travel_m, drive.most_travel_m)
                                     : then_m;
}

double corrected_mps(const DriveRow& drive, const ServoState& servo, double wanted_mps,
                     double last_lambda, double speed_override_ratio, bool hold) {
  if (drive.control.holds_itself && !hold && wanted_mps == 0.0) {
    return wanted_mps;
  }
  const double raised = std::max(last_lambda, drive.feedback.least_lambda);
  const double gain_ps = speed_override_ratio * drive.feedback.gain_ps / raised;
  return within_ends(drive, servo, wanted_mps,
                     gain_ps * servo.correction_m + speed_override_ratio * servo.bias_mps);
}

double corrected_by(const DriveRow& drive, const ServoState& servo, double wanted_mps,
                    double correction_mps, double last_lambda) {
  return within_ends(drive, servo, wanted_mps,
                     correction_mps / std::max(last_lambda, drive.feedback.least_lambda));
}

void next_loads(double pressure_filter_s, Span<const ValidDrive> seen, double period_s,
                bool restart, Span<LoadState> load) {
  const bool filters = !restart && pressure_filter_s > 0.0;
  const double newest = filters ? 1.0 - std::exp(-period_s / pressure_filter_s) : 1.0;
  for (int i = 0; i < load.count(); ++i) {
    if (!seen[i].load_known) {
      continue;
    }
    const double cap_pa = seen[i].cap_pressure_pa;
    const double rod_pa = seen[i].rod_pressure_pa;
    load[i] = filters ? LoadState{load[i].cap_pa + newest * (cap_pa - load[i].cap_pa),
                                  load[i].rod_pa + newest * (rod_pa - load[i].rod_pa)}
                      : LoadState{cap_pa, rod_pa};
  }
}

}  // namespace graben
