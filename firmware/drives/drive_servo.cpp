#include "firmware/drives/drive_servo.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

/// Of what a drive is behind that its load holds.
constexpr double kForget_s = 0.3;

int dead_cycles(double dead_time_s) {
  return static_cast<int>(
      std::clamp(dead_time_s / ServoState::kCycle_s + 0.5, 0.0, ServoState::kMostDelayed - 1.0));
}

/// Weight of the newest value in one of the two lags.
double newest_share(double response_s, double period_s) {
  return 1.0 - std::exp(-period_s / (0.5 * response_s));
}

/// What was asked for so many cycles ago.
double asked_before(const ServoState& servo, int cycles) {
  const int place = servo.newest - cycles;
  return servo
      .asked_mps[static_cast<unsigned>(place < 0 ? place + ServoState::kMostDelayed : place)];
}

/// The ring's places that are not due yet, and what two equal lags, left alone, still give.
double under_way_m(const DriveControl& control, const ServoState& servo) {
  const double newest = newest_share(control.response_s, ServoState::kCycle_s);
  double sum_mps = (1.0 - newest) / newest * (servo.lag_mps[0] + servo.lag_mps[1]);
  const int dead = dead_cycles(control.dead_time_s);
  for (int n = 0; n < dead; ++n) {
    sum_mps += asked_before(servo, n);
  }
  return ServoState::kCycle_s * sum_mps;
}

/// What was asked for goes on its way; the error is as it was.
void ask(const DriveControl& control, double asked_mps, double period_s, ServoState& servo) {
  servo.newest = (servo.newest + 1) % ServoState::kMostDelayed;
  servo.asked_mps[static_cast<unsigned>(servo.newest)] = asked_mps;
  const double newest = newest_share(control.response_s, period_s);
  const double due_mps = asked_before(servo, dead_cycles(control.dead_time_s));
  servo.lag_mps[0] += newest * (due_mps - servo.lag_mps[0]);
  servo.lag_mps[1] += newest * (servo.lag_mps[0] - servo.lag_mps[1]);
  servo.under_way_m = under_way_m(control, servo);
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
  ask(drive.control, asked_mps, period_s, servo);
  const double behind_m = period_s * servo.lag_mps[1] - (stroke_m - servo.stroke_m);
  servo.integral_m =
      within(servo.integral_m + unblocked_m(blocked_side, behind_m), drive.feedback.error_most_m);
  if (blocked_side * servo.integral_m > 0.0) {
    servo.integral_m *= 1.0 - std::min(1.0, period_s / kForget_s);
  }
  servo.bias_mps = 0.0;
  servo.stroke_m = stroke_m;
  filter(drive.feedback, period_s, servo);
}

void next_servo_on_plan(const DriveRow& drive, double asked_mps, double stroke_m, double planned_m,
                        bool new_plan, double period_s, ServoState& servo, int blocked_side) {
  ask(drive.control, asked_mps, period_s, servo);
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
  ask(drive.control, 0.0, period_s, servo);
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
