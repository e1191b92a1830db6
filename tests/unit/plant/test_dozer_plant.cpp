// SPDX-License-Identifier: Apache-2.0
// The simulated dozer as a whole.

#include "app/plant/dozer_plant.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "app/plant/dozer_sensors.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

constexpr TimeUs kCycle = 10 * kMillisecondUs;

/// A trench of 0.2 m with flat ends.
double trench_m(double x) {
  const double down = std::clamp((x - 1.0) / 2.0, 0.0, 1.0);
  const double up = std::clamp((x - 7.0) / 2.0, 0.0, 1.0);
  return -0.2 * (down - up);
}

/// A crude operator: full pump, blade in proportion to its error.
void grade_for(DozerPlant& plant, TimeUs duration_us, double motor = 0.7) {
  plant.set_brake(false);
  plant.set_displacements({1.0, 1.0}, {motor, motor});
  for (TimeUs t = 0; t < duration_us; t += kCycle) {
    const Eigen::Vector2d edge = plant.cutting_edge_m();
    const double opening = std::clamp(20.0 * (edge.y() - trench_m(edge.x())), -0.8, 0.8);
    plant.set_blade_duty(std::copysign(0.2 + std::abs(opening), opening), true);
    plant.advance(kCycle);
  }
}

std::vector<double> state_of(const DozerPlant& plant) {
  return {plant.position_m(),
          plant.height_m(),
          plant.pitch_rad(),
          plant.velocity_mps(),
          plant.climb_mps(),
          plant.pitch_rate_radps(),
          plant.blade_stroke_m(),
          plant.blade_velocity_mps(),
          plant.track_speeds_mps()[0],
          plant.path(0).pressures_pa()[0],
          plant.path(1).pressures_pa()[1],
          plant.cylinder().cap().pressure_pa(),
          plant.terrain().height_m(2.5)};
}

TEST(at_rest_it_stays_at_rest) {
  DozerPlant plant(dozer_9t());
  assert_near(plant.position_m(), -3.0, 0.0);
  assert_near(plant.height_m(), 0.0, 0.0);
  assert_near(plant.cutting_edge_m().x(), -3.0 + 0.6718 + std::sqrt(1.6 * 1.6 - 0.386 * 0.386),
              1e-9);
  assert_near(plant.cutting_edge_m().y(), 0.0, 1e-9);
  assert_near(plant.path(0).pressures_pa()[0], 2.5e6, 0.0);
  for (const bool brake : {true, false}) {
    plant.set_brake(brake);
    for (int i = 0; i < 1000; ++i) {
      plant.advance(kCycle);
      assert_near(plant.position_m(), -3.0, 1e-9);
      assert_near(plant.height_m(), 0.0, 1e-9);
      assert_near(plant.pitch_rad(), 0.0, 1e-9);
      assert_near(plant.velocity_mps(), 0.0, 1e-9);
      assert_near(plant.blade_velocity_mps(), 0.0, 2e-3);
      assert_near(plant.track_speeds_mps()[0], 0.0, 1e-9);
    }
  }
  // Oil at rest only loses pressure.
  assert_true(plant.cylinder().rod().pressure_pa() < 3.6e6);
  assert_near(plant.path(0).pressures_pa()[0], 2.5e6, 1.0);
}

// The figures that the profile was made for: 1.8 m/s at 1500 rpm, on the level a little more.
TEST(on_the_level_it_reaches_its_speed) {
  DozerPlant plant(dozer_9t());
  plant.set_brake(false);
  plant.set_displacements({1.0, 1.0}, {0.35, 0.35});
  plant.advance(8 * kSecondUs);
  assert_true(plant.velocity_mps() > 1.80 && plant.velocity_mps() < 1.90);
  const double torque = 0.35 * 0.5 * 0.08 * 8900.0 * 9.80665;
  assert_near(0.9 * plant.path(0).motor_torque_nm(), torque, 0.02 * torque);
  assert_near(plant.slips()[0], plant.slips()[1], 0.0);
  // A slip of 0.2 %, by hand from 3490 N of 34.9 kN.
  assert_near(plant.track_speeds_mps()[0] / plant.velocity_mps() - 1.0, 0.0018, 2e-4);
  plant.set_displacements({1.0, 1.0}, {1.0, 1.0});
  plant.advance(8 * kSecondUs);
  assert_near(plant.velocity_mps(), 0.65, 0.02);
  plant.set_engine_radps(104.72);
  plant.advance(3 * kSecondUs);
  assert_near(plant.velocity_mps(), 0.65 * 2.0 / 3.0, 0.02);
  plant.set_displacements({-1.0, -1.0}, {1.0, 1.0});
  plant.advance(3 * kSecondUs);
  assert_near(plant.velocity_mps(), -0.65 * 2.0 / 3.0, 0.02);
  plant.set_displacements({std::nan(""), 0.0}, {INFINITY, 1.0});
  plant.advance(3 * kSecondUs);
  assert_near(plant.velocity_mps(), 0.0, 1e-4);
  plant.set_engine_radps(std::nan(""));
  assert_near(plant.engine_radps(), 0.0, 0.0);
}

// The trench that the blade has cut is what the tracks go down into, and out of.
TEST(the_tracks_follow_what_the_blade_cut) {
  DozerPlant plant(dozer_9t());
  double lowest = 0.0;
  double steepest_down = 0.0;
  double steepest_up = 0.0;
  std::vector<double> before(2300, 0.0);
  for (int i = 0; i < 1500; ++i) {
    grade_for(plant, kCycle);
    lowest = std::min(lowest, plant.height_m());
    steepest_down = std::min(steepest_down, plant.pitch_rad());
    steepest_up = std::max(steepest_up, plant.pitch_rad());
    for (std::size_t n = 0; n < before.size(); ++n) {
      const double height = plant.terrain().height_m(-9.0 + 0.02 * static_cast<double>(n));
      assert_true(height <= before[n]);
      before[n] = height;
    }
  }
  assert_true(plant.position_m() > 9.5);
  for (double x = 3.2; x < 6.8; x += 0.1) {
    assert_near(plant.terrain().height_m(x), -0.2, 0.08);
  }
  assert_near(plant.terrain().height_m(0.0), 0.0, 0.005);
  assert_true(lowest < -0.17 && lowest > -0.30);
  assert_true(steepest_down < -0.09 && steepest_up > 0.09);
}

// Rates are the derivatives of what they belong to, and the edge is where pose and blade put it.
TEST(pose_rates_and_edge_belong_together) {
  DozerPlant plant(dozer_9t());
  const auto pose_of = [&plant] {
    return Eigen::Vector4d(plant.position_m(), plant.height_m(), plant.pitch_rad(),
                           plant.blade_stroke_m());
  };
  double steepest = 0.0;
  for (int i = 0; i < 900; ++i) {
    grade_for(plant, kCycle);
    const Eigen::Vector4d before = pose_of();
    plant.advance(500);
    const Eigen::Vector4d change = (pose_of() - before) / 5e-4;
    const Eigen::Vector4d rate(plant.velocity_mps(), plant.climb_mps(), plant.pitch_rate_radps(),
                               plant.blade_velocity_mps());
    for (int k = 0; k < 4; ++k) {
      assert_near(change[k], rate[k], 2e-3);
    }
    const double pitch = plant.pitch_rad();
    const double angle = plant.blade().angle_rad() - std::asin(0.386 / 1.60);
    const Eigen::Vector2d in_body(0.6718 + 1.60 * std::cos(angle), 0.386 + 1.60 * std::sin(angle));
    const Eigen::Vector2d origin(plant.position_m(), plant.height_m());
    const Eigen::Vector2d edge = origin + Eigen::Rotation2Dd(pitch) * in_body;
    assert_near((plant.cutting_edge_m() - edge).norm(), 0.0, 1e-9);
    steepest = std::max(steepest, std::abs(pitch));
  }
  assert_true(steepest > 0.08);
}

TEST(it_parks_on_the_slope_that_it_cut) {
  DozerPlant plant(dozer_9t());
  while (plant.position_m() < 2.3) {
    grade_for(plant, kCycle);
  }
  plant.set_displacements({0.0, 0.0}, {1.0, 1.0});
  plant.set_blade_duty(0.0, false);
  plant.advance(2 * kSecondUs);
  plant.set_brake(true);
  plant.advance(3 * kSecondUs);
  assert_true(plant.pitch_rad() < -0.06);
  const double x = plant.position_m();
  plant.advance(20 * kSecondUs);
  assert_near(plant.position_m(), x, 1e-3);
  assert_near(plant.velocity_mps(), 0.0, 1e-5);
}

// With the brake on the tracks stand, whatever the pumps do.
TEST(the_brake_stalls_the_transmission) {
  DozerPlant plant(dozer_9t());
  plant.set_displacements({1.0, 1.0}, {1.0, 1.0});
  plant.advance(3 * kSecondUs);
  assert_near(plant.track_speeds_mps()[0], 0.0, 0.0);
  assert_near(plant.position_m(), -3.0, 1e-9);
  assert_true(plant.path(0).pressures_pa()[0] > 44e6);
}

// One path that runs away drags its track over the ground, as the other one holds; both take the
// machine along.
TEST(a_path_can_be_broken) {
  DozerPlant plant(dozer_9t());
  plant.set_brake(false);
  plant.set_pump_fault(kLeft, {1.0, 0.0, false});
  plant.advance(3 * kSecondUs);
  assert_near(plant.pump_ratios()[kLeft], 1.0, 1e-6);
  assert_near(plant.pump_ratios()[kRight], 0.0, 1e-6);
  assert_true(plant.track_speeds_mps()[kLeft] > plant.track_speeds_mps()[kRight] + 0.1);
  assert_near(plant.path(kRight).pressures_pa()[1], 10.7e6, 1e6);
  plant.set_pump_fault(kRight, {1.0, 0.0, false});
  plant.advance(10 * kSecondUs);
  assert_near(plant.velocity_mps(), 0.65, 0.02);
  plant.set_motor_fault(kRight, {0.5, 0.0, false});
  plant.set_pump_fault(kLeft, {});
  plant.set_pump_fault(kRight, {std::nullopt, 0.0, true});
  plant.set_displacements({0.5, 0.5}, {1.0, 1.0});
  plant.advance(3 * kSecondUs);
  assert_near(plant.pump_ratios()[kLeft], 0.5, 1e-6);
  assert_near(plant.pump_ratios()[kRight], -0.5, 1e-6);
  assert_near(plant.motor_ratios()[kLeft], 1.0, 1e-6);
  assert_near(plant.motor_ratios()[kRight], 0.5, 1e-6);
}

TEST(the_same_calls_give_the_same_numbers) {
  DozerPlant one(dozer_9t());
  DozerPlant other(dozer_9t());
  grade_for(one, 8 * kSecondUs);
  grade_for(other, 8 * kSecondUs);
  assert_true(state_of(one) == state_of(other));
  // In whatever pieces time comes.
  repeat(100, [&] { one.advance(1300); });
  other.advance(130000);
  assert_true(state_of(one) == state_of(other));
}

TEST(a_shorter_step_changes_little) {
  DozerPlantProfile fine = dozer_9t();
  fine.step_us = 250;
  DozerPlant coarse_plant(dozer_9t());
  DozerPlant fine_plant(fine);
  for (int i = 0; i < 14; ++i) {
    grade_for(coarse_plant, kSecondUs);
    grade_for(fine_plant, kSecondUs);
    assert_near(coarse_plant.position_m(), fine_plant.position_m(), 0.002);
    assert_near(coarse_plant.height_m(), fine_plant.height_m(), 0.002);
    assert_near(coarse_plant.pitch_rad(), fine_plant.pitch_rad(), 0.002);
    assert_near(coarse_plant.velocity_mps(), fine_plant.velocity_mps(), 0.01);
    assert_near(coarse_plant.blade_stroke_m(), fine_plant.blade_stroke_m(), 0.001);
  }
  assert_true(coarse_plant.position_m() > 9.0);
}

TEST(sensors_round_and_nothing_else_without_a_seed, DozerSensorErrors errors) {
  errors.stroke_resolution_m = 1e-4;
  errors.height_bias_m = 0.002;
  errors.height_noise_m = 0.0015;
  errors.pitch_noise_rad = 1.0;
  DozerSensorModel exact(errors, std::nullopt);
  assert_near(exact.stroke_m(0.12344), 0.1234, 1e-12);
  assert_near(exact.stroke_m(0.12346), 0.1235, 1e-12);
  assert_near(exact.height_m(0.3), 0.3, 0.0);
  assert_near(exact.pitch_rad(0.1), 0.1, 0.0);
  errors.stroke_resolution_m = 0.0;
  assert_near(DozerSensorModel(errors, std::nullopt).stroke_m(0.12344), 0.12344, 0.0);
}

struct Statistics {
  double mean = 0.0;
  double deviation = 0.0;
};

template <class Read>
Statistics statistics_of(const Read& read) {
  constexpr int kReadings = 20000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kReadings; ++i) {
    const double value = read();
    sum += value;
    squares += value * value;
  }
  const double mean = sum / kReadings;
  return {mean, std::sqrt(squares / kReadings - mean * mean)};
}

TEST(sensor_noise_has_its_deviation) {
  DozerSensorErrors errors{1e-4, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.0};
  DozerSensorModel sensors(errors, 7);
  const auto check = [](double expected_deviation, const auto& read) {
    const Statistics seen = statistics_of(read);
    assert_near(seen.mean, 1.0, 0.03 * expected_deviation);
    assert_near(seen.deviation, expected_deviation, 0.03 * expected_deviation);
  };
  check(0.01, [&] { return sensors.position_m(1.0); });
  check(0.02, [&] { return sensors.height_m(1.0); });
  check(0.03, [&] { return sensors.pitch_rad(1.0); });
  check(0.04, [&] { return sensors.velocity_mps(1.0); });
  check(0.05, [&] { return sensors.climb_mps(1.0); });
  check(0.06, [&] { return sensors.pitch_rate_radps(1.0); });
  check(0.07, [&] { return sensors.track_speed_mps(1.0); });
  assert_near(sensors.stroke_m(0.12344), 0.1234, 1e-12);
}

TEST(the_height_bias_is_constant_and_within, DozerSensorErrors errors) {
  errors.height_bias_m = 0.002;
  double least = 1.0;
  double most = -1.0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    DozerSensorModel sensors(errors, seed);
    const double bias = sensors.height_m(0.0);
    assert_near(sensors.height_m(0.5) - 0.5, bias, 1e-12);
    assert_near(DozerSensorModel(errors, seed).height_m(0.0), bias, 0.0);
    assert_true(std::abs(bias) <= 0.002);
    least = std::min(least, bias);
    most = std::max(most, bias);
  }
  assert_true(least < -0.0015 && most > 0.0015);
}
