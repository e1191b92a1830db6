// SPDX-License-Identifier: Apache-2.0
// The simulated dozer whose blade tilts: roll, tilt, and the flow that lift and tilt share.

#include "app/plant/dozer_plant.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

DozerPlantProfile tilting() {
  static const DozerPlantProfile profile =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t_tilt")).plant;
  return profile;
}

constexpr double kStep_s = 0.0005;

/// Ground with this slope across, level along.
Terrain raised(double height_m) {
  Terrain terrain(-10.0, 10.0, 0.02);
  terrain.fill(-11.0, 11.0, height_m);
  return terrain;
}

TEST(at_rest_both_tracks_carry_the_same) {
  DozerPlant plant(tilting());
  plant.advance(kSecondUs);
  assert_near(plant.roll_rad(), 0.0, 1e-9);
  assert_near(plant.body().track_load_n(kLeft), 0.5 * 8900.0 * 9.80665, 1.0);
  assert_near(plant.body().track_load_n(kRight), 0.5 * 8900.0 * 9.80665, 1.0);
  assert_near(plant.height_m(), 0.0, 1e-9);
}

/// Its springs let the mass centre tip it a little further than the ground does: by m g h sin over
/// the roll stiffness.
TEST(on_a_slope_across_it_rolls_with_it) {
  const DozerPlantProfile profile = tilting();
  const double slope = 0.05;
  const double gauge_m = 2.0 * profile.machine.body.half_gauge_m;
  const Terrain left = raised(slope * gauge_m);
  const Terrain right = raised(0.0);
  HalfVehicle body(profile);
  for (int i = 0; i < 8000; ++i) {
    body.step(TracksGround{left, right}, 0.0, kStep_s);
  }
  const double stiffness_nmprad = 10 * 6.0e5 * 0.9 * 0.9;
  const double tips_rad = 8900.0 * 9.80665 * 0.85 * slope / stiffness_nmprad;
  assert_near(body.roll_rad(), slope + tips_rad, 0.1 * tips_rad);
  assert_near(body.height_m(), 0.5 * slope * gauge_m, 2e-4);
  assert_true(body.track_load_n(kLeft) < body.track_load_n(kRight));
  assert_near(body.load_n(), 8900.0 * 9.80665, 1.0);
}

TEST(a_duty_tilts_the_blade_and_its_ends_cut) {
  DozerPlant plant(tilting());
  plant.set_tilt_duty(0.6, true);
  plant.advance(300 * kMillisecondUs);
  const double angle_rad = plant.tilt()->angle_rad();
  assert_true(std::abs(angle_rad) > 0.03);
  assert_near(plant.tilt()->linkage().stroke_m(angle_rad), plant.tilt()->stroke_m(), 1e-12);
  assert_true(plant.tilt()->stroke_m() > plant.tilt()->linkage().stroke_m(0.0));
  const double up_m = plant.edge_point_m(1.0).z() - plant.edge_point_m(-1.0).z();
  assert_near(up_m, 2.0 * std::sin(angle_rad + plant.roll_rad()), 1e-3);
  // Neutral, and disabled, it stays.
  plant.set_tilt_duty(1.0, false);
  plant.advance(200 * kMillisecondUs);
  const double rest_rad = plant.tilt()->angle_rad();
  plant.advance(kSecondUs);
  assert_near(plant.tilt()->angle_rad(), rest_rad, 1e-4);
  // Driving on, the lower end cuts and the higher one does not.
  plant.set_brake(false);
  plant.set_displacements({0.5, 0.5}, {1.0, 1.0});
  plant.advance(2 * kSecondUs);
  const double x_m = plant.cutting_edge_m().x() - 0.5;
  const CrossGround& ground = *plant.cross_ground();
  const auto lower = up_m > 0.0 ? CrossGround::kRightEnd : CrossGround::kLeftEnd;
  const auto higher = up_m > 0.0 ? CrossGround::kLeftEnd : CrossGround::kRightEnd;
  assert_true(ground.line[lower].height_m(x_m) < -0.03);
  assert_near(ground.line[higher].height_m(x_m), 0.0, 0.0);
}

/// The pump can feed one of them fully open, not both: each has what its spool asks for of the
/// whole.
TEST(lift_and_tilt_share_the_pump) {
  DozerPlant alone(tilting());
  alone.set_blade_duty(0.7, true);
  alone.advance(200 * kMillisecondUs);
  DozerPlant both(tilting());
  both.set_blade_duty(0.7, true);
  both.set_tilt_duty(1.0, true);
  both.advance(200 * kMillisecondUs);
  const double pump_m3ps = 157.08 / 6.283185307 * 60e-6 * 0.94;
  const double lift_m3ps = both.implement_flows().demand;
  const double tilt_m3ps = both.tilt()->demand_m3ps();
  assert_true(lift_m3ps < pump_m3ps && lift_m3ps + tilt_m3ps > pump_m3ps);
  assert_near(both.implement_flows().available, pump_m3ps * lift_m3ps / (lift_m3ps + tilt_m3ps),
              1e-6);
  assert_near(both.implement_flows().supply + both.tilt()->flows().supply, pump_m3ps, 1e-5);
  assert_true(both.blade_stroke_m() < alone.blade_stroke_m() - 0.003);
}

TEST(one_without_tilt_has_none) {
  const DozerPlant plant(dozer_9t());
  assert_false(plant.tilt().has_value());
  assert_false(plant.cross_ground().has_value());
}
