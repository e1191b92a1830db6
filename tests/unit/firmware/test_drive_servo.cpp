// SPDX-License-Identifier: Apache-2.0
/// Feedback around the valve's model: prediction, what is owed, and the load's filter.

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "firmware/drives/drive_servo.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/servo_steps.hpp"

using test::control;
using test::corrected_velocity;
using test::machine;
using test::next_servo;
using test::of;
using test::servo_at_rest;
using test::servo_released;
using test::set;

constexpr double kPeriod_s = 0.01;
constexpr double kPi = 3.14159265358979323846;

/// A cylinder that answers as expected: after the dead time, with two equal lags.
class Ideal {
 public:
  Ideal(double dead_time_s, double gain)
      : waiting_(static_cast<std::size_t>(std::lround(dead_time_s / kPeriod_s)), 0.0),
        gain_(gain) {}

  /// Stroke one period after this command.
  double after(double asked_mps) {
    waiting_.push_back(asked_mps);
    const double due_mps = waiting_.front();
    waiting_.erase(waiting_.begin());
    const double share = 1.0 - std::exp(-kPeriod_s / 0.025);
    first_ += share * (due_mps - first_);
    second_ += share * (first_ - second_);
    stroke_m_ += kPeriod_s * gain_ * second_;
    return stroke_m_;
  }

 private:
  std::vector<double> waiting_;
  double gain_;
  double first_ = 0.0;
  double second_ = 0.0;
  double stroke_m_ = 0.5;
};

struct Run {
  ExcavatorServo servo = servo_at_rest({0.5, 0.5, 0.5, 0.0});
  Ideal cylinder;
  ControlProfile profile;

  Run(double dead_time_s, double gain)
      : cylinder(dead_time_s, gain), profile(control(dead_time_s)) {}

  void step(double asked_mps) {
    const double stroke_m = cylinder.after(asked_mps);
    servo = next_servo(profile, servo, {asked_mps, 0.0, 0.0, 0.0}, {stroke_m, 0.5, 0.5, 0.0},
                       kPeriod_s);
  }
  void run(int cycles, double asked_mps) {
    for (int n = 0; n < cycles; ++n) {
      step(asked_mps);
    }
  }
};

/// Whatever is asked of it and whatever the dead time: a cylinder that answers as expected owes
/// nothing, and stands in the end where it was predicted.
TEST(a_cylinder_as_expected_owes_nothing) {
  for (const double dead_time_s : {0.0, 0.03, 0.15, 0.5}) {
    Run run(dead_time_s, 1.0);
    for (int n = 0; n < 200; ++n) {
      run.step(0.1 * std::sin(0.05 * n) + 0.02);
      assert_near(of(run.servo, &ServoState::integral_m).norm(), 0.0, 1e-12);
    }
    const double predicted_m =
        of(run.servo, &ServoState::stroke_m)[0] + of(run.servo, &ServoState::under_way_m)[0];
    run.run(200, 0.0);
    assert_near(of(run.servo, &ServoState::stroke_m)[0], predicted_m, 1e-6);
    assert_near(of(run.servo, &ServoState::under_way_m).norm(), 0.0, 1e-6);
  }
}

/// A cycle that comes late finds the drive where as many cycles in time have brought it.
TEST(a_late_cycle_owes_nothing_either) {
  Run run(0.04, 1.0);
  ExcavatorServo late = run.servo;
  repeat(20, [&] {
    run.run(3, 0.1);
    const DriveVector strokes_m = of(run.servo, &ServoState::stroke_m);
    late = next_servo(run.profile, late, {0.1, 0.0, 0.0, 0.0}, strokes_m, 3.0 * kPeriod_s);
    assert_near(of(late, &ServoState::integral_m)[0], 0.0, 1e-9);
    assert_near(of(late, &ServoState::under_way_m)[0], of(run.servo, &ServoState::under_way_m)[0],
                1e-9);
  });
}

/// One that does nine tenths owes the tenth, no more than its bound, and only on its own axis.
TEST(a_slow_cylinder_owes_what_it_lacks) {
  Run run(0.0, 0.9);
  run.run(100, 0.1);
  // 1 s at 0.1 m/s less the two lags of 25 ms.
  assert_near(of(run.servo, &ServoState::integral_m)[0], 0.1 * 0.1 * (1.0 - 0.05), 2e-4);
  assert_near(of(run.servo, &ServoState::integral_m)[1], 0.0, 0.0);
  run.run(500, 0.1);
  assert_near(of(run.servo, &ServoState::integral_m)[0], 0.02, 1e-12);
}

/// A held cylinder whose lambda has gone to 0 owes nothing new: nothing winds up.
TEST(where_lambda_is_0_nothing_winds_up) {
  Run run(0.0, 0.0);
  run.run(50, 0.01);
  const double before_m = of(run.servo, &ServoState::integral_m)[0];
  run.run(500, 0.0);
  assert_near(of(run.servo, &ServoState::integral_m)[0], before_m + 0.01 * 0.05, 1e-4);
}

TEST(what_is_owed_is_asked_for_whole_at_any_lambda) {
  ExcavatorServo servo = servo_at_rest({0.5, 0.5, 0.5, 0.0});
  set(servo, &ServoState::correction_m, {0.01, -0.005, 0.0, 0.0});
  const DriveVector wanted(0.1, 0.1, 0.1, 0.0);
  for (const double lambda : {1.0, 0.5, 0.2}) {
    const DriveVector asked = lambda * corrected_velocity(machine(), wanted, servo, lambda, 1.0);
    assert_near((asked - (lambda * wanted + 2.0 * of(servo, &ServoState::correction_m))).norm(),
                0.0, 1e-12);
  }
  // Below the least lambda it shrinks with it, so that it ends where lambda does.
  const DriveVector asked = 0.1 * corrected_velocity(machine(), wanted, servo, 0.1, 1.0);
  assert_near((asked - (0.1 * wanted + 0.5 * 2.0 * of(servo, &ServoState::correction_m))).norm(),
              0.0, 1e-12);
}

/// A slow dial is a slow machine: what is owed is paid in its ratio.
TEST(what_is_owed_goes_with_the_operators_speed) {
  ExcavatorServo servo = servo_at_rest({0.5, 0.5, 0.5, 0.0});
  set(servo, &ServoState::correction_m, {0.02, 0.02, -0.02, 0.0});
  const DriveVector wanted(0.001, 0.001, 0.001, 0.0);
  const DriveVector full = corrected_velocity(machine(), wanted, servo, 1.0, 1.0) - wanted;
  const DriveVector slow = corrected_velocity(machine(), wanted, servo, 1.0, 0.01) - wanted;
  assert_near((slow - 0.01 * full).norm(), 0.0, 1e-15);
  assert_near(full[0], 0.04, 1e-12);
}

/// At a cylinder's end what is owed is not asked for, and does not hold up the others.
TEST(what_is_owed_stops_at_a_stroke_end) {
  ExcavatorServo servo = servo_at_rest({0.5, 0.5, 0.0, 0.0});
  set(servo, &ServoState::correction_m, {0.01, 0.0, -0.02, 0.0});
  const DriveVector away = corrected_velocity(machine(), {0.1, 0.1, 0.03, 0.0}, servo, 0.5, 1.0);
  assert_near(away[2], 0.0, 0.0);
  assert_near(away[0], 0.14, 1e-12);
  // What the field wants there is the stroke end cap's to slow.
  const DriveVector into = corrected_velocity(machine(), {0.1, 0.1, -0.03, 0.0}, servo, 0.5, 1.0);
  assert_near(into[2], -0.03, 0.0);
  // The same at the other end.
  const double most_m = machine().geometry.cylinder[kBucket].stroke_m;
  servo = servo_at_rest({0.5, 0.5, most_m, 0.0});
  set(servo, &ServoState::correction_m, {0.0, 0.0, 0.02, 0.0});
  assert_near(corrected_velocity(machine(), {0.1, 0.1, -0.03, 0.0}, servo, 0.5, 1.0)[2], 0.0, 0.0);
  assert_near(corrected_velocity(machine(), {0.1, 0.1, 0.03, 0.0}, servo, 0.5, 1.0)[2], 0.03, 0.0);
}

/// Let go, what is under way still arrives and is no debt.
TEST(a_released_servo_still_expects_what_is_under_way) {
  Run run(0.15, 1.0);
  run.run(40, 0.1);
  const double coming_m = of(run.servo, &ServoState::under_way_m)[0];
  assert_near(coming_m, 0.1 * (0.15 + 0.05), 0.1 * 0.011);
  const double from_m = of(run.servo, &ServoState::stroke_m)[0];
  for (int n = 0; n < 60; ++n) {
    const double stroke_m = run.cylinder.after(0.0);
    run.servo = servo_released(run.profile, run.servo, {stroke_m, 0.5, 0.5, 0.0}, kPeriod_s);
    assert_near(of(run.servo, &ServoState::integral_m).norm() +
                    of(run.servo, &ServoState::correction_m).norm(),
                0.0, 0.0);
    assert_near(of(run.servo, &ServoState::correction_mps).norm(), 0.0, 0.0);
    assert_near(
        of(run.servo, &ServoState::stroke_m)[0] + of(run.servo, &ServoState::under_way_m)[0],
        from_m + coming_m, 1e-9);
  }
  assert_near(of(run.servo, &ServoState::under_way_m)[0], 0.0, 1e-6);
}

/// A late cycle leaves nothing behind: the prediction is what ring and lags hold, no sum of
/// periods.
TEST(an_uneven_period_leaves_nothing_behind) {
  Run run(0.15, 1.0);
  for (int n = 0; n < 400; ++n) {
    const double asked_mps = n < 200 ? 0.2 * std::sin(0.3 * n) : 0.0;
    run.servo = next_servo(run.profile, run.servo, {asked_mps, 0.0, 0.0, 0.0}, {0.5, 0.5, 0.5, 0.0},
                           n % 7 == 0 ? 0.04 : 0.008);
  }
  assert_near(of(run.servo, &ServoState::under_way_m).norm(), 0.0, 1e-9);
}

/// At rest is at rest, whatever is owed.
TEST(nothing_wanted_is_nothing_asked) {
  ExcavatorServo servo = servo_at_rest({0.5, 0.5, 0.5, 0.0});
  set(servo, &ServoState::integral_m, {0.01, 0.01, 0.01, 0.0});
  set(servo, &ServoState::correction_m, of(servo, &ServoState::integral_m));
  assert_near(corrected_velocity(machine(), DriveVector::Zero(), servo, 0.5, 1.0).norm(), 0.0, 0.0);
}

TEST(a_prediction_stays_within_the_strokes) {
  const ExcavatorProfile& profile = test::excavator().profile;
  ExcavatorServo servo = servo_at_rest({0.01, 0.7, 1.1, 0.0});
  set(servo, &ServoState::under_way_m, {-0.05, 0.01, 0.05, 0.0});
  const DriveVector then = strokes_then_m(excavator_bank(profile).rows(), servo);
  assert_near(then[0], 0.0, 0.0);
  assert_near(then[1], 0.71, 1e-15);
  assert_near(then[2], profile.geometry.cylinder[kBucket].stroke_m, 0.0);
}

/// Where all drives answer alike, each command takes effect at the same place, to the bit.
TEST(drives_alike_have_one_place) {
  const ExcavatorBank bank = excavator_bank(test::excavator().profile);
  ExcavatorServo servo = servo_at_rest({0.3, 0.7, 0.5, 0.0});
  set(servo, &ServoState::under_way_m, {-0.05, 0.01, 0.05, 0.0});
  const DriveVector then_m = strokes_then_m(bank.rows(), servo);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    assert_true(strokes_when_m(bank.rows(), servo, {0.1, -0.2, 0.3, 0.0}, axis) == then_m);
  }
}

/// A boom that is 0.25 s later than the others, and 0.05 s more when it retracts: when it answers,
/// they will be farther; when they answer, it will not be there yet.
TEST(drives_apart_have_a_place_each) {
  ExcavatorBank bank = excavator_bank(test::excavator().profile);
  SpoolAnswers& boom = bank.row[kBoom].answer;
  boom.extend.dead_time_s += 0.25;
  boom.retract.dead_time_s += 0.20;
  boom.retract.lag_s += 0.10;
  ExcavatorServo servo = servo_at_rest({0.3, 0.7, 0.5, 0.0});
  set(servo, &ServoState::under_way_m, {0.02, 0.01, -0.03, 0.0});
  const DriveVector extends_mps(0.1, -0.04, 0.2, 0.0);
  const auto when_m = [&](const DriveVector& asked_mps, int axis) {
    return strokes_when_m(bank.rows(), servo, asked_mps, axis);
  };
  assert_near((when_m(extends_mps, kBoom) - DriveVector(0.32, 0.70, 0.52, 0.0)).norm(), 0.0, 1e-12);
  for (const int axis : {static_cast<int>(kArm), static_cast<int>(kBucket)}) {
    assert_near((when_m(extends_mps, axis) - DriveVector(0.295, 0.71, 0.47, 0.0)).norm(), 0.0,
                1e-12);
  }
  const DriveVector retracts_mps(-0.1, 0.0, 0.0, 0.0);
  assert_near((when_m(retracts_mps, kArm) - DriveVector(0.35, 0.71, 0.47, 0.0)).norm(), 0.0, 1e-12);
}

/// What is taken for granted of a drive ends where the drive does.
TEST(a_place_stays_within_the_strokes) {
  ExcavatorBank bank = excavator_bank(test::excavator().profile);
  bank.row[kBoom].answer.extend.dead_time_s += 0.25;
  const ExcavatorServo servo = servo_at_rest({0.3, 0.7, 0.01, 0.0});
  const DriveVector when_m = strokes_when_m(bank.rows(), servo, {0.1, 0.0, -0.2, 0.0}, kBoom);
  assert_near(when_m[kBucket], 0.0, 0.0);
}

/// A cylinder that is shaken by 1 mm at this frequency around where it should be: what is asked
/// for, as a phasor of what it owes.
std::complex<double> shaken(double frequency_hz, double period_s) {
  const ControlProfile profile = control();
  ExcavatorServo servo = servo_at_rest({0.5, 0.5, 0.5, 0.0});
  const double turn = 2.0 * kPi * frequency_hz * period_s;
  const int cycles = static_cast<int>(std::lround(10.0 / (frequency_hz * period_s)));
  std::complex<double> owed = 0.0;
  std::complex<double> repaid = 0.0;
  for (int n = 1; n <= 2 * cycles; ++n) {
    const double stroke_m = 0.5 + 0.001 * std::sin(turn * n);
    servo = next_servo(profile, servo, {0.0, 0.0, 0.0, 0.0}, {stroke_m, 0.5, 0.5, 0.0}, period_s);
    if (n > cycles) {
      owed += of(servo, &ServoState::integral_m)[0] * std::polar(1.0, -turn * n);
      repaid += of(servo, &ServoState::correction_m)[0] * std::polar(1.0, -turn * n);
    }
  }
  return repaid / owed;
}

/// What changes slowly is asked for as it is; what shakes at the oil's lowest mode by a good
/// quarter of a period later and not smaller, so that with the response's lag it opposes the
/// motion; what is faster, hardly.
TEST(what_shakes_is_asked_for_a_quarter_of_a_period_later) {
  const std::complex<double> slow = shaken(0.25, kPeriod_s);
  assert_near(std::abs(slow), 1.0, 0.02);
  assert_near(std::arg(slow), -2.0 * 0.4 * 0.25 / 2.4, 0.03);
  const std::complex<double> mode = shaken(2.5, kPeriod_s);
  assert_true(std::abs(mode) > 0.9 && std::abs(mode) < 1.3);
  assert_true(std::arg(mode) < -0.45 * kPi && std::arg(mode) > -0.75 * kPi);
  assert_true(std::abs(shaken(10.0, kPeriod_s)) < 0.1);
}

/// All of it in the end, no more than a third beyond on the way, at any period.
TEST(what_stays_owed_is_asked_for_whole) {
  const ControlProfile profile = control();
  for (const double period_s : {0.001, 0.01, 0.05}) {
    ExcavatorServo servo = servo_at_rest({0.5, 0.5, 0.5, 0.0});
    set(servo, &ServoState::integral_m, {0.01, -0.02, 0.0, 0.0});
    double most_m = 0.0;
    for (double time_s = 0.0; time_s < 3.0; time_s += period_s) {
      servo = next_servo(profile, servo, DriveVector::Zero(), of(servo, &ServoState::stroke_m),
                         period_s);
      most_m = std::max(most_m, of(servo, &ServoState::correction_m)[0]);
    }
    assert_near((of(servo, &ServoState::correction_m) - of(servo, &ServoState::integral_m)).norm(),
                0.0, 1e-6);
    assert_true(most_m < 0.0133);
  }
  // A period of 0, as a first cycle has, changes nothing.
  ExcavatorServo servo = servo_at_rest({0.5, 0.5, 0.5, 0.0});
  set(servo, &ServoState::integral_m, {0.01, 0.0, 0.0, 0.0});
  set(servo, &ServoState::correction_mps, {0.1, 0.0, 0.0, 0.0});
  servo = next_servo(profile, servo, DriveVector::Zero(), of(servo, &ServoState::stroke_m), 0.0);
  assert_near(of(servo, &ServoState::correction_m).norm(), 0.0, 0.0);
  assert_near(of(servo, &ServoState::correction_mps)[0], 0.1, 0.0);
}

/// A drive that its load holds owes nothing more to that side and forgets what it owed; to the
/// other side it owes as ever, and learns no lag.
TEST(what_a_load_holds_is_not_owed) {
  const ExcavatorProfile profile = machine();
  const ExcavatorBank bank = excavator_bank(profile);
  const DriveRow& row = bank.rows()[0];
  for (const int side : {1, -1}) {
    ServoState servo;
    graben::servo_at_rest(0.5, servo);
    repeat(100, [&] { graben::next_servo(row, side * 0.1, 0.5, kPeriod_s, servo); });
    assert_near(servo.integral_m, side * 0.02, 1e-12);
    repeat(30, [&] { graben::next_servo(row, side * 0.1, 0.5, kPeriod_s, servo, side); });
    assert_near(servo.integral_m, side * 0.02 * std::pow(1.0 - 0.01 / 0.3, 30), 1e-12);
    ServoState back;
    graben::servo_at_rest(0.5, back);
    repeat(100, [&] { graben::next_servo(row, -side * 0.1, 0.5, kPeriod_s, back, side); });
    assert_near(back.integral_m, -side * 0.02, 1e-12);
  }
  DriveRow learns = row;
  learns.feedback.plan_most_m = 0.02;
  learns.feedback.bias_ps2 = 1.0;
  learns.feedback.bias_most_mps = 0.02;
  for (const int blocked : {0, 1}) {
    ServoState servo;
    graben::servo_at_rest(0.5, servo);
    for (int n = 0; n < 100; ++n) {
      graben::next_servo_on_plan(learns, 0.0, 0.5, 0.51, n == 0, kPeriod_s, servo, blocked);
    }
    assert_near(servo.bias_mps, blocked == 1 ? 0.0 : 0.01, 1e-9);
  }
}
