// SPDX-License-Identifier: Apache-2.0
/// What the machine meets and what its sensors make of it: soil, obstacle, dead time, bias, noise.

#include <cmath>

#include "app/plant/excavator_plant.hpp"
#include "app/plant/excavator_sensors.hpp"
#include "app/plant/spool.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

constexpr double kStep_s = 2e-4;

SoilProfile soil_profile() {
  SoilProfile soil;
  soil.ground_y_m = -1.0;
  soil.bias_n = {50e3, 30e3};
  soil.ramp_m = 0.3;
  soil.sine_ratio = 0.2;
  soil.sine_hz = 0.5;
  soil.random_ratio = 0.1;
  soil.random_hz = 5.0;
  return soil;
}

TEST(soil_pushes_below_ground_only_and_grows_with_depth) {
  SoilProfile profile = soil_profile();
  profile.sine_ratio = 0.0;
  profile.random_ratio = 0.0;
  Soil soil(profile, 1, kStep_s);
  assert_near(soil.step({5.0, -1.0}).norm(), 0.0, 0.0);
  assert_near(soil.step({5.0, 0.3}).norm(), 0.0, 0.0);
  assert_near((soil.step({5.0, -1.1}) - Eigen::Vector2d(50e3, 30e3) / 3.0).norm(), 0.0, 1e-6);
  assert_near((soil.step({5.0, -1.3}) - Eigen::Vector2d(50e3, 30e3)).norm(), 0.0, 1e-6);
  assert_near((soil.step({5.0, -2.2}) - Eigen::Vector2d(50e3, 30e3)).norm(), 0.0, 1e-6);
}

/// Mean, spread and spectrum of 400 s: amplitude 20 % at 0.5 Hz, standard deviation 10 % with half
/// of its power below 5 Hz (first order), both directions alike.
TEST(soil_swings_as_told) {
  Soil soil(soil_profile(), 7, kStep_s);
  constexpr int kSteps = 2000000;
  constexpr double kTwoPi = 6.283185307179586;
  double sum = 0.0;
  double squares = 0.0;
  double in_phase = 0.0;
  double changes = 0.0;
  double last = 0.0;
  for (int n = 1; n <= kSteps; ++n) {
    const Eigen::Vector2d force = soil.step({5.0, -2.0});
    const double swing = force.x() / 50e3 - 1.0;
    assert_near(force.y() / 30e3 - 1.0, swing, 1e-9);
    sum += swing;
    squares += swing * swing;
    in_phase += swing * std::sin(kTwoPi * 0.5 * n * kStep_s);
    // Over 10 ms an Ornstein-Uhlenbeck process of 5 Hz changes by 2 (1 - exp(-2 pi 5 0.01)) of its
    // variance.
    if (n % 50 == 0) {
      changes += (swing - last) * (swing - last);
      last = swing;
    }
  }
  assert_near(sum / kSteps, 0.0, 0.01);
  assert_near(2.0 * in_phase / kSteps, 0.2, 0.01);
  assert_near(squares / kSteps - 0.02, 0.01, 0.001);
  assert_near(changes / (kSteps / 50), 0.01 * 2.0 * (1.0 - std::exp(-kTwoPi * 0.05)), 5e-4);
}

TEST(soil_is_the_same_at_any_step_and_another_with_another_seed) {
  Soil coarse(soil_profile(), 3, 1e-3);
  Soil fine(soil_profile(), 3, 5e-4);
  Soil other(soil_profile(), 4, 1e-3);
  double difference = 0.0;
  for (int n = 0; n < 5000; ++n) {
    static_cast<void>(fine.step({5.0, -2.0}));
    const Eigen::Vector2d force = coarse.step({5.0, -2.0});
    assert_near((force - fine.step({5.0, -2.0})).norm(), 0.0, 1e-6);
    difference = std::max(difference, (force - other.step({5.0, -2.0})).norm());
  }
  assert_true(difference > 5e3);
}

ObstacleProfile rock() {
  ObstacleProfile rock;
  rock.point_m = {4.0, -2.0};
  rock.normal = {1.0, 0.0};
  rock.stiffness_npm = 2e7;
  rock.damping_nspm = 1e5;
  rock.friction = 0.5;
  rock.size_m = 0.3;
  rock.hold_s = 1.0;
  return rock;
}

TEST(a_rock_holds_from_its_first_touch_and_then_is_gone) {
  Obstacle obstacle(rock(), kStep_s);
  assert_near(obstacle.step({4.2, -2.0}).norm(), 0.0, 0.0);
  assert_false(obstacle.touched());
  // 5 mm deep, at rest but for the way in: the spring alone from the second step on.
  static_cast<void>(obstacle.step({3.995, -2.0}));
  assert_true(obstacle.touched());
  assert_near((obstacle.step({3.995, -2.0}) - Eigen::Vector2d(1e5, 0.0)).norm(), 0.0, 1e-6);
  for (int n = 0; n < 4990; ++n) {
    static_cast<void>(obstacle.step({3.995, -2.0}));
  }
  assert_false(obstacle.gone());
  for (int n = 0; n < 20; ++n) {
    static_cast<void>(obstacle.step({3.995, -2.0}));
  }
  assert_true(obstacle.gone());
  assert_near(obstacle.step({3.995, -2.0}).norm(), 0.0, 0.0);
  assert_near(obstacle.step({3.9, -2.0}).norm(), 0.0, 0.0);
}

/// Along its face it gives way where the force is more than friction holds; on the way in it damps.
TEST(a_rock_rubs_and_damps) {
  Obstacle obstacle(rock(), kStep_s);
  static_cast<void>(obstacle.step({4.001, -2.0}));
  const Eigen::Vector2d in = obstacle.step({3.999, -2.0});
  assert_near(in.x(), 2e4 + 1e5 * 0.002 / kStep_s, 1.0);
  static_cast<void>(obstacle.step({3.995, -2.0}));
  // On the way out the spring alone: a rock does not hold back.
  assert_near(obstacle.step({3.996, -2.0}).x(), 8e4, 1e-6);
  static_cast<void>(obstacle.step({3.995, -2.0}));
  const Eigen::Vector2d little = obstacle.step({3.995, -2.001});
  assert_near(little.y(), 2e4, 1e-6);
  const Eigen::Vector2d much = obstacle.step({3.995, -2.01});
  assert_near(much.y(), 0.5 * much.x(), 1e-6);
  const Eigen::Vector2d back = obstacle.step({3.995, -2.008});
  assert_near(back.y(), 0.5 * back.x() - 2e7 * 0.002, 1e-3);
  assert_near(obstacle.step({3.995, -2.31}).norm(), 0.0, 0.0);
  assert_near(obstacle.step({3.69, -2.0}).norm(), 0.0, 0.0);
}

TEST(dead_time_is_a_pure_delay) {
  DeadTime delay(0.001, kStep_s);
  for (int n = 1; n <= 20; ++n) {
    assert_near(delay.step(n), n > 5 ? n - 5 : 0.0, 0.0);
  }
  DeadTime none(0.0, kStep_s);
  assert_near(none.step(3.0), 3.0, 0.0);
}

/// The plant's spool does not stir before its dead time, and then as without one.
TEST(a_spool_waits_its_dead_time) {
  ExcavatorPlantProfile profile = machine_22t();
  ExcavatorPlant prompt(profile, {0.6, 0.7, 0.5});
  profile.dead_time = {0.15, 0.0, 0.0};
  ExcavatorPlant late(profile, {0.6, 0.7, 0.5});
  prompt.set_duty({0.4, 0.0, 0.0}, true);
  late.set_duty({0.4, 0.4, 0.0}, true);
  late.advance(150 * kMillisecondUs);
  assert_near(late.spool_travels_ratio()[kBoom], 0.0, 0.0);
  assert_true(late.spool_travels_ratio()[kArm] > 0.3);
  prompt.advance(50 * kMillisecondUs);
  late.advance(50 * kMillisecondUs);
  assert_near(late.spool_travels_ratio()[kBoom], prompt.spool_travels_ratio()[kBoom], 1e-12);
  assert_true(late.spool_travels_ratio()[kBoom] > 0.1);
}

/// Over many seeds the bias fills its range evenly; the noise has its standard deviation.
/// Each cycle's reading, 0.1 m/s: a sound sensor that is told to be old shows what was 25 ms ago.
TEST(a_stroke_can_be_old) {
  plant::ExcavatorPlantProfile profile;
  profile.sensors.stroke_age_s[kArm] = 0.025;
  FaultySensors sensors(profile);
  for (int cycle = 0; cycle < 20; ++cycle) {
    const double at_m = 0.5 + 0.001 * cycle;
    const double shown_m = sensors.stroke(kArm, at_m, {}).value;
    assert_near(shown_m, std::max(0.5, at_m - 0.0025), 1e-12);
    assert_near(sensors.stroke(kBoom, at_m, {}).value, at_m, 1e-12);
  }
}

TEST(sensors_err_within_their_bounds) {
  const SensorErrors errors = machine_22t().sensors;
  constexpr int kSeeds = 2000;
  double most = 0.0;
  double squares = 0.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const SensorModel sensors(errors, static_cast<std::uint64_t>(seed));
    const double bias = sensors.stroke_m(kArm, 0.5) - 0.5;
    most = std::max(most, std::abs(bias));
    squares += bias * bias;
  }
  assert_true(most <= errors.stroke_bias_m + errors.stroke_resolution_m && most > 0.00195);
  assert_near(std::sqrt(squares / kSeeds), errors.stroke_bias_m / std::sqrt(3.0), 5e-5);

  // Of each pressure too: exact but for its bias without noise.
  SensorErrors quiet = errors;
  quiet.pressure_noise_ratio = 0.0;
  const double most_pa = errors.pressure_bias_ratio * errors.pressure_range_pa;
  double cap_squares = 0.0;
  double rod_squares = 0.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    SensorModel biased(quiet, static_cast<std::uint64_t>(seed));
    const double cap_pa = biased.cap_pressure_pa(kArm, 15e6) - 15e6;
    const double rod_pa = biased.rod_pressure_pa(kArm, 15e6) - 15e6;
    assert_true(std::abs(cap_pa) <= most_pa && std::abs(rod_pa) <= most_pa && cap_pa != rod_pa);
    assert_near(biased.cap_pressure_pa(kArm, 15e6) - 15e6, cap_pa, 0.0);
    cap_squares += cap_pa * cap_pa;
    rod_squares += rod_pa * rod_pa;
  }
  assert_near(std::sqrt(cap_squares / kSeeds), most_pa / std::sqrt(3.0), 3e4);
  assert_near(std::sqrt(rod_squares / kSeeds), most_pa / std::sqrt(3.0), 3e4);

  SensorModel sensors(errors, 5);
  constexpr int kReadings = 20000;
  double sum = 0.0;
  double noise = 0.0;
  for (int n = 0; n < kReadings; ++n) {
    const double shown = sensors.cap_pressure_pa(kBoom, 15e6) - 15e6;
    sum += shown;
    noise += shown * shown;
  }
  const double bias_pa = sum / kReadings;
  assert_true(std::abs(bias_pa) < errors.pressure_bias_ratio * errors.pressure_range_pa + 2e4);
  assert_near(std::sqrt(noise / kReadings - bias_pa * bias_pa),
              errors.pressure_noise_ratio * errors.pressure_range_pa, 2e4);
}
