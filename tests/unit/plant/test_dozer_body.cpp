// SPDX-License-Identifier: Apache-2.0
// The dozer's half-vehicle on ground of all kinds: (15) - (17).

#include <algorithm>
#include <numeric>

#include "app/plant/dozer_ground.hpp"
#include "app/plant/dozer_half_vehicle.hpp"
#include "app/plant/dozer_hst_path.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

constexpr double kStep = 5e-4;
constexpr double kWeight = 8900.0 * 9.80665;
constexpr double kSag = kWeight / (10 * 6.0e5);

DozerPlantProfile at(double start_m) {
  DozerPlantProfile profile = dozer_9t();
  profile.start_position_m = start_m;
  return profile;
}

/// Level, then down at the slope from x = 2 to 12, then level.
Terrain ramp(double slope) {
  Terrain terrain(-10.0, 30.0, 0.02);
  terrain.cut({2.0, 0.0}, {12.0, -10.0 * slope});
  terrain.cut({12.0, -10.0 * slope}, {31.0, -10.0 * slope});
  return terrain;
}

void run(HalfVehicle& body, const Terrain& terrain, double traction_n, double duration_s) {
  for (int i = 0; i < static_cast<int>(std::lround(duration_s / kStep)); ++i) {
    body.step(terrain, traction_n, kStep);
  }
}

TEST(it_starts_in_its_sag) {
  const Terrain terrain(-10.0, 30.0, 0.02);
  HalfVehicle body(at(-3.0));
  assert_near(body.load_n(), kWeight, 1e-6);
  run(body, terrain, 0.0, 1.0);
  assert_near(body.height_m(), 0.0, 1e-9);
  assert_near(body.pitch_rad(), 0.0, 1e-9);
  assert_near(body.position_m(), -3.0, 1e-9);
  assert_near(body.velocity_mps(), 0.0, 1e-9);
  assert_near(body.load_n(), kWeight, 1e-3);
  for (int i = 0; i < 10; ++i) {
    assert_near(body.wheel_loads_n()[static_cast<std::size_t>(i)], kWeight / 10, 1e-3);
  }
  assert_near(body.wheel_place_m(0), -1.2, 1e-12);
  assert_near(body.wheel_place_m(3), -1.2 + 2.4 * 3.0 / 9.0, 1e-12);
  assert_near(body.wheel_place_m(9), 1.2, 1e-12);
}

// Parallel to a slope, its origin on it: the sag is upright, as the springs are.
TEST(on_a_slope_it_stands_parallel_to_it) {
  const double slope = 0.2;
  const Terrain terrain = ramp(slope);
  HalfVehicle body(at(-3.0));
  for (int i = 0; i < 60000 && body.position_m() < 7.0; ++i) {
    const double wanted = 8900.0 * 2.0 * (1.0 - body.velocity_mps()) + 0.08 * kWeight -
                          kWeight * -std::sin(body.pitch_rad());
    body.step(terrain, wanted, kStep);
  }
  for (int i = 0; i < 8000; ++i) {
    body.step(terrain, kWeight * std::sin(body.pitch_rad()) - 3e4 * body.velocity_mps(), kStep);
  }
  assert_near(body.velocity_mps(), 0.0, 1e-4);
  // The mass centre stands before the middle of the wheels by h sin: the front ones carry more.
  // That tips it further, by J'x = m g (h + sag) sin / sum(k l^2).
  assert_true(body.pitch_rad() < -std::atan(slope));
  double sum = 0.0;
  for (int i = 0; i < 10; ++i) {
    sum += 6.0e5 * std::pow(body.wheel_place_m(i), 2);
  }
  const double tip = kWeight * (0.85 + kSag) * std::sin(std::atan(slope)) / sum;
  assert_near(body.pitch_rad(), -std::atan(slope) - tip, 0.05 * tip);
  assert_near(body.load_n(), kWeight, 1.0);
  const double ground = -slope * (body.position_m() - 2.0);
  assert_near(body.height_m(), ground, 2e-3);
}

// (17): from rest with a given force, and rolled out.
/// Seconds on a slope, held there by a traction that turns the body or does not; or pushing.
double pitch_held_on(double slope, const BodyLoad& load, double push_n) {
  const Terrain terrain = ramp(slope);
  HalfVehicle body(at(7.0));
  for (int i = 0; i < 10000; ++i) {
    const double held_n = kWeight * std::sin(body.pitch_rad()) - 3e4 * body.velocity_mps();
    body.step(terrain, held_n + push_n, kStep, load);
  }
  return body.pitch_rad();
}

// What holds it on a slope turns nothing: the wheels' levers have it already. What it pushes with
// beyond that turns it nose up, unless what it pushes against is as low as its tracks.
TEST(traction_turns_it_by_what_it_pushes_with) {
  const BodyLoad turned{Eigen::Vector2d::Zero(), 0.0, true};
  const double at_rest_rad = pitch_held_on(0.2, {}, 0.0);
  assert_near(pitch_held_on(0.2, turned, 0.0), at_rest_rad, 1e-4);
  const double push_n = 2e4;
  const BodyLoad high{{-push_n, 0.0}, 0.0, true};
  const BodyLoad low{{-push_n, 0.0}, -0.85 * push_n, true};
  double sum = 0.0;
  for (int i = 0; i < 10; ++i) {
    sum += 6.0e5 * std::pow(2.4 * (i / 9.0 - 0.5), 2);
  }
  assert_near(pitch_held_on(0.0, high, push_n), 0.85 * push_n / sum, 2e-4);
  assert_near(pitch_held_on(0.0, low, push_n), 0.0, 1e-5);
}

TEST(force_and_rolling_resistance_accelerate_it) {
  const Terrain terrain(-10.0, 30.0, 0.02);
  HalfVehicle body(at(-3.0));
  run(body, terrain, 20e3, 0.5);
  assert_near(body.velocity_mps(), 0.5 * (20e3 - 0.08 * kWeight) / 8900.0, 0.02);
  const double before = body.velocity_mps();
  run(body, terrain, 0.0, 0.3);
  assert_near(before - body.velocity_mps(), 0.3 * 0.08 * 9.80665, 1e-3);
  run(body, terrain, 0.0, 3.0);
  assert_near(body.velocity_mps(), 0.0, 1e-3);
  HalfVehicle back(at(-3.0));
  run(back, terrain, -20e3, 0.5);
  assert_near(back.velocity_mps(), -0.5 * (20e3 - 0.08 * kWeight) / 8900.0, 0.02);
}

// Along the slope the force accelerates; x has the cosine's share of it.
TEST(on_a_slope_gravity_accelerates_it) {
  const double slope = 0.35;
  const Terrain terrain = ramp(slope);
  HalfVehicle body(at(-1.0));
  while (body.position_m() < 6.0) {
    body.step(terrain, 8900.0 * 20.0 * (1.0 - body.velocity_mps()) + 10e3, kStep);
  }
  const double velocity = body.velocity_mps();
  const double pitch = body.pitch_rad();
  run(body, terrain, 0.0, 0.2);
  const double along = -9.80665 * std::sin(pitch) - 0.08 * 9.80665;
  assert_near(body.velocity_mps() - velocity, 0.2 * along * std::cos(pitch), 0.015);
}

// A ditch as narrow as a cell: the track passes over it.
TEST(a_wheel_is_wider_than_a_notch) {
  Terrain terrain(-10.0, 30.0, 0.02);
  terrain.cut({-1.8, 0.1}, {-1.8, -0.3});
  HalfVehicle body(at(-3.0));
  run(body, terrain, 0.0, 1.0);
  // Its mean is 0.03 m down: 0.3 * 0.02 / 0.2; of a sag of 0.0145 m nothing is left. The others
  // hardly notice.
  assert_near(body.wheel_loads_n()[9], 0.0, 0.0);
  assert_near(body.wheel_loads_n()[0], kWeight / 10, 0.25 * kWeight / 10);
  Terrain shallow(-10.0, 30.0, 0.02);
  shallow.cut({-1.8, 0.1}, {-1.8, -0.05});
  HalfVehicle over(at(-3.0));
  run(over, shallow, 0.0, 1.0);
  assert_near(over.wheel_loads_n()[9], kWeight / 10 - 6.0e5 * 0.005, 1200.0);
  assert_true(over.wheel_loads_n()[9] > 0.6 * kWeight / 10);
}

// Nothing gains energy that nobody gives: dropped by a bit, it comes to rest where it belongs.
TEST(a_drop_is_damped) {
  Terrain terrain(-10.0, 30.0, 0.02);
  HalfVehicle body(at(-3.0));
  terrain.cut({-11.0, -0.05}, {31.0, -0.05});
  double lowest = 0.0;
  double highest_load = 0.0;
  for (int i = 0; i < 6000; ++i) {
    body.step(terrain, 0.0, kStep);
    lowest = std::min(lowest, body.height_m());
    highest_load = std::max(highest_load, body.load_n());
    assert_true(body.load_n() >= 0.0);
  }
  // In the air at first; falling 5 cm less the sag it meets the ground at 0.8 m/s.
  assert_true(highest_load > 2.0 * kWeight);
  assert_true(lowest < -0.052 && lowest > -0.09);
  assert_near(body.height_m(), -0.05, 1e-6);
  assert_near(body.climb_mps(), 0.0, 1e-6);
}

struct Ledge {
  double highest_pitch_rate_radps = 0.0;
  int fewest_wheels = 10;
  bool rear_lifted = false;
  double least_load_n = 1e9;
};

/// Drives at a speed over where the level ground ends.
Ledge over_the_ledge(HalfVehicle& body, const Terrain& terrain, double speed_mps, double to_m) {
  Ledge seen;
  while (body.position_m() < to_m) {
    const double wanted = 8900.0 * 20.0 * (speed_mps - body.velocity_mps()) + 0.08 * kWeight +
                          kWeight * std::sin(body.pitch_rad());
    body.step(terrain, wanted, kStep);
    const auto& loads = body.wheel_loads_n();
    const auto down =
        std::count_if(loads.begin(), loads.begin() + 10, [](double load) { return load > 0.0; });
    seen.fewest_wheels = std::min(seen.fewest_wheels, static_cast<int>(down));
    seen.rear_lifted = seen.rear_lifted || (loads[0] == 0.0 && loads[1] == 0.0);
    seen.highest_pitch_rate_radps =
        std::max(seen.highest_pitch_rate_radps, std::abs(body.pitch_rate_radps()));
    seen.least_load_n =
        std::min(seen.least_load_n, *std::min_element(loads.begin(), loads.begin() + 10));
  }
  return seen;
}

// The wheels push only: the front hangs in the air until the mass centre is over the ledge, then
// the machine tips, its rear lifts, and it settles on the slope.
TEST(over_a_ledge_it_tips) {
  const double slope = 0.35;
  const Terrain terrain = ramp(slope);
  HalfVehicle body(at(-3.0));
  const Ledge level = over_the_ledge(body, terrain, 1.0, 0.5);
  assert_int_equal(level.fewest_wheels, 10);
  const Ledge out = over_the_ledge(body, terrain, 1.0, 1.6);
  // Two thirds of a second before the tipping: still almost level, with wheels in the air.
  assert_true(body.pitch_rad() > -0.08);
  assert_true(out.fewest_wheels <= 8);
  const Ledge tipping = over_the_ledge(body, terrain, 1.0, 3.2);
  assert_true(tipping.rear_lifted);
  assert_true(tipping.highest_pitch_rate_radps > 3.0 * out.highest_pitch_rate_radps);
  assert_true(tipping.least_load_n >= 0.0);
  static_cast<void>(over_the_ledge(body, terrain, 1.0, 7.0));
  assert_near(body.pitch_rad(), -std::atan(slope), 0.05);
  assert_near(body.pitch_rate_radps(), 0.0, 0.01);
  assert_near(body.height_m(), -slope * (body.position_m() - 2.0), 0.01);
  // Its velocity goes along the slope.
  assert_near(body.climb_mps(), -slope * body.velocity_mps(), 0.02);
  assert_near(body.ground_speed_mps(), body.velocity_mps() / std::cos(std::atan(slope)), 0.02);
}

struct Parked {
  double moved_m = 0.0;
  double speed_mps = 0.0;
};

/// Comes onto the slope at 1 m/s by a force, then its tracks are braked by the transmission's
/// brakes; what it does from `after_s` on for 10 s.
Parked park_on(double slope, bool brake, double after_s) {
  DozerPlantProfile profile = at(-1.0);
  const Terrain terrain = ramp(slope);
  HalfVehicle body(profile);
  static_cast<void>(over_the_ledge(body, terrain, 1.0, 6.0));
  std::array<HstPath, 2> path{HstPath(profile, kLeft), HstPath(profile, kRight)};
  std::array<Traction, 2> traction{Traction(profile), Traction(profile)};
  Parked parked;
  double from = 0.0;
  const int wait = static_cast<int>(std::lround(after_s / kStep));
  for (int i = 0; i < wait + 20000; ++i) {
    if (i == wait) {
      from = body.position_m();
    }
    double force = 0.0;
    for (std::size_t t = 0; t < 2; ++t) {
      const double one = traction[t].step(path[t].track_speed_mps(), body.ground_speed_mps(),
                                          0.5 * body.load_n(), kStep);
      path[t].step(157.08, one, brake);
      force += one;
    }
    body.step(terrain, force, kStep);
  }
  parked.moved_m = body.position_m() - from;
  parked.speed_mps = body.velocity_mps();
  return parked;
}

TEST(the_brake_holds_on_a_slope) {
  const Parked parked = park_on(0.35, true, 6.0);
  assert_near(parked.moved_m, 0.0, 1e-4);
  assert_near(parked.speed_mps, 0.0, 1e-6);
}

// Without, the transmission at no displacement holds all but its leakage.
TEST(without_the_brake_it_creeps) {
  const Parked parked = park_on(0.35, false, 6.0);
  assert_true(parked.moved_m > 0.05);
  assert_true(parked.speed_mps > 0.005 && parked.speed_mps < 0.1);
}
