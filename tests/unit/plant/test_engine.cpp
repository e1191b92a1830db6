// SPDX-License-Identifier: Apache-2.0
// An engine that its pumps pull down, pumps that are not as large as their data, and what the bus
// is told of both.

#include "app/plant/engine.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/node_rig.hpp"

using namespace graben::plant;
using namespace graben::plant::test;

constexpr double kStep_s = 1e-3;
constexpr ExcavatorPlant::AxisArray kStart = {0.7, 0.7, 0.6};

TEST(speed_falls_by_the_share_with_its_lag) {
  Engine engine({0.08, 0.5}, kStep_s);
  for (int i = 1; i <= 2000; ++i) {
    engine.step(1.0);
    assert_near(engine.speed_ratio(), 1.0 - 0.08 * (1.0 - std::exp(-i * kStep_s / 0.5)), 1e-12);
  }
  engine.set_ratio(0.5);
  assert_near(engine.speed_ratio(), 0.5 * (1.0 - 0.08 * (1.0 - std::exp(-4.0))), 1e-12);
  engine.set_ratio(0.0);
  assert_near(engine.speed_ratio(), 0.0, 0.0);
  Engine half({0.08, 0.5}, kStep_s);
  half.start(0.5);
  assert_near(half.speed_ratio(), 0.96, 1e-12);
}

/// The boom against the end of its stroke: at its pump all the flow goes over the relief.
ExcavatorPlant stalled(const ExcavatorPlantProfile& profile) {
  ExcavatorPlant plant(profile, kStart);
  plant.set_duty({1.0, 1.0, 1.0, 0.0}, true);
  plant.set_swash({1.0, 1.0});
  plant.advance(15 * kSecondUs);
  return plant;
}

TEST(full_power_takes_the_whole_share) {
  ExcavatorPlantProfile profile = machine_22t();
  const double rated_radps = profile.machine.pump[0].rated_speed_radps;
  assert_near(stalled(profile).engine_radps(), rated_radps, 0.0);
  profile.engine.share = 0.10;
  const ExcavatorPlant plant = stalled(profile);
  double power_w = 0.0;
  double full_w = 0.0;
  for (std::size_t p = 0; p < 2; ++p) {
    const PumpProfile& pump = profile.machine.pump[p];
    const double rated_m3ps = pump.displacement_m3prev * rated_radps / (2.0 * kPi);
    assert_true(plant.pump_pressures_pa()[p] > 0.98 * pump.relief_pa);
    // At full swash the flow is the engine's speed.
    assert_near(plant.pump(p).ideal_flow_m3ps(), rated_m3ps * plant.engine_radps() / rated_radps,
                1e-9);
    power_w += plant.pump(p).ideal_flow_m3ps() * plant.pump_pressures_pa()[p];
    full_w += rated_m3ps * pump.relief_pa;
  }
  assert_near(plant.engine_radps(), rated_radps * (1.0 - 0.10 * power_w / full_w),
              1e-3 * rated_radps);
  assert_true(plant.engine_radps() < 0.92 * rated_radps);
}

TEST(at_the_start_it_carries_its_standby) {
  ExcavatorPlantProfile profile = machine_22t();
  profile.engine.share = 0.10;
  ExcavatorPlant plant(profile, kStart);
  const double before_radps = plant.engine_radps();
  assert_true(before_radps < profile.machine.pump[0].rated_speed_radps);
  plant.advance(2 * kSecondUs);
  assert_near(plant.engine_radps(), before_radps, 0.02);
}

/// Each pump gives its own share of what its swash and speed say, and neither sensor shows it.
TEST(a_pump_gives_less_than_its_swash_says) {
  const ExcavatorPlantProfile exact = machine_22t();
  ExcavatorPlantProfile profile = exact;
  profile.pump_flow_ratio = {0.9, 1.1};
  for (std::size_t p = 0; p < 2; ++p) {
    const double nominal = ExcavatorPlant(exact, kStart).pump(p).ideal_flow_m3ps();
    const ExcavatorPlant plant(profile, kStart);
    assert_near(plant.pump(p).ideal_flow_m3ps(), profile.pump_flow_ratio[p] * nominal, 1e-15);
    assert_near(plant.swash_ratios()[p], exact.swash_ratio[p], 0.0);
  }
  assert_near(ExcavatorPlant(profile, kStart).engine_radps(),
              exact.machine.pump[0].rated_speed_radps, 0.0);
}

ExcavatorPlantProfile sagging() {
  ExcavatorPlantProfile profile = machine_22t();
  profile.engine.share = 0.10;
  return profile;
}

struct SaggingRig : BusRig<ExcavatorNode, OperatorNode<dbc::excavator::Dbc>> {
  SaggingRig()
      : BusRig([](CanPort& port) {
          return ExcavatorNode(sagging(), ExcavatorStart({0.7, 0.7, 0.6}), port, kHash);
        }) {}
};

/// EEC1 has 0.125 rpm.
constexpr double kResolution_radps = 0.125 * 2.0 * kPi / 60.0;

TEST(the_bus_is_told_the_speed_that_it_has, SaggingRig rig) {
  rig.cycles(5);
  const double told_radps = last<bus::EEC1>(rig).engine_speed_radps.value;
  assert_near(told_radps, rig.machine.plant().engine_radps(), kResolution_radps);
  assert_true(told_radps < machine_22t().machine.pump[0].rated_speed_radps - kResolution_radps);
  rig.machine.faults().engine_ratio = 0.5;
  rig.cycles(5);
  assert_near(last<bus::EEC1>(rig).engine_speed_radps.value, 0.5 * told_radps,
              2.0 * kResolution_radps);
}
