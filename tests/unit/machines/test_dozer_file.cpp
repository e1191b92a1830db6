// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/simulated_dozer.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "tests/unit/cmocka_cpp.hpp"

const machines::SimulatedDozer& machine() {
  static const machines::SimulatedDozer loaded =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  return loaded;
}

/// Pairs of what arrived and what the file's source says.
void assert_all(const std::vector<std::pair<double, double>>& figures) {
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (figures[i].first != figures[i].second) {
      print_error("figure %zu: %g is not %g\n", i, figures[i].first, figures[i].second);
    }
    assert_near(figures[i].first, figures[i].second, 0.0);
  }
}

/// The sources' figures (D37 description, Mononen and Mattila): none is thinned out.
TEST(the_sources_figures_arrive) {
  const DozerProfile& p = machine().profile;
  assert_all({{p.body.mass_kg, 8900.0},
              {p.body.pitch_inertia_kgm2, 12000.0},
              {machine().plant.pitch_inertia_kgm2, 12000.0},
              {p.body.mass_centre_height_m, 0.85},
              {p.body.wheels, 10},
              {p.body.track_contact_m, 2.40},
              {p.body.half_gauge_m, 0.90},
              {p.body.suspension_npm, 6.0e5},
              {p.body.suspension_nspm, 3.0e4}});
  assert_all({{p.blade.pivot_m.x(), 0.6718},
              {p.blade.pivot_m.y(), 0.386},
              {p.blade.arm_m.x(), 1.5881},
              {p.blade.arm_m.y(), -0.1037},
              {p.blade.cutting_edge_m, 1.60},
              {p.blade.cylinder_count, 2},
              {p.blade.bore_m, 0.110},
              {p.blade.rod_m, 0.060},
              {p.blade.base_m.x(), 0.544},
              {p.blade.base_m.y(), 0.904},
              {p.blade.length_home_m, 1.007},
              {p.blade.edge_min_m, -0.38},
              {p.blade.edge_max_m, 0.80}});
  assert_all({{p.implement.displacement_m3prev, 60e-6},
              {p.implement.efficiency, 0.94},
              {p.implement.valve_flow_max_m3ps, 2.0e-3},
              {p.hst.engine_radps, 157.08},
              {p.hst.engine_least_radps, 94.25},
              {p.hst.engine_most_radps, 230.38},
              {p.hst.pump_m3prev, 90e-6},
              {p.hst.motor_m3prev, 100e-6},
              {p.hst.motor_ratio_min, 0.35},
              {p.hst.gear_ratio, 70.9},
              {p.hst.pump_efficiency, 0.95},
              {p.hst.motor_efficiency, 0.95},
              {p.hst.sprocket_radius_m, 0.35}});
  assert_int_equal(p.travel.policy, SpeedPolicy::kBounded);
  assert_all({{p.travel.speed_desired_mps, 1.6},
              {p.travel.speed_min_mps, 0.1},
              {p.travel.acceleration_max_mps2, 0.5},
              {p.travel.threshold_rad, 0.02},
              {machine().experiment.length_m, 27.0},
              {p.grade.rounding_m, 0.3}});
  const std::array<std::array<double, 2>, 10> trench = {{{0.0, 0.0},
                                                         {4.0, 0.0},
                                                         {5.0, -0.35},
                                                         {9.0, -0.35},
                                                         {9.8, -0.12},
                                                         {13.0, -0.12},
                                                         {13.8, -0.35},
                                                         {18.0, -0.35},
                                                         {20.0, 0.0},
                                                         {27.0, 0.0}}};
  assert_int_equal(p.grade.count, trench.size());
  for (std::size_t i = 0; i < trench.size(); ++i) {
    assert_all({{p.grade.point[i].x_m, trench[i][0]}, {p.grade.point[i].z_m, trench[i][1]}});
  }
}

/// What was chosen, found where controller and plant look for it.
TEST(chosen_figures_arrive_in_the_structs) {
  const DozerProfile& p = machine().profile;
  assert_near(p.implement.spool_to_duty.at(0.0), 0.2, 1e-12);
  assert_near(p.implement.spool_to_duty.at(1.0), 1.0, 1e-12);
  assert_all({{p.hst.pump_rate_ps, 4.0},
              {p.hst.motor_rate_ps, 2.0},
              {p.hst.response_s, 0.08},
              {p.travel.deceleration_max_mps2, 1.0},
              {p.travel.flow_share, 0.95},
              {p.travel.preview_m, 2.5},
              {p.travel.track_gain, 0.6},
              {p.travel.track_integral_ps, 2.0},
              {p.grade.plane_height_m, 0.0},
              {p.grade.plane_slope, 0.0},
              {p.travel.push_max_n, 60e3},
              {p.grade.ground_m, 0.0},
              {p.grade.pass_depth_m, 1.0},
              {p.grade.passes_most, 50},
              {p.grade.tolerance_m, 0.02},
              {machine().plant.blade_shape.width_m, 2.55},
              {machine().plant.blade_shape.height_m, 0.9},
              {machine().plant.blade_shape.rake_rad, 1.0},
              {machine().plant.blade_shape.edge_m, 0.012},
              {machine().plant.engine_power_w, 68e3},
              {machine().plant.engine_sag.share, 0.1},
              {machine().plant.engine_sag.lag_s, 0.3}});
  assert_all({{p.control.sensor_timeout_s, 0.045},
              {p.control.spool_rate_ps, 20.0},
              {p.control.spool_threshold, 0.01},
              {p.control.dead_time_s, 0.0},
              {p.control.response_s, 0.03},
              {p.control.pose_latency_s, 0.0},
              {p.control.blade_gain_ps, 9.0},
              {p.control.blade_integral_ps2, 4.0},
              {p.control.blade_integral_most_mps, 0.10}});
  assert_all({{p.safety.degraded_speed_ratio, 0.4},
              {p.safety.idle_radps, 94.25},
              {p.safety.settle_s, 0.10},
              {p.safety.spool_tolerance, 0.12},
              {p.safety.uncommanded_m, 0.02},
              {p.safety.stuck_m, 0.03},
              {p.safety.displacement_tolerance, 0.15},
              {p.safety.displacement_settle_s, 0.5},
              {p.safety.track_speed_tolerance_mps, 0.35}});
}

TEST(the_plants_figures_arrive) {
  const plant::DozerPlantProfile& plant = machine().plant;
  assert_all({{plant.machine.body.mass_kg, 8900.0},
              {plant.blade_mass_kg, 950.0},
              {plant.blade_reach_m, 1.45},
              {plant.coulomb_n, 2500.0},
              {plant.viscous_nspm, 12000.0},
              {plant.spool_time_constant_s, 0.015},
              {plant.spool_damping, 1.0},
              {plant.deadband_ratio, 0.2},
              {plant.dead_time_s, 0.0},
              {plant.dead_volume_m3, 1.0e-3},
              {plant.bulk_modulus_pa, 1.4e9},
              {plant.implement_relief_pa, 21.0e6}});
  assert_all({{plant.hst_relief_pa, 42.0e6},
              {plant.charge_pa, 2.5e6},
              {plant.hst_line_volume_m3, 1.5e-3},
              {plant.pump_response_s, 0.08},
              {plant.motor_response_s, 0.10},
              {plant.path_inertia_kgm2, 40.0},
              {plant.mechanical_efficiency, 0.90},
              {plant.ground.friction, 0.80},
              {plant.ground.slip_modulus_m, 0.02},
              {plant.ground.rolling_resistance, 0.08},
              {plant.start_position_m, -3.0}});
  const plant::DozerSensorErrors& s = plant.sensors;
  assert_all({{s.stroke_resolution_m, 1e-4},
              {s.position_noise_m, 0.005},
              {s.height_noise_m, 0.0015},
              {s.pitch_noise_rad, 0.0003},
              {s.velocity_noise_mps, 0.005},
              {s.climb_noise_mps, 0.005},
              {s.pitch_rate_noise_radps, 0.001},
              {s.track_speed_noise_mps, 0.005},
              {s.height_bias_m, 0.002}});
  assert_false(plant.sensor_errors);
}

TEST(each_kind_is_known) {
  using machines::MachineKind;
  using machines::profile_kind;
  assert_int_equal(profile_kind(machines::find_profile("dozer_9t")), MachineKind::kDozer);
  assert_int_equal(profile_kind(machines::find_profile("excavator_22t")), MachineKind::kExcavator);
  assert_true(machine().name == "dozer_9t");
  assert_true(machine().hash != 0);
}

/// What a draw may change, over its nominal value, and how far it may be off.
struct Drawn {
  double off;
  double most;
};

std::vector<Drawn> drawn(std::uint64_t seed) {
  const plant::DozerPlantProfile& exact = machine().plant;
  const plant::DozerPlantProfile plant = machines::draw_dozer(machine(), seed);
  const machines::DozerUncertainty& u = machine().experiment.uncertainty;
  const HstProfile& hst = plant.machine.hst;
  return {{plant.machine.body.mass_kg / exact.machine.body.mass_kg - 1.0, u.mass},
          {plant.ground.friction / exact.ground.friction - 1.0, u.friction},
          {plant.ground.rolling_resistance / exact.ground.rolling_resistance - 1.0, u.friction},
          {plant.machine.implement.efficiency / exact.machine.implement.efficiency - 1.0,
           std::min(u.efficiency, 1.0 / exact.machine.implement.efficiency - 1.0)},
          {hst.pump_efficiency / exact.machine.hst.pump_efficiency - 1.0,
           std::min(u.efficiency, 1.0 / exact.machine.hst.pump_efficiency - 1.0)},
          {hst.motor_efficiency / exact.machine.hst.motor_efficiency - 1.0,
           std::min(u.efficiency, 1.0 / exact.machine.hst.motor_efficiency - 1.0)}};
}

/// 2000 draws fill each range, and never leave it; no efficiency is above 1.
TEST(draws_fill_their_ranges) {
  assert_all({{machine().experiment.uncertainty.mass, 0.10},
              {machine().experiment.uncertainty.friction, 0.10},
              {machine().experiment.uncertainty.efficiency, 0.10}});
  std::vector<double> least(6, 1.0);
  std::vector<double> most(6, -1.0);
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const std::vector<Drawn> values = drawn(seed);
    for (std::size_t i = 0; i < values.size(); ++i) {
      least[i] = std::min(least[i], values[i].off);
      most[i] = std::max(most[i], values[i].off);
    }
  }
  for (std::size_t i = 0; i < least.size(); ++i) {
    assert_true(least[i] >= -0.1 - 1e-12 && least[i] < -0.098);
    assert_true(most[i] <= drawn(0)[i].most + 1e-12 && most[i] > 0.98 * drawn(0)[i].most);
  }
}

/// Mass and inertia go together, each thing else by itself; the same seed draws the same.
TEST(draws_are_of_one_machine) {
  const plant::DozerPlantProfile plant = machines::draw_dozer(machine(), 7);
  const double heavier = plant.machine.body.mass_kg / 8900.0;
  assert_near(plant.pitch_inertia_kgm2, 12000.0 * heavier, 1e-9);
  assert_near(plant.blade_mass_kg, 950.0 * heavier, 1e-9);
  assert_true(plant.sensor_errors && plant.seed == 7);
  const std::vector<Drawn> once = drawn(7);
  const std::vector<Drawn> again = drawn(7);
  const std::vector<Drawn> other = drawn(8);
  for (std::size_t i = 0; i < once.size(); ++i) {
    assert_true(once[i].off == again[i].off);
    assert_true(once[i].off != other[i].off || once[i].off == once[i].most);
    assert_true(i == 0 || once[i].off != once[i - 1].off);
  }
  assert_near(machine().plant.machine.body.mass_kg, 8900.0, 0.0);
}
