// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/simulated_excavator.hpp"

#include <cstring>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

const machines::SimulatedExcavator& machine() {
  static const machines::SimulatedExcavator loaded =
      machines::load_simulated_excavator(machines::find_profile("excavator_22t"));
  return loaded;
}

/// Figures that stand in the file once, found where the core looks for them.
TEST(figures_arrive_in_the_structs) {
  const ExcavatorProfile& profile = machine().profile;
  assert_near(profile.geometry.boom_length_m, 5.70, 0.0);
  assert_int_equal(profile.geometry.cylinder[kBoom].count, 2);
  assert_near(profile.geometry.cylinder[kArm].base_m.y(), 1.02, 0.0);
  assert_near(profile.geometry.linkage.lug_m.x(), -0.06, 0.0);
  assert_near(profile.pump[0].relief_pa, 35e6, 0.0);
  assert_int_equal(profile.valve.spool[kBoom].pump, 1);
  assert_int_equal(profile.valve.spool[kArm].pump, 0);
  assert_int_equal(profile.valve.spool[kArm].regeneration, RegenerationSide::kExtend);
  assert_int_equal(profile.valve.spool[kBucket].regeneration, RegenerationSide::kRetract);
  assert_near(profile.valve.spool[kBoom].retract_out_m2, 1.70e-4, 0.0);
  assert_near(profile.valve.spool_to_duty.at(0.0), 0.2, 1e-12);
  assert_int_equal(profile.control.lambda_policy, McvPolicy::kGlobal);
  assert_near(profile.control.lambda_rise.rate_ps, 6.0, 0.0);
  assert_near(profile.control.lambda_rise.reserve_n, 48000.0, 0.0);
  assert_near(profile.control.lambda_rise.hold_share, 0.75, 0.0);
  assert_near(profile.control.response_s, 0.053, 0.0);
  assert_near(profile.control.servo_gain_ps, 2.0, 0.0);
  assert_near(profile.control.servo_most_m, 0.025, 0.0);
  assert_near(profile.control.servo_least_lambda, 0.2, 0.0);
  assert_near(profile.control.servo_frequency_hz, 2.4, 0.0);
  assert_near(profile.control.servo_damping, 0.4, 0.0);
  assert_near(profile.control.pressure_filter_s, 0.15, 0.0);
  assert_near(profile.control.slow_error_m, 0.03, 0.0);
  assert_near(machine().experiment.soil.ground_y_m, -1.0, 0.0);
  assert_near(machine().experiment.soil.bias_n.y(), 30e3, 0.0);
  assert_near(machine().experiment.soil.random_hz, 5.0, 0.0);
  assert_near(machine().experiment.obstacle.hold_s, 3.0, 0.0);
  // Across the path: out of the rock, against the way the bucket comes.
  assert_true(machine().experiment.obstacle.normal.x() > 0.5);
  assert_near(machine().experiment.air.payload_kg, 1000.0, 0.0);
  assert_near(machine().experiment.air.start.attitude_rad, 1.44, 0.0);
  assert_near(machine().experiment.stiff_bulk_modulus_pa, 1e10, 0.0);
  assert_near(machine().experiment.uncertainty.dead_time, 0.3, 0.0);
  assert_near(profile.valve.spool[kArm].c_inflow_check, 0.0, 0.0);
  assert_near(profile.dig_path.attitude_at_x_max_rad, 2.094395, 0.0);
  assert_near(machine().plant.link[kArm].mass_kg, 1010.0, 0.0);
  assert_near(machine().plant.swash_ratio[1], 0.643, 0.0);
  assert_near(machine().plant.friction[kBucket].viscous_nspm, 12000.0, 0.0);
}

/// One pump for all three, and pins from the angles of (6): 28.208 and 44.714 deg.
TEST(the_12_t_machine) {
  const machines::SimulatedExcavator small =
      machines::load_simulated_excavator(machines::find_profile("excavator_12t"));
  const ExcavatorProfile& profile = small.profile;
  assert_int_equal(profile.pump_count, 1);
  for (const SpoolProfile& spool : profile.valve.spool) {
    assert_int_equal(spool.pump, 0);
  }
  assert_near(profile.dig_swash_ratio[0], 0.643, 0.0);
  assert_near(profile.dig_swash_ratio[1], 0.0, 0.0);
  assert_near(profile.geometry.boom_foot_m.x(), 0.14, 0.0);
  assert_near(profile.geometry.boom_foot_m.y(), 1.424, 0.0);
  const CylinderGeometry& boom = profile.geometry.cylinder[kBoom];
  assert_near(boom.base_m.x(), 0.3979, 1e-4);
  assert_near(boom.base_m.y(), -0.3940, 1e-4);
  assert_near(boom.eye_m.x(), 1.6937, 1e-4);
  assert_near(boom.eye_m.y(), 0.9085, 1e-4);
  assert_near(profile.swing.speed_max_radps, 1.435, 0.0);
  // Tuned.
  assert_true(profile.swing.acceleration_max_radps2 > 0.1 &&
              profile.swing.acceleration_max_radps2 < 1.0);
  assert_near(profile.line.acceleration_mps2, 0.25, 0.0);
  assert_near(profile.line.cylinder_acceleration_mps2[kBucket], 0.5, 0.0);
  assert_near(profile.valve.section_flow_m3ps, 3.333e-3, 0.0);
  assert_near(small.experiment.line.from.position_m.y(), 6.866, 0.0);
  assert_near(small.experiment.line.to.attitude_rad, 1.221730, 0.0);
  assert_near(small.experiment.line.duration_s, 18.4, 0.0);
}

/// Two boom cylinders of 120 mm bore and 85 mm rod, by hand: 2 pi/4 d^2.
TEST(piston_areas) {
  const CylinderGeometry& boom = machine().profile.geometry.cylinder[kBoom];
  assert_near(boom.cap_area_m2(), 0.0226195, 1e-7);
  assert_near(boom.rod_area_m2(), 0.0112705, 1e-7);
}

TEST(a_missing_profile_says_where_it_looked) {
  test::expect_refusal([] { return machines::find_profile("no_such_machine"); }, "no_such_machine");
}
