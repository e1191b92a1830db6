// SPDX-License-Identifier: Apache-2.0
// Pumps that set their own swash: what line, load and bypass make of it.

#include <algorithm>
#include <cmath>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/plant/excavator_plant.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben::plant;

constexpr ExcavatorPlant::AxisArray kStart{0.6, 0.7, 0.6};

ExcavatorPlantProfile machine(const char* name) {
  return machines::load_simulated_excavator(machines::find_profile(name)).plant;
}

/// A duty of the boom, the others at rest.
void lift(ExcavatorPlant& plant, double duty, TimeUs duration_us) {
  plant.set_duty({duty, 0.0, 0.0, 0.0}, true);
  plant.advance(duration_us);
}

TEST(without_a_load_the_line_keeps_the_margin) {
  ExcavatorPlant plant(machine("excavator_22t_ls"), kStart);
  const double margin_pa = plant.profile().machine.pump[1].regulator.margin_pa;
  assert_near(plant.pump_pressures_pa()[1], margin_pa, 1e-3 * margin_pa);
  plant.advance(2 * kSecondUs);
  assert_near(plant.pump_pressures_pa()[1], margin_pa, 0.01 * margin_pa);
  // Nothing but leakage: 4e-12 * 2e6 m3/s of 3.57e-3.
  assert_near(plant.swash_ratios()[1], 2.3e-3, 3e-4);
}

TEST(under_a_load_it_is_the_margin_above) {
  ExcavatorPlant plant(machine("excavator_22t_ls"), kStart);
  lift(plant, 0.45, kSecondUs);
  const double load_pa = plant.cap_pressures_pa()[kBoom];
  assert_true(load_pa > 5e6);
  const double margin_pa = plant.profile().machine.pump[1].regulator.margin_pa;
  assert_near(plant.pump_pressures_pa()[1] - load_pa, margin_pa, 0.05 * margin_pa);
  assert_near(plant.pump_pressures_pa()[0], margin_pa, 0.05 * margin_pa);
}

/// Over the metering edge there is the margin, whatever hangs on the bucket.
TEST(a_compensated_drive_goes_as_fast_under_any_load) {
  const ExcavatorPlantProfile profile = machine("excavator_22t_ls");
  double speed_mps[2];
  double load_pa[2];
  for (int heavy = 0; heavy < 2; ++heavy) {
    ExcavatorPlant plant(profile, kStart);
    plant.set_tip_force({0.0, heavy * -15e3});
    lift(plant, 0.45, kSecondUs);
    const double before_m = plant.strokes_m()[kBoom];
    lift(plant, 0.45, 2 * kSecondUs);  // On its oil it rings.
    speed_mps[heavy] = 0.5 * (plant.strokes_m()[kBoom] - before_m);
    load_pa[heavy] = plant.cap_pressures_pa()[kBoom];
  }
  assert_true(load_pa[1] > load_pa[0] + 3e6);
  assert_near(speed_mps[1] / speed_mps[0], 1.0, 0.02);
  // Q = K u^1.6 sqrt(margin) with u the travel outside of the dead band.
  const SpoolMetering& metering = profile.machine.valve;
  const double edge = metering.discharge * profile.machine.valve.spool[kBoom].extend_in_m2 *
                      std::sqrt(2.0 / metering.density_kgpm3) * std::pow(0.25 / 0.8, 1.6);
  const double piston_m2 = 2.0 * 3.14159265358979 / 4.0 * 0.120 * 0.120;
  assert_near(speed_mps[0], edge * std::sqrt(2.0e6) / piston_m2, 0.03 * speed_mps[0]);
}

double felt_pa(const ExcavatorPlant& plant, std::size_t pump) {
  const double root =
      plant.pump(pump).flows().bypass_m3ps / plant.profile().machine.pump[pump].bypass_series[1];
  return root * root;
}

/// The falling line of excavator_22t_nfc.toml.
double swash_by_diagram(double felt) {
  const double gone = (felt - 0.8e6) / 2.2e6;
  return 1.0 - 0.85 * std::min(1.0, std::max(0.0, gone));
}

TEST(at_rest_the_bypass_keeps_the_pump_low) {
  ExcavatorPlant plant(machine("excavator_22t_nfc"), kStart);
  for (int second = 0; second < 2; ++second) {
    assert_near(plant.swash_ratios()[1], swash_by_diagram(felt_pa(plant, 1)), 5e-3);
    assert_true(plant.swash_ratios()[1] < 0.25 && plant.swash_ratios()[1] > 0.14);
    plant.advance(kSecondUs);
  }
}

TEST(a_spool_that_closes_the_bypass_calls_for_flow) {
  ExcavatorPlant plant(machine("excavator_22t_nfc"), kStart);
  lift(plant, 0.385, kSecondUs);
  const double part = plant.swash_ratios()[1];
  assert_near(part, swash_by_diagram(felt_pa(plant, 1)), 0.02);
  assert_true(part > 0.2 && part < 0.95);
  lift(plant, 0.8, kSecondUs);
  assert_near(plant.swash_ratios()[1], 1.0, 0.01);
  assert_true(plant.swash_ratios()[0] < 0.25);  // The arm's pump has nothing to do.
}

/// A whole stroke takes at least the time that the profile says.
TEST(a_regulator_takes_its_time) {
  for (const char* name : {"excavator_22t_ls", "excavator_22t_nfc"}) {
    ExcavatorPlant plant(machine(name), kStart);
    const double start = plant.swash_ratios()[1];
    lift(plant, 1.0, 30 * kMillisecondUs);
    assert_true(plant.swash_ratios()[1] - start <= 0.030 / 0.12 + 1e-9);
    lift(plant, 1.0, kSecondUs);
    assert_true(plant.swash_ratios()[1] > 0.95);
  }
}
