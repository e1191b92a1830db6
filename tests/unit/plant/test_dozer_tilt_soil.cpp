// SPDX-License-Identifier: Apache-2.0
// Ground that resists a blade that tilts: strips of its edge, what they do to blade and body.

#include <numeric>

#include "app/machines/simulated/soil_kinds.hpp"
#include "app/plant/dozer_plant.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

DozerPlantProfile in_soil(const std::string& machine, const std::string& soil) {
  DozerPlantProfile profile = machines::load_simulated_dozer(machines::find_profile(machine)).plant;
  profile.soil = machines::ground_of(soil, false, 0);
  return profile;
}

/// Tilts first, then drives on with its edge in the ground.
DozerPlant cutting(const DozerPlantProfile& profile, double tilt_duty) {
  DozerPlant plant(profile);
  plant.set_blade_duty(0.5, true);
  plant.set_tilt_duty(tilt_duty, true);
  plant.set_brake(false);
  plant.set_displacements({0.4, 0.4}, {1.0, 1.0});
  plant.advance(300 * kMillisecondUs);
  plant.set_blade_duty(0.0, false);
  plant.set_tilt_duty(0.0, false);
  plant.advance(1200 * kMillisecondUs);
  return plant;
}

TEST(strips_share_the_whole_edge, EdgePlaces places) {
  const std::array<double, kEdgeStrips> along_m = {1.2, 0.9, 0.0, -0.9, -1.2};
  for (std::size_t i = 0; i < kEdgeStrips; ++i) {
    places[i] = {true, along_m[i], {0.0, 0.0}};
  }
  auto share = strip_shares(places, 1.3);
  assert_near(share[0], (1.3 - 1.05) / 2.6, 1e-12);
  assert_near(share[1], (1.05 - 0.45) / 2.6, 1e-12);
  assert_near(share[2], 0.9 / 2.6, 1e-12);
  assert_near(std::accumulate(share.begin(), share.end(), 0.0), 1.0, 1e-12);
  // An end that has left its line: the next one has its part too.
  places[4].reached = false;
  share = strip_shares(places, 1.3);
  assert_near(share[4], 0.0, 0.0);
  assert_near(share[3], (1.3 - 0.45) / 2.6, 1e-12);
  assert_near(std::accumulate(share.begin(), share.end(), 0.0), 1.0, 1e-12);
}

/// Worked out by hand, on a machine that stands level: levers in x, y, z of each point.
TEST(a_strip_turns_what_it_holds, EdgeStand stand) {
  stand.edge_middle_m = {2.0, 0.0, 0.0};
  stand.pivot_m = {0.5, 0.0, 0.4};
  stand.mass_centre_m = {0.0, 0.0, 0.85};
  stand.blade_axis = Eigen::Vector3d::UnitX();
  stand.body_axis = Eigen::Vector3d::UnitX();
  stand.lift_axis = Eigen::Vector3d::UnitY();
  EdgeLoad load;
  add_strip(stand, {2.0, 1.0, -0.1}, {-3000.0, 700.0}, load);
  assert_near(load.force_n.x(), -3000.0, 1e-9);
  assert_near(load.force_n.y(), 700.0, 1e-9);
  assert_near(load.tilt_nm, 700.0, 1e-9);
  assert_near(load.roll_nm, 700.0, 1e-9);
  // Held back on the left it turns to the left.
  assert_near(load.yaw_nm, 3000.0, 1e-9);
  assert_near(load.lift_nm, 1.5 * 700.0 - 0.5 * 3000.0, 1e-9);
  assert_near(load.pitch_nm, 2.0 * 700.0 - 0.95 * 3000.0, 1e-9);
}

/// All strips alike are the whole: a level blade has the force of the machine without tilt.
TEST(a_level_blade_has_the_force_of_one_without_tilt) {
  const DozerPlant tilts = cutting(in_soil("dozer_9t_tilt", "loam"), 0.0);
  const DozerPlant level = cutting(in_soil("dozer_9t", "loam"), 0.0);
  const double force_n = level.soil_force_n().x();
  assert_true(force_n < -3e3);
  assert_near(tilts.soil_force_n().x(), force_n, 0.02 * -force_n);
  assert_near(tilts.carried_m3(), level.carried_m3(), 0.02 * level.carried_m3());
  assert_near(tilts.pitch_rad(), level.pitch_rad(), 1e-3);
  assert_near(tilts.soil_load().roll_nm, 0.0, 1.0);
  assert_near(tilts.soil_load().yaw_nm, 0.0, 1.0);
  assert_near(tilts.soil_load().tilt_nm, 0.0, 1.0);
}

/// The deeper side is held back more, and what bears or draws it turns body and blade.
TEST(the_lower_end_is_held_back_more) {
  const DozerPlant plant = cutting(in_soil("dozer_9t_tilt", "clay"), 0.6);
  const double left_m = plant.edge_point_m(1.0).z();
  const double right_m = plant.edge_point_m(-1.0).z();
  assert_true(std::abs(left_m - right_m) > 0.05);
  const double deeper_left = left_m < right_m ? 1.0 : -1.0;
  const EdgeLoad& load = plant.soil_load();
  assert_true(load.force_n.x() < -3e3);
  assert_true(deeper_left * load.yaw_nm > 1e3);
  // With little pitch and roll the blade's and the body's axes are the same.
  assert_true(std::abs(load.roll_nm) > 100.0);
  assert_near(load.tilt_nm, load.roll_nm, 0.2 * std::abs(load.roll_nm));
}

/// The tilt cylinder takes it: pressures change, and the blade hardly turns.
TEST(the_tilt_cylinder_holds_against_it) {
  const auto gives_rad = [](double moment_nm) {
    TiltDrive drive(in_soil("dozer_9t_tilt", "loam"), 0.0005);
    repeat(1000, [&] { drive.step(1e-3, 0.0, false, moment_nm); });
    return drive.angle_rad();
  };
  const double left_rad = gives_rad(4e3);
  assert_true(left_rad > 1e-5 && left_rad < 0.01);
  assert_true(gives_rad(-4e3) < -1e-5);
}

/// On level ground soil that lifts the left side rolls the body by its springs.
TEST(the_body_rolls_with_it) {
  const DozerPlantProfile profile = in_soil("dozer_9t_tilt", "loam");
  const Terrain level(-10.0, 10.0, 0.02);
  HalfVehicle body(profile);
  BodyLoad load;
  load.roll_nm = 4860.0;
  for (int i = 0; i < 8000; ++i) {
    body.step(TracksGround{level, level}, 0.0, 0.0005, load);
  }
  // Less what the mass centre beside them takes: m g h of 10 k (gauge / 2)^2.
  const double stiffness_nmprad = 10 * 6.0e5 * 0.9 * 0.9 - 8900.0 * 9.80665 * 0.85;
  assert_near(body.roll_rad(), 4860.0 / stiffness_nmprad, 2e-5);
}

/// What is cut on one side spreads before the whole blade.
TEST(nothing_of_what_strips_cut_disappears) {
  const DozerPlantProfile profile = in_soil("dozer_9t_tilt", "loam");
  BladeSoil soil(*profile.soil, profile);
  Terrain left(-2.0, 10.0, 0.02);
  Terrain right(-2.0, 10.0, 0.02);
  for (int n = 0; n < 2000; ++n) {
    const double from_m = 0.001 * n;
    const double to_m = from_m + 0.001;
    soil.cut_strip({from_m, -0.1}, {to_m, -0.1}, 0.5, left);
    soil.cut_strip({from_m, -0.02}, {to_m, -0.02}, 0.5, right);
    soil.go_on(0.001);
  }
  const double cut_m3 = 2.0 * 0.06 * profile.blade_shape.width_m * profile.soil->swell;
  assert_near(soil.carried_m3() + soil.lost_m3(), cut_m3, 0.02 * cut_m3);
  assert_near(left.height_m(1.0), -0.1, 1e-9);
  assert_near(right.height_m(1.0), -0.02, 1e-9);
}

/// A stone lies more on one side, and the blade's middle does not know.
TEST(a_stone_lies_on_one_side) {
  const DozerPlantProfile profile = in_soil("dozer_9t_tilt", "stones");
  BladeSoil soil(*profile.soil, profile);
  const Terrain ground(-2.0, 10.0, 0.02);
  const auto against_n = [&](double beside) {
    return -soil.force_n({5.0, -0.1}, {1.0, 0.0}, 0.0, ground, beside).x();
  };
  assert_near(against_n(1.0), against_n(-1.0), 1e-9);
  soil.go_on(0.2);
  const double middle_n = against_n(0.0);
  assert_true(std::abs(against_n(1.0) - against_n(-1.0)) > 100.0);
  assert_near(0.5 * (against_n(0.3) + against_n(-0.3)), middle_n, 1e-6 * middle_n);
}
