// SPDX-License-Identifier: Apache-2.0
// Spool lag, travel limits, deadband and openings.

#include "app/plant/spool.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

constexpr double kStep = 1e-4;

void set_deadband(ExcavatorPlantProfile& profile, double extend_ratio, double retract_ratio) {
  profile.spool[kBoom].extend.deadband_ratio = extend_ratio;
  profile.spool[kBoom].retract.deadband_ratio = retract_ratio;
}

void set_exponent(ExcavatorPlantProfile& profile, double exponent) {
  profile.spool[kBoom].extend.opening_exponent = exponent;
  profile.spool[kBoom].retract.opening_exponent = exponent;
}

Spool settled_at(const ExcavatorPlantProfile& profile, double travel_ratio) {
  Spool spool(profile.spool[kBoom]);
  spool.set_command(travel_ratio);
  repeat(10000, [&] { spool.step(kStep); });
  return spool;
}

TEST(step_response_is_the_critically_damped_one) {
  ExcavatorPlantProfile profile = machine_22t();
  profile.spool[kBoom].time_constant_s = 0.02;
  profile.spool[kBoom].damping = 1.0;
  Spool spool(profile.spool[kBoom]);
  spool.set_command(0.5);
  for (int i = 1; i <= 1500; ++i) {
    spool.step(kStep);
    const double t = i * kStep / 0.02;
    assert_near(spool.travel_ratio(), 0.5 * (1.0 - (1.0 + t) * std::exp(-t)), 2e-6);
  }
}

TEST(travel_is_limited) {
  ExcavatorPlantProfile profile = machine_22t();
  assert_near(settled_at(profile, 3.0).travel_ratio(), 1.0, 1e-9);
  Spool beyond(profile.spool[kBoom]);
  Spool full(profile.spool[kBoom]);
  beyond.set_command(3.0);
  full.set_command(1.0);
  for (int i = 0; i < 100; ++i) {
    beyond.step(kStep);
    full.step(kStep);
  }
  assert_near(beyond.travel_ratio(), full.travel_ratio(), 0.0);
  profile.spool[kBoom].damping = 0.2;  // overshoots
  Spool spool(profile.spool[kBoom]);
  spool.set_command(-1.0);
  for (int i = 0; i < 5000; ++i) {
    spool.step(kStep);
    assert_true(spool.travel_ratio() >= -1.0);
  }
}

TEST(deadband_is_shut) {
  ExcavatorPlantProfile profile = machine_22t();
  set_deadband(profile, 0.2, 0.2);
  for (const double travel : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
    const Spool spool = settled_at(profile, travel);
    assert_near(spool.area_ratio(), 0.0, 1e-12);
  }
}

TEST(opening_follows_the_travel_outside_it) {
  ExcavatorPlantProfile profile = machine_22t();
  set_deadband(profile, 0.2, 0.2);
  set_exponent(profile, 1.6);
  for (const double sign : {-1.0, 1.0}) {
    assert_near(settled_at(profile, sign).area_ratio(), 1.0, 1e-9);
    assert_near(settled_at(profile, sign * 0.6).area_ratio(), std::pow(0.5, 1.6), 1e-7);
  }
}

TEST(bypass_closes_continuously) {
  ExcavatorPlantProfile profile = machine_22t();
  set_deadband(profile, 0.2, 0.2);
  profile.spool[kBoom].bypass_closing_travel = 0.1;
  assert_near(settled_at(profile, 0.0).bypass_closed_ratio(), 0.0, 0.0);
  assert_near(settled_at(profile, 0.1).bypass_closed_ratio(), 0.0, 1e-6);
  assert_near(settled_at(profile, 0.15).bypass_closed_ratio(), 0.5, 1e-6);
  assert_near(settled_at(profile, -0.15).bypass_closed_ratio(), 0.5, 1e-6);
  assert_near(settled_at(profile, 0.2).bypass_closed_ratio(), 1.0, 1e-6);
  assert_near(settled_at(profile, 0.9).bypass_closed_ratio(), 1.0, 0.0);
}

/// Each side opens from its own edge on and is full at its own end, and the bypass is closed there.
TEST(each_side_has_its_own_deadband) {
  ExcavatorPlantProfile profile = machine_22t();
  set_deadband(profile, 0.17, 0.23);
  set_exponent(profile, 1.0);
  profile.spool[kBoom].bypass_closing_travel = 0.1;
  assert_near(settled_at(profile, 0.17).area_ratio(), 0.0, 1e-9);
  assert_near(settled_at(profile, 0.20).area_ratio(), 0.03 / 0.83, 1e-6);
  assert_near(settled_at(profile, -0.20).area_ratio(), 0.0, 0.0);
  assert_near(settled_at(profile, -0.23).area_ratio(), 0.0, 1e-9);
  assert_near(settled_at(profile, -0.26).area_ratio(), 0.03 / 0.77, 1e-6);
  assert_near(settled_at(profile, 1.0).area_ratio(), 1.0, 1e-9);
  assert_near(settled_at(profile, -1.0).area_ratio(), 1.0, 1e-9);
  assert_near(settled_at(profile, 0.12).bypass_closed_ratio(), 0.5, 1e-6);
  assert_near(settled_at(profile, -0.12).bypass_closed_ratio(), 0.0, 1e-6);
  assert_near(settled_at(profile, -0.18).bypass_closed_ratio(), 0.5, 1e-6);
  assert_near(settled_at(profile, 0.17).bypass_closed_ratio(), 1.0, 1e-6);
  assert_near(settled_at(profile, -0.23).bypass_closed_ratio(), 1.0, 1e-6);
  assert_near(settled_at(profile, 0.0).bypass_closed_ratio(), 0.0, 0.0);
}

/// The opening begins half a softness before the edge, has a parabola's start there, and is as of a
/// sharp edge from half a softness behind it on; the bypass is closed where it begins.
TEST(a_soft_edge_opens_by_a_parabola) {
  ExcavatorPlantProfile profile = machine_22t();
  set_deadband(profile, 0.4, 0.5);
  set_exponent(profile, 1.0);
  profile.spool[kBoom].extend.softness_ratio = 0.2;
  profile.spool[kBoom].bypass_closing_travel = 0.1;
  assert_near(settled_at(profile, 0.30).area_ratio(), 0.0, 1e-9);
  assert_near(settled_at(profile, 0.40).area_ratio(), 0.1 * 0.1 / 0.4 / 0.6, 1e-6);
  assert_near(settled_at(profile, 0.50).area_ratio(), 0.1 / 0.6, 1e-6);
  assert_near(settled_at(profile, 0.70).area_ratio(), 0.3 / 0.6, 1e-6);
  assert_near(settled_at(profile, 1.0).area_ratio(), 1.0, 1e-9);
  assert_near(settled_at(profile, 0.25).bypass_closed_ratio(), 0.5, 1e-6);
  assert_near(settled_at(profile, 0.35).bypass_closed_ratio(), 1.0, 0.0);
  // The other side stays sharp.
  assert_near(settled_at(profile, -0.48).area_ratio(), 0.0, 0.0);
  assert_near(settled_at(profile, -0.6).area_ratio(), 0.1 / 0.5, 1e-6);
  // No corner, where it begins and where it ends.
  const SpoolSide& side = profile.spool[kBoom].extend;
  for (const double at : {0.3, 0.5}) {
    const double before = (side.area_ratio(at) - side.area_ratio(at - 1e-5)) / 1e-5;
    const double behind = (side.area_ratio(at + 1e-5) - side.area_ratio(at)) / 1e-5;
    assert_near(before, behind, 1e-3);
  }
}

/// What a bypass needs to close must fit before the side that opens first.
TEST(a_bypass_is_open_at_neutral) {
  SpoolDynamics spool{0.02, 1.0, {0.3, 0.1, 1.0}, {0.1, 0.06, 1.0}, 0.1};
  fit_bypass(spool);
  assert_near(spool.bypass_closing_travel, 0.07, 1e-12);
  spool.retract = {0.5, 0.1, 1.0};
  fit_bypass(spool);
  assert_near(spool.bypass_closing_travel, kBypassClosingTravel, 0.0);
}

/// Each side's duty is as late as its own pilot; where both press, the spool goes by the
/// difference.
TEST(each_side_has_its_own_dead_time) {
  PilotValve pilot({0.003, 0.001}, 0.0, 1e-3);
  const double duty[] = {0.5, 0.5, 0.5, -0.4, -0.4, -0.4, -0.4, -0.4, -0.4};
  const double sent[] = {0.0, 0.0, 0.0, 0.5, 0.1, 0.1, -0.4, -0.4, -0.4};
  for (int i = 0; i < 9; ++i) {
    assert_near(pilot.step(duty[i], false), sent[i], 1e-12);
  }
}

/// First order, behind the dead time; without pilot pressure nothing is left of it.
TEST(pilot_pressure_lags) {
  constexpr double kLag_s = 0.05;
  PilotValve pilot(0.01, kLag_s, kStep);
  repeat(100, [&] { assert_near(pilot.step(0.8, false), 0.0, 0.0); });
  for (int i = 1; i <= 2000; ++i) {
    assert_near(pilot.step(0.8, false), 0.8 * (1.0 - std::exp(-i * kStep / kLag_s)), 1e-9);
  }
  repeat(20000, [&] { static_cast<void>(pilot.step(0.8, false)); });
  assert_near(pilot.step(0.8, false), 0.8, 0.0);
  assert_near(pilot.step(0.8, true), 0.0, 0.0);
  assert_true(pilot.step(0.8, false) < 0.01);
  pilot.set_fault(-0.3, 0.0);
  assert_near(pilot.step(0.8, false), -0.3, 0.0);
}

TEST(area_factors_are_the_plants) {
  ExcavatorPlantProfile profile = machine_22t();
  const SpoolProfile nominal = profile.section(kArm).edges;
  profile.area_factors[kArm] = {0.7, 0.8, 1.1, 1.3};
  const SpoolProfile found = profile.section(kArm).edges;
  assert_near(found.extend_in_m2, 0.7 * nominal.extend_in_m2, 1e-18);
  assert_near(found.extend_out_m2, 0.8 * nominal.extend_out_m2, 1e-18);
  assert_near(found.retract_in_m2, 1.1 * nominal.retract_in_m2, 1e-18);
  assert_near(found.retract_out_m2, 1.3 * nominal.retract_out_m2, 1e-18);
  assert_near(profile.section(kBoom).edges.extend_in_m2,
              profile.machine.valve.spool[kBoom].extend_in_m2, 0.0);
}

/// The plant's figure is the one that counts, not the design's.
TEST(the_plants_exponent_goes_before_the_designs) {
  ExcavatorPlantProfile profile = machine_22t();
  assert_near(profile.section(kArm).spool.extend.opening_exponent,
              profile.machine.valve.opening_exponent, 0.0);
  profile.machine.valve.opening_exponent = 3.0;
  profile.spool[kArm].retract.opening_exponent = 1.2;
  assert_near(profile.section(kArm).spool.retract.opening_exponent, 1.2, 0.0);
  assert_true(profile.section(kArm).spool.extend.opening_exponent < 3.0);
}
