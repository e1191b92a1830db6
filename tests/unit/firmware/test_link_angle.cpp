// SPDX-License-Identifier: Apache-2.0
// The angle of one body by gyro and accelerometer, against bodies whose motion is known.

#include "firmware/estimation/link_angle.hpp"

#include <cmath>
#include <cstdio>

#include "firmware/estimation/tuning.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/moving_body.hpp"

using namespace test::of_body;

TEST(stands) {
  for (const double angle : {-3.0, -1.2, 0.0, 0.8, 2.9}) {
    Body body;
    body.middle_rad = angle;
    LinkAngle state;
    assert_true(worst_rad(body, 0.0, 1.0, false, true, state) < 1e-9);
    assert_false(state.contradicts());
  }
}

TEST(learns_its_bias_at_rest, Body body) {
  body.bias_radps = 3e-3;
  body.noise = 1.0;
  LinkAngle state;
  assert_true(worst_rad(body, 3.0, 20.0, true, true, state) < 4e-3);
  assert_near(state.bias_radps, 3e-3, 2e-4);
  // In a second at rest it knows more of it than gravity alone tells it in four.
  LinkAngle moving;
  static_cast<void>(worst_rad(body, 3.0, 4.0, false, true, moving));
  LinkAngle rested;
  static_cast<void>(worst_rad(body, 0.5, 1.0, true, true, rested));
  assert_true(rested.bias_variance < moving.bias_variance);
}

TEST(its_own_acceleration_is_no_tilt, Body body) {
  body.swing_rad = 0.3;
  LinkAngle state;
  assert_true(worst_rad(body, 1.0, 20.0, false, true, state) < 5e-4);
  // Not told of it, the direction of the force leads away.
  LinkAngle misled;
  assert_true(worst_rad(body, 1.0, 20.0, false, false, misled) > 4e-3);
}

/// A machine that rocks shakes the pin of its boom to and fro. One half of each swing looks more
/// like gravity than the other, by what the accelerometer is off, and must not count more for that.
TEST(its_pin_sways) {
  Body body;
  body.middle_rad = 0.0;
  body.sways_mps2 = {3.0, 1.0};
  body.offset_mps2 = 0.5;
  LinkAngle state;
  const double worst = worst_rad(body, 1.0, 20.0, false, true, state);
  std::printf("pin that sways: off by %.2f mrad\n", 1e3 * worst);
  assert_true(worst < 0.03);
}

TEST(deviation_holds) {
  int outside = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    Body body;
    body.swing_rad = 0.2;
    body.noise = 1.0;
    body.engine.seed(seed);
    body.bias_radps = 3e-3 * std::sin(seed);
    LinkAngle state;
    static_cast<void>(worst_rad(body, 0.0, 10.0, false, true, state));
    const double error = std::abs(state.angle_rad - body.angle(9.99));
    outside += error > 2.0 * state.sd_rad(0.0) ? 1 : 0;
  }
  // One in twenty is expected.
  assert_in_range(outside, 0, 6);
}

TEST(looks_ahead, Body body) {
  body.swing_rad = 0.3;
  LinkAngle state;
  static_cast<void>(worst_rad(body, 0.0, 5.0, false, true, state));
  const double last_s = 4.99;
  // 0.02 s of what changes in its acceleration is left, and 0.01 s by which that is old.
  assert_near(state.ahead_rad(0.02), body.angle(last_s + 0.02), 1e-3);
  assert_true(std::abs(body.angle(last_s + 0.02) - body.angle(last_s)) > 5e-3);
}

TEST(a_stuck_sensor_contradicts, Body body) {
  LinkAngle state;
  begin_angle(kNoise, body.reading(0.0), state);
  AngleReading stuck = body.reading(0.0);
  // The accelerometer froze; the link turns by 0.3 rad/s.
  stuck.rate_radps = 0.3;
  int cycles = 0;
  while (!state.contradicts() && cycles < 1000) {
    carry_angle(kNoise, stuck, false, state);
    if (state.runs()) {
      correct_angle(kNoise, Eigen::Vector2d::Zero(), state);
    }
    ++cycles;
  }
  assert_in_range(cycles, 20, 300);
}

/// Of a sensor at `at_m` from its pin, as its own gyro has it.
Eigen::Vector2d by_gyro(const Eigen::Vector2d& at_m, const LinkAngle& state) {
  const Eigen::Vector2d arm = turned(at_m.x(), at_m.y(), state.then.angle_rad);
  return state.then.acceleration_radps2 * Eigen::Vector2d(-arm.y(), arm.x()) -
         state.then.rate_radps * state.then.rate_radps * arm;
}

/// From 2 s on its gyro is off by that much, the sensor as it is told 2 m from its pin or nearer.
/// Time from there until it has contradicted its force; 1000 s: not within `most_s`.
double seen_after_s(Body body, double off_radps, double most_s, const AngleNoise& noise = kNoise,
                    double lever_m = 2.0) {
  LinkAngle state;
  begin_angle(noise, body.reading(0.0), state);
  for (int i = 1; i * kPeriod_s < 2.0 + most_s; ++i) {
    const double t = i * kPeriod_s;
    body.bias_radps = t < 2.0 ? 0.0 : off_radps;
    carry_angle(noise, body.reading(t), false, state);
    if (state.runs()) {
      const Eigen::Vector2d acceleration = by_gyro({2.0, 0.0}, state);
      watch_gyro(noise, {lever_m, 0.0}, acceleration, state);
      correct_angle(noise, acceleration, state);
    }
    if (state.contradicts()) {
      return t - 2.0;
    }
  }
  return 1000.0;
}

TEST(a_gyro_that_jumps_contradicts, Body body) {
  body.noise = 1.0;
  for (const double swing_rad : {0.0, 0.3}) {
    body.swing_rad = swing_rad;
    assert_true(seen_after_s(body, 0.0, 60.0) > 60.0);
    for (const double side : {1.0, -1.0}) {
      assert_true(seen_after_s(body, 0.07 * side, 1.0) < 0.10);
      // Too near to its pin, its force tells nothing of it so soon.
      assert_true(seen_after_s(body, 0.07 * side, 0.3, kNoise, 0.99) > 0.3);
      // So little may be anything.
      assert_true(seen_after_s(body, 0.02 * side, 0.3) > 0.3);
    }
  }
}

AngleReading shown(double rate_radps, double force_mps2) {
  return {kPeriod_s, rate_radps, {force_mps2, 0.0}, 0.0};
}

/// 60 mg, on an arm that is level: a jump is seen beside it.
TEST(an_offset_of_the_force_is_no_jump, Body body) {
  body.noise = 1.0;
  body.middle_rad = 0.0;
  for (const double side : {1.0, -1.0}) {
    body.offset_mps2 = side * 0.6;
    assert_true(seen_after_s(body, 0.0, 60.0) > 60.0);
    assert_true(seen_after_s(body, 0.07, 1.0) < 0.10);
    assert_true(seen_after_s(body, -0.07, 1.0) < 0.10);
  }
}

/// The first is all offset, then the mean, later it follows what stays.
TEST(what_stays_is_an_offset) {
  LinkAngle state;
  begin_angle(kNoise, shown(0.0, kGravity), state);
  state.then.angle_rad = 0.0;
  state.last.period_s = 0.25;
  const auto look = [&](double more_mps2) {
    state.then.force_mps2 = {0.0, kGravity - more_mps2};
    watch_gyro(kNoise, {2.0, 0.0}, Eigen::Vector2d::Zero(), state);
  };
  look(0.5);
  assert_near(state.steady_mps2, 0.5, 1e-12);
  assert_near(state.jumps_radps, 0.0, 1e-12);
  look(1.5);
  assert_near(state.steady_mps2, 1.0, 1e-12);
  assert_near(state.jumps_radps, 0.25 * 0.5 / 2.0, 1e-12);
  state.steady_s = kGyroSteadyTime_s;
  look(5.0);
  assert_near(state.steady_mps2, 1.0 + 0.25 / kGyroSteadyTime_s * 4.0, 1e-12);
  assert_near(state.steady_s, kGyroSteadyTime_s, 0.0);
  state.last.period_s = 3.0 * kGyroSteadyTime_s;  // No further than all of it.
  look(7.0);
  assert_near(state.steady_mps2, 7.0, 1e-12);
}

/// Where the force is noisier, more of it is.
TEST(a_noisy_force_tells_less, Body body) {
  const AngleNoise noisy = {kNoise.rate_radps, kNoise.bias_radps, 2.0};
  assert_true(seen_after_s(body, 0.07, 0.3, noisy) > 0.3);
  assert_true(seen_after_s(body, 0.3, 0.3, noisy) < 0.10);
}

TEST(blows_are_no_tilt, Body body) {
  LinkAngle state;
  begin_angle(kNoise, body.reading(0.0), state);
  for (int i = 1; i < 500; ++i) {
    AngleReading reading = body.reading(i * kPeriod_s);
    // Hard ground, always from one side: every third reading, one and a half times gravity.
    reading.force_mps2.x() += i % 3 == 0 ? 15.0 : 0.0;
    carry_angle(kNoise, reading, false, state);
    if (state.runs()) {
      correct_angle(kNoise, Eigen::Vector2d::Zero(), state);
    }
    assert_false(state.contradicts());
  }
  assert_near(state.angle_rad, body.angle(5.0), 5e-3);
}

TEST(falls_without_direction, LinkAngle state) {
  AngleReading reading;
  reading.period_s = kPeriod_s;
  begin_angle(kNoise, reading, state);
  assert_int_equal(state.readings, 0);
  Body body;
  begin_angle(kNoise, body.reading(0.0), state);
  const double before = state.angle_rad;
  for (int i = 0; i < 3; ++i) {
    carry_angle(kNoise, reading, false, state);
    correct_angle(kNoise, Eigen::Vector2d(0.0, -kGravity), state);
  }
  assert_near(state.angle_rad, before, 1e-12);
}

TEST(its_bounds_are_no_contradiction, LinkAngle state) {
  for (const double side : {1.0, -1.0}) {
    state.off_rad = side * kAngleContradicts_rad;
    assert_false(state.contradicts());
    state.off_rad = std::nextafter(state.off_rad, side);
    assert_true(state.contradicts());
    state.off_rad = 0.0;
  }
  state.jump_held_s = -1.0;
  assert_false(state.contradicts());
  state.jump_held_s = std::nextafter(0.0, 1.0);
  assert_true(state.contradicts());
}

/// Jumped by `jumped_radps` as of now, with a force that has no noise and shows nothing.
LinkAngle looked_at(double jumped_radps, double held_s = 0.0) {
  LinkAngle state;
  begin_angle(kNoise, shown(0.0, kGravity), state);
  state.then.angle_rad = 0.0;
  state.then.force_mps2 = {0.0, kGravity};
  state.last.period_s = kGyroShakeTime_s;  // What is low-passed is that of now, whole.
  state.jumps_radps = jumped_radps / (1.0 - kGyroShakeTime_s / kGyroJumpTime_s);
  state.jump_held_s = held_s;
  watch_gyro(kNoise, {1e6, 0.0}, Eigen::Vector2d::Zero(), state);
  return state;
}

/// Its bound is none; more of it counts from then for its whole time.
TEST(a_jump_is_held) {
  for (const double side : {1.0, -1.0}) {
    // In floating point the one before or after it is what is looked for.
    double jumped_radps = side * kGyroJump_radps * (1.0 - 1e-15);
    while (side * looked_at(jumped_radps).jumped_radps < kGyroJump_radps) {
      jumped_radps = std::nextafter(jumped_radps, side);
    }
    assert_near(looked_at(jumped_radps).jumped_radps, side * kGyroJump_radps, 0.0);
    assert_near(looked_at(jumped_radps).jump_held_s, 0.0, 0.0);
    assert_near(looked_at(side * kGyroJump_radps * 1.0001).jump_held_s, kGyroJumpHeld_s, 0.0);
    assert_near(looked_at(side * kGyroJump_radps * 1.0001, 1.0).jump_held_s, kGyroJumpHeld_s, 0.0);
  }
  assert_near(looked_at(0.0, 1.0).jump_held_s, 1.0 - kGyroShakeTime_s, 1e-12);
  assert_near(looked_at(0.0, 0.5 * kGyroShakeTime_s).jump_held_s, 0.0, 0.0);
}

/// The noise of the force counts as far as five deviations of what it makes.
TEST(a_jump_is_more_than_noise) {
  const double shaken = 9.0;
  const double most_radps =
      kGyroJumpDeviations * std::sqrt(0.5 * shaken * kGyroShakeTime_s * kGyroJumpTime_s) / 2.0;
  assert_true(most_radps > kGyroJump_radps);
  for (const bool more : {false, true}) {
    LinkAngle state;
    begin_angle(kNoise, shown(0.0, kGravity), state);
    state.then.angle_rad = 0.0;
    state.then.force_mps2 = {0.0, kGravity};
    state.last.period_s = kGyroShakeTime_s;
    state.jumps_radps =
        most_radps * (more ? 1.0001 : 0.9999) / (1.0 - kGyroShakeTime_s / kGyroJumpTime_s);
    state.shaken = shaken;
    watch_gyro({0.0, 0.0, 1e-9}, {2.0, 0.0}, Eigen::Vector2d::Zero(), state);
    // A reading that explains nothing takes so much of it away, for the next one.
    assert_near(state.shaken, shaken * (1.0 - kGyroShakeTime_s / kGyroShakenTime_s), 1e-9);
    assert_int_equal(state.jump_held_s > 0.0, more);
  }
}

/// What was known of its bias stays; what was not is what its noise says.
TEST(a_beginning_keeps_the_bias) {
  for (const double known : {-1.0, 0.0, 4.0}) {
    LinkAngle state;
    state.bias_radps = 0.25;
    state.bias_variance = known;
    state.jump_held_s = 2.0;
    begin_angle({0.0, 3.0, 0.3}, shown(0.0, kGravity), state);
    assert_near(state.jump_held_s, 2.0, 0.0);  // A jump that is held neither.
    assert_near(state.bias_variance, known > 0.0 ? known : 9.0, 0.0);
    assert_near(state.bias_radps, 0.25, 0.0);
  }
}

TEST(the_least_force_has_no_direction) {
  LinkAngle begun;
  begin_angle(kNoise, shown(0.0, kAngleLeastForce_mps2), begun);
  assert_int_equal(begun.readings, 0);
  begin_angle(kNoise, shown(0.0, std::nextafter(kAngleLeastForce_mps2, 9.0)), begun);
  assert_int_equal(begun.readings, 1);
  for (const double force_mps2 : {0.5 * kAngleLeastForce_mps2, kAngleLeastForce_mps2, kGravity}) {
    LinkAngle state;
    state.angle_variance = 1.0;
    state.then.force_mps2 = {force_mps2, 0.0};
    correct_angle(kNoise, Eigen::Vector2d::Zero(), state);
    assert_int_equal(state.angle_rad != 0.0, force_mps2 > kAngleLeastForce_mps2);
  }
}

/// At rest, and no faster than its noise and its bias may show.
TEST(what_a_gyro_shows_at_rest_is_its_bias) {
  const AngleNoise noise{3.0, 4.0, 0.3};
  const double most_radps = kRestMostDeviations * 5.0;
  for (const double side : {1.0, -1.0}) {
    const auto bias_radps = [&](double rate_radps, bool at_rest) {
      LinkAngle state;
      begin_angle(noise, shown(0.0, kGravity), state);
      carry_angle(noise, shown(rate_radps, kGravity), at_rest, state);
      return side * state.bias_radps;
    };
    const double less_radps = std::nextafter(side * most_radps, 0.0);
    assert_true(bias_radps(less_radps, true) > 1.0);
    assert_near(bias_radps(less_radps, false), 0.0, 0.0);
    assert_near(bias_radps(side * most_radps, true), 0.0, 0.0);
    assert_near(bias_radps(side * most_radps * 1.5, true), 0.0, 0.0);
  }
}

/// Nor one that is as near as that to its pin.
TEST(the_least_lever_tells_nothing) {
  for (const bool more : {false, true}) {
    LinkAngle state;
    begin_angle(kNoise, shown(0.0, kGravity), state);
    const double lever_m = more ? std::nextafter(kGyroLeastLever_m, 9.0) : kGyroLeastLever_m;
    watch_gyro(kNoise, {lever_m, 0.0}, Eigen::Vector2d::Zero(), state);
    assert_int_equal(state.steady_s > 0.0, more);
  }
}
