// Spool lag, travel limits, deadband and openings.

#include "app/plant/spool.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

namespace {

using namespace graben;
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
  for (int i = 0; i < 10000; ++i) {
    spool.step(kStep);
  }
  return spool;
}

void step_response_is_the_critically_damped_one(void**) {
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

void travel_is_limited(void**) {
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

void deadband_is_shut(void**) {
  ExcavatorPlantProfile profile = machine_22t();
  set_deadband(profile, 0.2, 0.2);
  for (const double travel : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
    const Spool spool = settled_at(profile, travel);
    assert_near(spool.area_ratio(), 0.0, 1e-12);
  }
}

void opening_follows_the_travel_outside_it(void**) {
  ExcavatorPlantProfile profile = machine_22t();
  set_deadband(profile, 0.2, 0.2);
  set_exponent(profile, 1.6);
  for (const double sign : {-1.0, 1.0}) {
    assert_near(settled_at(profile, sign).area_ratio(), 1.0, 1e-9);
    assert_near(settled_at(profile, sign * 0.6).area_ratio(), std::pow(0.5, 1.6), 1e-7);
  }
}

void bypass_closes_continuously(void**) {
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
void each_side_has_its_own_deadband(void**) {
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

/// The plant's figure is the one that counts, not the design's.
void the_plants_exponent_goes_before_the_designs(void**) {
  ExcavatorPlantProfile profile = machine_22t();
  assert_near(profile.section(kArm).spool.extend.opening_exponent,
              profile.machine.valve.opening_exponent, 0.0);
  profile.machine.valve.opening_exponent = 3.0;
  profile.spool[kArm].retract.opening_exponent = 1.2;
  assert_near(profile.section(kArm).spool.retract.opening_exponent, 1.2, 0.0);
  assert_true(profile.section(kArm).spool.extend.opening_exponent < 3.0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(step_response_is_the_critically_damped_one),
      cmocka_unit_test(travel_is_limited),
      cmocka_unit_test(deadband_is_shut),
      cmocka_unit_test(opening_follows_the_travel_outside_it),
      cmocka_unit_test(bypass_closes_continuously),
      cmocka_unit_test(each_side_has_its_own_deadband),
      cmocka_unit_test(the_plants_exponent_goes_before_the_designs),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
