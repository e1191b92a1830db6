// SPDX-License-Identifier: Apache-2.0
// The dozer's blade: linkage, implement circuit and cylinders together.

#include <algorithm>

#include "app/plant/dozer_plant.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

constexpr double kCapArea = 2 * 0.785398163397448 * 0.110 * 0.110;
constexpr double kRodArea = kCapArea - 2 * 0.785398163397448 * 0.060 * 0.060;
constexpr double kPumpFlow = 84.6e-3 / 60.0;
constexpr double kValveFlow = 2.0e-3;

/// Duty of an opening of the edges.
double duty(double opening) { return std::copysign(0.2 + 0.8 * std::abs(opening), opening); }

void run(DozerPlant& plant, double opening, double duration_s) {
  plant.set_blade_duty(duty(opening), opening != 0.0);
  plant.advance(std::lround(1e6 * duration_s));
}

double mean_velocity_mps(DozerPlant& plant, double duration_s) {
  const double before = plant.blade_stroke_m();
  plant.advance(std::lround(1e6 * duration_s));
  return (plant.blade_stroke_m() - before) / duration_s;
}

// Pins by hand: base 0.5335 m from the pivot, rod eye 0.7078 m, 107.6 degrees between them at home.
TEST(linkage_is_the_drawings_triangle) {
  const BladeLinkage linkage(dozer_9t().machine.blade);
  assert_near(linkage.length_m(0.0), 1.007, 1e-12);
  assert_near(linkage.edge_m(0.0).y(), 0.0, 1e-12);
  assert_near((linkage.edge_m(0.3) - Eigen::Vector2d(0.6718, 0.386)).norm(), 1.60, 1e-12);
  const double l11 = std::hypot(0.1278, 0.518);
  for (const double angle : {-0.25, 0.1, 0.5}) {
    // The rod eye on the arm's line, 0.7078 m from the pivot.
    const double arm = std::atan2(-0.1037, 1.5881) + angle;
    const double x = 0.6718 + 0.7078 * std::cos(arm);
    const double y = 0.386 + 0.7078 * std::sin(arm);
    assert_near(linkage.length_m(angle), std::hypot(x - 0.544, y - 0.904), 1e-4);
    const double e = 1e-6;
    assert_near(linkage.length_per_angle_m(angle),
                (linkage.length_m(angle + e) - linkage.length_m(angle - e)) / (2.0 * e), 1e-8);
  }
  assert_near(l11, 0.5335, 1e-4);
}

// Extension lowers; stroke 0 is fully raised; home lies between.
TEST(stroke_spans_the_reach) {
  const BladeLinkage linkage(dozer_9t().machine.blade);
  assert_near(linkage.edge_m(linkage.highest_rad()).y(), 0.80, 1e-12);
  assert_near(linkage.edge_m(linkage.lowest_rad()).y(), -0.38, 1e-12);
  assert_near(linkage.stroke_m(linkage.highest_rad()), 0.0, 1e-12);
  assert_near(linkage.full_stroke_m(), linkage.stroke_m(linkage.lowest_rad()), 1e-12);
  assert_near(linkage.stroke_m(0.0), 0.2089, 1e-4);
  assert_near(linkage.full_stroke_m(), 0.2922, 1e-4);
}

TEST(speed_is_flow_over_area) {
  for (const double opening : {0.1, 0.3, 0.6}) {
    DozerPlant lower(dozer_9t());
    run(lower, opening, 0.8);
    assert_near(mean_velocity_mps(lower, 0.2) / (opening * kValveFlow / kCapArea), 1.0, 0.01);
    DozerPlant raise(dozer_9t());
    run(raise, -opening, 0.8);
    assert_near(mean_velocity_mps(raise, 0.2) / (-opening * kValveFlow / kRodArea), 1.0, 0.01);
  }
}

TEST(the_pump_limits_it) {
  for (const double engine : {157.08, 94.25}) {
    const double flow = kPumpFlow * engine / 157.08;
    for (const double opening : {1.0, -1.0}) {
      DozerPlant plant(dozer_9t());
      plant.set_engine_radps(engine);
      run(plant, opening, 0.4);
      const double expected = opening * flow / (opening > 0.0 ? kCapArea : kRodArea);
      assert_near(mean_velocity_mps(plant, 0.3) / expected, 1.0, 0.01);
      assert_near(plant.implement_flows().available, flow, 1e-7);
      assert_near(plant.implement_flows().demand, kValveFlow, 1e-6);
      assert_near(plant.implement_flows().supply, flow, 1e-7);
    }
  }
  // With an engine that is fast enough the valve does.
  DozerPlant fast(dozer_9t());
  fast.set_engine_radps(230.38);
  run(fast, 1.0, 0.4);
  assert_near(mean_velocity_mps(fast, 0.3) / (kValveFlow / kCapArea), 1.0, 0.01);
}

// The blade's weight pulls on the cylinders all the way down: at no opening and no engine speed
// does it run ahead of what is fed.
TEST(a_lowering_blade_does_not_run_away) {
  for (const double engine : {94.25, 157.08, 230.38}) {
    for (const double opening : {0.05, 0.4, 1.0}) {
      DozerPlant plant(dozer_9t());
      plant.set_engine_radps(engine);
      run(plant, -1.0, 4.0);
      const double fed = std::min(opening * kValveFlow, kPumpFlow * engine / 157.08) / kCapArea;
      plant.set_blade_duty(duty(opening), true);
      const double begin = plant.blade_stroke_m();
      const double full = plant.blade().linkage().full_stroke_m();
      for (double t = 0.02; plant.blade_stroke_m() < full - 0.02; t += 0.02) {
        plant.advance(20 * kMillisecondUs);
        assert_true(plant.blade_stroke_m() - begin < 1.01 * fed * t + 3e-4);
        assert_true(plant.cylinder().cap().void_m3() == 0.0);
      }
    }
  }
}

TEST(a_closed_spool_holds_the_load) {
  DozerPlant plant(dozer_9t());
  run(plant, 0.0, 1.0);
  const double before = plant.blade_stroke_m();
  assert_near(plant.blade_velocity_mps(), 0.0, 1e-6);
  run(plant, 0.0, 60.0);
  // Leakage past the pistons: 2e-14 m^3/(s Pa) at 3 MPa, over 60 s.
  assert_near(plant.blade_stroke_m() - before, 0.0, 4e-4);
  assert_near(plant.implement_flows().supply, 0.0, 0.0);
  // Rod side: weight and what little is in the cap.
  const double holding = plant.blade().holding_force_n(0.0);
  const double force = plant.cylinder().rod().pressure_pa() * kRodArea -
                       plant.cylinder().cap().pressure_pa() * kCapArea;
  assert_near(-holding, force, 2500.0 + 1.0);
  assert_true(-holding > 37e3 && -holding < 38.5e3);
}

// Inside the deadband nothing opens; without enable neither.
TEST(deadband_and_enable_keep_it_shut) {
  DozerPlant plant(dozer_9t());
  const double before = plant.blade_stroke_m();
  plant.set_blade_duty(0.19, true);
  plant.advance(kSecondUs);
  assert_near(plant.spool_travel_ratio(), 0.19, 1e-6);
  plant.set_blade_duty(1.0, false);
  plant.advance(kSecondUs);
  plant.set_blade_duty(std::nan(""), true);
  plant.advance(kSecondUs);
  assert_near(plant.spool_travel_ratio(), 0.0, 1e-9);
  assert_near(plant.blade_stroke_m(), before, 1e-4);
  plant.set_blade_duty(-0.19, true);
  plant.advance(kSecondUs);
  assert_near(plant.blade_stroke_m(), before, 1e-4);
}

TEST(at_its_ends_the_relief_takes_over) {
  DozerPlant plant(dozer_9t());
  run(plant, 1.0, 4.0);
  assert_near(plant.blade_stroke_m(), plant.blade().linkage().full_stroke_m(), 5e-4);
  assert_near(plant.blade_velocity_mps(), 0.0, 1e-5);
  assert_near(plant.cylinder().cap().pressure_pa(), 21e6, 0.05e6);
  assert_near(plant.implement_flows().supply, 0.0, 1e-6);
  run(plant, -1.0, 5.0);
  assert_near(plant.blade_stroke_m(), 0.0, 5e-4);
  assert_near(plant.cylinder().rod().pressure_pa(), 21e6, 0.05e6);
  assert_near(plant.cutting_edge_m().y(), 0.80, 0.005);
}

// What flows in and out of the chambers is what is in them, and nothing comes from the pump that it
// does not give.
TEST(oil_is_accounted_for) {
  DozerPlant plant(dozer_9t());
  // The leak past the piston only moves oil from one chamber to the other.
  double held = plant.cylinder().cap().content_m3() + plant.cylinder().rod().content_m3();
  for (int i = 0; i < 12000; ++i) {
    plant.set_blade_duty(duty(std::sin(i * 1e-3)), true);
    plant.advance(500);
    const ImplementFlows& flows = plant.implement_flows();
    held += 5e-4 * (flows.cap_in + flows.rod_in);
    assert_near(plant.cylinder().cap().content_m3() + plant.cylinder().rod().content_m3(), held,
                1e-12);
    assert_true(flows.supply >= 0.0 && flows.supply <= kPumpFlow + 1e-7);
    assert_true(flows.supply <= flows.demand + 1e-15);
  }
}

// A chamber above the pump's relief does not flow back through the section.
TEST(the_load_check_holds) {
  ImplementCircuit circuit(dozer_9t(), lift_section(dozer_9t()));
  circuit.set_command(0.6);
  repeat(1000, [&] { circuit.step(5e-4); });
  assert_near(circuit.solve(circuit.pump_flow_m3ps(157.08), {24e6, 1e9}, {1e6, 1e9}).supply, 0.0,
              0.0);
  assert_near(circuit.flows().cap_in, 0.0, 0.0);
  // Half a margin below the relief: what the open edge lets through at 1 MPa.
  const double open = circuit.solve(circuit.pump_flow_m3ps(157.08), {20e6, 0.0}, {1e6, 1e9}).supply;
  assert_near(open, 0.5 * kValveFlow * std::sqrt(0.5), 1e-6);
}

// The weight's moment turns with the body.
TEST(gravity_follows_the_bodys_pitch) {
  const BladeJoint blade(dozer_9t());
  const double arm = std::atan2(-0.1037, 1.5881);
  for (const double pitch : {-0.3, 0.0, 0.3}) {
    const double moment = 950.0 * 9.80665 * 1.45 * std::cos(arm + pitch);
    const double lever = -blade.linkage().length_per_angle_m(0.0);
    assert_near(blade.holding_force_n(pitch), -moment / lever, 1e-6);
  }
}

// A first-order check of the whole chain: second-order spool lag, dead time.
TEST(the_spool_answers_after_its_dead_time) {
  DozerPlantProfile profile = dozer_9t();
  profile.dead_time_s = 0.03;
  DozerPlant plant(profile);
  plant.set_blade_duty(0.5, true);
  plant.advance(30 * kMillisecondUs);
  assert_near(plant.spool_travel_ratio(), 0.0, 1e-9);
  plant.advance(15 * kMillisecondUs);
  assert_near(plant.spool_travel_ratio(), 0.5 * (1.0 - 2.0 * std::exp(-1.0)), 0.01);
  // Centred by its springs, without the dead time.
  plant.advance(kSecondUs);
  plant.set_pilot_cut(true);
  plant.advance(15 * kMillisecondUs);
  assert_near(plant.spool_travel_ratio(), 0.5 * 2.0 * std::exp(-1.0), 0.01);
}

TEST(a_pilot_valve_can_be_broken) {
  DozerPlant plant(dozer_9t());
  plant.set_blade_duty(0.3, true);
  plant.set_pilot_fault(-0.6, 0.0);
  plant.advance(kSecondUs);
  assert_near(plant.spool_travel_ratio(), -0.6, 1e-6);
  plant.set_pilot_fault(std::nullopt, 0.25);
  plant.advance(kSecondUs);
  assert_near(plant.spool_travel_ratio(), 0.55, 1e-6);
  plant.set_pilot_cut(true);
  plant.advance(kSecondUs);
  assert_near(plant.spool_travel_ratio(), 0.0, 1e-6);
  plant.set_pilot_cut(false);
  plant.set_pilot_fault(std::nullopt, 0.0);
  plant.advance(kSecondUs);
  assert_near(plant.spool_travel_ratio(), 0.3, 1e-6);
}
