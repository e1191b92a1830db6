// Spool lag, travel limits, deadband and openings.

#include "app/plant/spool.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

namespace {

using namespace graben::plant;

constexpr double kStep = 1e-4;

Spool settled_at(const ExcavatorPlantProfile& profile, double travel_ratio) {
  Spool spool(profile.spool_dynamics());
  spool.set_command(travel_ratio);
  for (int i = 0; i < 10000; ++i) {
    spool.step(kStep);
  }
  return spool;
}

void step_response_is_the_critically_damped_one(void**) {
  ExcavatorPlantProfile profile = machine_22t();
  profile.spool_time_constant_s = 0.02;
  profile.spool_damping = 1.0;
  Spool spool(profile.spool_dynamics());
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
  Spool beyond(profile.spool_dynamics());
  Spool full(profile.spool_dynamics());
  beyond.set_command(3.0);
  full.set_command(1.0);
  for (int i = 0; i < 100; ++i) {
    beyond.step(kStep);
    full.step(kStep);
  }
  assert_near(beyond.travel_ratio(), full.travel_ratio(), 0.0);
  profile.spool_damping = 0.2;  // overshoots
  Spool spool(profile.spool_dynamics());
  spool.set_command(-1.0);
  for (int i = 0; i < 5000; ++i) {
    spool.step(kStep);
    assert_true(spool.travel_ratio() >= -1.0);
  }
}

void deadband_is_shut(void**) {
  ExcavatorPlantProfile profile = machine_22t();
  profile.deadband_ratio = 0.2;
  for (const double travel : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
    const Spool spool = settled_at(profile, travel);
    assert_near(spool.area_ratio(), 0.0, 1e-12);
  }
}

void opening_follows_the_travel_outside_it(void**) {
  ExcavatorPlantProfile profile = machine_22t();
  profile.deadband_ratio = 0.2;
  profile.machine.valve.opening_exponent = 1.6;
  for (const double sign : {-1.0, 1.0}) {
    assert_near(settled_at(profile, sign).area_ratio(), 1.0, 1e-9);
    assert_near(settled_at(profile, sign * 0.6).area_ratio(), std::pow(0.5, 1.6), 1e-7);
  }
}

void bypass_closes_continuously(void**) {
  ExcavatorPlantProfile profile = machine_22t();
  profile.deadband_ratio = 0.2;
  profile.bypass_closing_travel = 0.1;
  assert_near(settled_at(profile, 0.0).bypass_closed_ratio(), 0.0, 0.0);
  assert_near(settled_at(profile, 0.1).bypass_closed_ratio(), 0.0, 1e-6);
  assert_near(settled_at(profile, 0.15).bypass_closed_ratio(), 0.5, 1e-6);
  assert_near(settled_at(profile, -0.15).bypass_closed_ratio(), 0.5, 1e-6);
  assert_near(settled_at(profile, 0.2).bypass_closed_ratio(), 1.0, 1e-6);
  assert_near(settled_at(profile, 0.9).bypass_closed_ratio(), 1.0, 0.0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(step_response_is_the_critically_damped_one),
      cmocka_unit_test(travel_is_limited),
      cmocka_unit_test(deadband_is_shut),
      cmocka_unit_test(opening_follows_the_travel_outside_it),
      cmocka_unit_test(bypass_closes_continuously),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
