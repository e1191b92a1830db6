// SPDX-License-Identifier: Apache-2.0
/// The servos on a plan, what they learn, and the load's filter.

#include <cmath>

#include "firmware/drives/drive_servo.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/servo_steps.hpp"

using test::corrected_velocity;
using test::machine;
using test::next_servo_on_plan;
using test::of;
using test::servo_at_rest;
using test::servo_released;
using test::set;

constexpr double kPeriod_s = 0.01;

/// The shipped machine's control and a trim of its own.
ExcavatorProfile trimmed() {
  ExcavatorProfile profile = machine();
  profile.line.trim_ps2 = 1.0;
  profile.line.trim_most_mps = 0.004;
  profile.drive_count = kDriveCount;
  profile.swing.lever_m = 0.5;
  profile.control.swing_servo_most_rad = 0.04;
  return profile;
}

/// On a plan the plan says what is owed: less what is under way, less the stroke, bounded, and
/// nothing of what was owed before.
TEST(on_a_plan_it_owes_what_the_plan_says) {
  const ExcavatorProfile profile = trimmed();
  ExcavatorServo servo = servo_at_rest({0.5, 0.5, 0.5, 0.0});
  set(servo, &ServoState::integral_m, {0.02, -0.02, 0.01, 0.01});
  const DriveVector strokes_m(0.5, 0.5, 0.5, 0.0);
  DriveVector planned_m(0.503, 0.5, 0.48, 0.9);
  servo = next_servo_on_plan(profile, servo, DriveVector::Zero(), strokes_m, planned_m, false,
                             kPeriod_s);
  assert_true((of(servo, &ServoState::integral_m) - DriveVector(0.003, 0.0, -0.02, 0.02)).norm() <
              1e-12);
  // What was asked for is under way, not owed.
  const DriveVector asked_mps(0.1, 0.0, 0.0, 0.0);
  planned_m = strokes_m;
  for (int n = 0; n < 4; ++n) {
    planned_m += kPeriod_s * asked_mps;
    servo = next_servo_on_plan(profile, servo, asked_mps, strokes_m, planned_m, false, kPeriod_s);
    assert_true(of(servo, &ServoState::under_way_m)[0] > 0.0);
    assert_near(of(servo, &ServoState::integral_m)[0],
                planned_m[0] - of(servo, &ServoState::under_way_m)[0] - 0.5, 1e-12);
  }
  assert_true((of(servo, &ServoState::stroke_m) - strokes_m).isZero(0.0));
}

/// A drive that goes on owing gets more and more, up to a bound; a new plan and a release forget
/// it.
TEST(a_lasting_lag_is_learnt) {
  const ExcavatorProfile profile = trimmed();
  const DriveVector strokes_m(0.5, 0.5, 0.5, 0.0);
  const DriveVector planned_m = strokes_m + DriveVector(0.002, -0.002, 0.0, 0.002);
  const auto next = [&](const ExcavatorServo& servo, bool new_plan) {
    return next_servo_on_plan(profile, servo, DriveVector::Zero(), strokes_m, planned_m, new_plan,
                              kPeriod_s);
  };
  ExcavatorServo servo = servo_at_rest(strokes_m);
  repeat(100, [&] { servo = next(servo, false); });
  // 1 s of 1 /s2 of 2 mm.
  assert_true((of(servo, &ServoState::bias_mps) - DriveVector(0.002, -0.002, 0.0, 0.002)).norm() <
              1e-9);
  assert_near(of(next(servo, true), &ServoState::bias_mps)[0], kPeriod_s * 0.002, 1e-9);
  repeat(400, [&] { servo = next(servo, false); });
  assert_true((of(servo, &ServoState::bias_mps) - DriveVector(0.004, -0.004, 0.0, 0.004)).norm() <
              1e-12);
  assert_true(
      of(servo_released(profile.control, servo, strokes_m, kPeriod_s), &ServoState::bias_mps)
          .head<3>()
          .isZero(0.0));
  // What is learnt is asked for, with what is owed, also of a drive that is to stand where it
  // holds.
  const DriveVector wanted_mps(0.01, 0.0, 0.0, 0.0);
  set(servo, &ServoState::correction_m, DriveVector::Zero());
  const DriveVector moved = corrected_velocity(profile, wanted_mps, servo, 1.0, 1.0, false);
  assert_near(moved[0], 0.014, 1e-12);
  assert_true(corrected_velocity(profile, DriveVector::Zero(), servo, 1.0, 1.0).isZero(0.0));
  const DriveVector held = corrected_velocity(profile, DriveVector::Zero(), servo, 1.0, 1.0, true);
  assert_near(held[0], 0.004, 1e-12);
  assert_near(held[1], -0.004, 1e-12);
  // In the ratio of the operator's speed, like what is owed: without any nothing moves, or what is
  // learnt would swing a drive about its place.
  const DriveVector none = DriveVector::Zero();
  assert_near(corrected_velocity(profile, none, servo, 1.0, 0.5, true)[0], 0.002, 1e-12);
  assert_true(corrected_velocity(profile, none, servo, 1.0, 0.0, true).isZero(0.0));
}

/// The 12 t machine's swing: closed where it owes and does not hold, corrected where it does.
TEST(a_swing_that_holds_is_corrected) {
  ExcavatorProfile profile = test::excavator_12t().profile;
  profile.control.swing_servo_gain_ps = 1.5;
  ExcavatorServo servo = servo_at_rest({0.4, 0.5, 0.3, 0.0});
  servo.drive[kSwing].correction_m = 0.01;
  const DriveVector boom_only(0.01, 0.0, 0.0, 0.0);
  const DriveVector closed = corrected_velocity(profile, boom_only, servo, 1.0, 1.0, false);
  assert_near(closed[kSwing], 0.0, 0.0);
  const DriveVector holds = corrected_velocity(profile, boom_only, servo, 1.0, 1.0, true);
  assert_near(holds[kSwing], 0.015, 1e-12);
}

/// A step of load: two thirds after the time constant, all in the end; at once when it starts.
TEST(the_load_is_low_passed) {
  const auto pressures = [](double cap_pa, double rod_pa) {
    ValidDrive seen;
    seen.cap_pressure_pa = cap_pa;
    seen.rod_pressure_pa = rod_pa;
    seen.load_known = true;
    return seen;
  };
  const std::array<ValidDrive, 2> low = {pressures(1e6, 4e6), pressures(2e6, 5e6)};
  std::array<ValidDrive, 2> high = {pressures(2e6, 8e6), pressures(4e6, 10e6)};
  std::array<LoadState, 2> load{};
  next_loads(0.1, low, kPeriod_s, true, load);
  assert_near(load[1].rod_pa, 5e6, 0.0);
  repeat(10, [&] { next_loads(0.1, high, kPeriod_s, false, load); });
  for (unsigned i = 0; i < 2; ++i) {
    assert_near(load[i].cap_pa, low[i].cap_pressure_pa * (2.0 - std::exp(-1.0)), 1e-6);
    assert_near(load[i].rod_pa, low[i].rod_pressure_pa * (2.0 - std::exp(-1.0)), 1e-6);
  }
  // Without a filter at once; a load that is not known stays what it was.
  high[0].load_known = false;
  const double before_pa = load[0].cap_pa;
  next_loads(0.0, high, kPeriod_s, false, load);
  assert_near(load[0].cap_pa, before_pa, 0.0);
  assert_near(load[1].cap_pa, 4e6, 0.0);
}
