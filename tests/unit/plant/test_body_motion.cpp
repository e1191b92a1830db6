// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "app/plant/dozer_half_vehicle.hpp"
#include "firmware/dozer/travel/body_motion.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

const DozerBody& body() { return test::dozer().profile.body; }

Driving standing_at(double x_m, double speed_mps) {
  return {motion_of(body(), {0.0, 0.0}, 0.0, 0.0), x_m, speed_mps};
}

Driving after(const GradeProfile& design, Driving from, double lead_s, const BodyBias& bias = {}) {
  const GroundMap ground = test::cut_to(design, from.x_m);
  return drive_on(body(), ground, design, from, {from.speed_mps, 0.2}, lead_s, bias);
}

TEST(motion_and_stand_are_the_same_thing) {
  const BodyMotion motion = motion_of(body(), {0.3, 0.2}, 0.1, -0.4);
  const Stand stand = stand_of(body(), motion);
  assert_near(stand.height_m, 0.3, 1e-12);
  assert_near(stand.pitch_rad, 0.2, 1e-12);
  assert_near(origin_climb_mps(body(), motion), 0.1, 1e-12);
}

TEST(on_the_level_it_rests) {
  const Driving on = after(GradeProfile(test::level(0.0)), standing_at(0.0, 1.0), 0.5);
  assert_near(on.x_m, 0.5, 1e-9);
  assert_near(stand_of(body(), on.motion).height_m, 0.0, 1e-9);
  assert_near(on.motion.pitch_rad, 0.0, 1e-9);
}

TEST(no_lead_changes_nothing) {
  const Driving on = after(GradeProfile(test::bend(-0.3, 0.3)), standing_at(9.9, 1.0), 0.0);
  assert_near(on.x_m, 9.9, 0.0);
  assert_near(on.motion.pitch_rad, 0.0, 0.0);
}

/// It gets faster and slower as it is told.
TEST(it_goes_over_to_the_wanted_speed) {
  const GradeProfile design(test::level(0.0));
  const Driving on = drive_on(body(), test::cut_to(design, 0.0), design, standing_at(0.0, 1.0),
                              {0.8, 0.2}, 0.1, {});
  assert_near(on.speed_mps, 0.9, 1e-9);
}

/// Over a crest, against the simulation's own half-vehicle, which takes 40 steps for one of these:
/// millimetres after half a second of tipping.
TEST(it_tips_as_the_simulated_body_does) {
  const GradeProfile design(test::bend(-0.3, 0.3));
  plant::DozerPlantProfile machine = test::dozer().plant;
  constexpr double kSpeed_mps = 0.6;
  constexpr double kStart_m = 9.5;
  machine.start_position_m = kStart_m;
  plant::Terrain terrain(0.0, 40.0, 0.02);
  for (double x_m = 0.0; x_m < 38.0; x_m += 0.02) {
    terrain.cut({x_m, design.at(x_m).height_m}, {x_m + 0.02, design.at(x_m + 0.02).height_m});
  }
  plant::HalfVehicle truth(machine);
  Driving model = standing_at(kStart_m, kSpeed_mps);
  const GroundMap ground = test::cut_to(design, kStart_m);
  double pitched_rad = 0.0;
  while (truth.position_m() < 10.6) {
    for (int n = 0; n < 40; ++n) {
      const double hold_n = 1e6 * (kSpeed_mps - truth.velocity_mps());
      truth.step(terrain, hold_n, 5e-4);
    }
    // Where the true one is, which has to gain its speed first.
    model.speed_mps = (truth.position_m() - model.x_m) / 0.02;
    model = drive_on(body(), ground, design, model, {model.speed_mps, 0.2}, 0.02, {});
    assert_near(stand_of(body(), model.motion).height_m, truth.height_m(), 3e-3);
    assert_near(model.motion.pitch_rad, truth.pitch_rad(), 5e-3);
    pitched_rad = truth.pitch_rad();
  }
  assert_true(pitched_rad < -0.2);
}

/// Ground that the map does not know of makes the body move as nobody expects: found within some
/// tenths of a second, and told.
TEST(what_it_does_not_know_of_is_found) {
  const GradeProfile design(test::level(0.0));
  const GroundMap ground = test::cut_to(design, 0.0);
  const BodyBias unknown{0.4, -0.8};
  Foretelling found;
  Driving real = standing_at(0.0, 0.0);
  for (int n = 0; n < 60; ++n) {
    next_foretelling(body(), ground, design, real, 0.01, found);
    real.motion = next_motion(body(), ground, design, 0.0, 0.0, real.motion, 0.01, unknown);
  }
  assert_near(found.bias.climb_mps2, 0.4, 0.02);
  assert_near(found.bias.pitch_radps2, -0.8, 0.04);
}

/// However it starts, it stays within what a machine can do.
TEST(it_does_not_run_away) {
  const GradeProfile design(test::level(0.0));
  Driving wild{motion_of(body(), {-2.0, 0.7}, -50.0, 50.0), 0.0, 3.0};
  const Driving on = after(design, wild, 0.4);
  assert_true(std::abs(on.motion.pitch_rad) <= 0.8);
  assert_true(std::abs(on.motion.climb_mps) <= 3.0);
  assert_true(std::isfinite(on.motion.centre_m));
}
