// SPDX-License-Identifier: Apache-2.0
// Machines whose pressures nobody measures, in oil softer than the profile's: the servo leads alone
// and must not feed the linkage's lowest mode.

#include "app/runs/dig_run.hpp"
#include "app/runs/scenarios.hpp"
#include "tests/unit/cmocka_cpp.hpp"

runs::DigSummary dug_without_pressures(double bulk_modulus_gpa) {
  runs::DigScenario scenario;
  scenario.errors = "none";
  scenario.scenario.without = {"pressure"};
  scenario.scenario.found.bulk_modulus_gpa = bulk_modulus_gpa;
  const machines::SimulatedExcavator machine = runs::arranged(
      machines::load_simulated_excavator(machines::find_profile("excavator_22t")), scenario);
  const runs::DigResult result =
      runs::run_dig(machine, runs::usual_run(machine, scenario), [](double, const std::string&) {});
  assert_int_equal(result.end, runs::DigEnd::kDone);
  const runs::DigSummary summary = runs::summarise(result);
  print_message("%.1f GPa: true tip, max %.1f mm, above 1 Hz %.1f mm RMS\n", bulk_modulus_gpa,
                1e3 * summary.max_error_true_m, 1e3 * summary.ringing_rms_m);
  return summary;
}

/// With the servo of a machine that has pressures: 131 and 45 mm.
TEST(soft_oil_does_not_ring) {
  const runs::DigSummary soft = dug_without_pressures(0.7);
  assert_in_range(static_cast<int>(1e4 * soft.max_error_true_m), 50, 450);
  assert_in_range(static_cast<int>(1e4 * soft.ringing_rms_m), 1, 120);
}

TEST(oil_as_designed_is_followed_as_well) {
  const runs::DigSummary designed = dug_without_pressures(1.4);
  assert_in_range(static_cast<int>(1e4 * designed.max_error_true_m), 30, 180);
}
