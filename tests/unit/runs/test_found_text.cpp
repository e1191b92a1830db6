// SPDX-License-Identifier: Apache-2.0
// What a machine is told to be, as its user writes it, and as runs say it.

#include <stdexcept>
#include <string>

#include "app/runs/found_text.hpp"
#include "app/runs/scenarios.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using namespace graben::runs;

TEST(texts_are_read) {
  const machines::Found found = found_of(
      "oil=0.7,exponent=1.4,dead_band=0.17,spool_lag=0.04,friction=1.5,mass=0.85,pump_flow=0.9,"
      "engine_sag=0.1,dead_time=3e-2");
  assert_true(found.bulk_modulus_gpa == 0.7 && found.opening_exponent == 1.4);
  assert_true(found.deadband_ratio == 0.17 && found.spool_time_constant_s == 0.04);
  assert_true(found.friction_factor == 1.5 && found.mass_factor == 0.85);
  assert_true(found.pump_flow_factor == 0.9 && found.engine_sag_ratio == 0.1);
  assert_true(found.dead_time_s == 0.03);
  const machines::Found ranges =
      found_of("spool_lag=0.015..0.08,spool_closes=5e-2,bypass_leak=1..3");
  assert_true(ranges.spool_time_constant_s == machines::Told(0.015, 0.08));
  assert_true(ranges.closing_time_constant_s == 0.05);
  assert_true(ranges.bypass_leak_factor == machines::Told(1.0, 3.0));
  assert_string_equal(found_text(ranges).c_str(),
                      "spool_lag 0.015 .. 0.08 s, spool_closes 0.05 s, bypass_leak 1 .. 3");
  const machines::Found one = found_of("mass=1.1");
  assert_true(one.mass_factor == 1.1 && !one.bulk_modulus_gpa && !one.dead_time_s);
}

/// The ends of a range are in it.
TEST(ranges_have_their_ends) {
  for (const char* text : {"oil=0.1", "oil=100", "exponent=0.5", "exponent=4", "dead_band=0.1",
                           "dead_band=0.6", "spool_lag=0.001", "spool_lag=1", "friction=0",
                           "friction=10", "mass=0.1", "mass=10", "pump_flow=0.1", "pump_flow=2",
                           "engine_sag=0", "engine_sag=0.5", "dead_time=0", "dead_time=0.5"}) {
    static_cast<void>(found_of(text));
  }
}

TEST(wrong_texts_are_refused) {
  const struct {
    const char* text;
    const char* key;
    const char* allowed;
  } cases[] = {
      {"", "''", "oil (0.1 .. 100 GPa), exponent (0.5 .. 4), dead_band (0.1 .. 0.6)"},
      {"colour=1", "'colour'", "spool_closes (0.001 .. 1 s), bypass_leak (0.1 .. 10)"},
      {"oil=1,,mass=1", "''", "mass (0.1 .. 10)"},
      {"oil=1,", "''", "mass (0.1 .. 10)"},
      {"=1", "''", "mass (0.1 .. 10)"},
      {"Oil=1", "'Oil'", "oil (0.1 .. 100 GPa)"},
      {"oil=1,exponent=1,oil=1", "oil is there twice", "0.1 .. 100 GPa"},
      {"oil", "oil: a value is missing", "0.1 .. 100 GPa"},
      {"mass=", "mass: a value is missing", "0.1 .. 10"},
      {"mass=nan", "mass: 'nan'", "0.1 .. 10"},
      {"mass=inf", "mass: 'inf'", "0.1 .. 10"},
      {"mass=-inf", "mass: '-inf'", "0.1 .. 10"},
      {"mass=1e999", "mass: '1e999'", "0.1 .. 10"},
      {"mass=1kg", "mass: '1kg'", "0.1 .. 10"},
      {"mass= 1", "mass: ' 1'", "0.1 .. 10"},
      {"mass=1=2", "mass: '1=2'", "0.1 .. 10"},
      {"dead_band=0.09", "dead_band: '0.09'", "0.1 .. 0.6"},
      {"spool_lag=1.1", "spool_lag: '1.1'", "0.001 .. 1 s"},
      {"engine_sag=-0.1", "engine_sag: '-0.1'", "0 .. 0.5"},
      {"dead_time=0.51", "dead_time: '0.51'", "0 .. 0.5 s"},
      {"dead_time=0.1..0.51", "dead_time: '0.51'", "0 .. 0.5 s"},
      {"dead_time=0.2..0.1", "dead_time: '0.2..0.1'", "from less to more"},
      {"dead_time=0.1..0.1", "dead_time: '0.1..0.1'", "from less to more"},
      {"dead_time=0.1..", "dead_time: a value is missing", "0 .. 0.5 s"},
      {"dead_time=..0.1", "dead_time: a value is missing", "0 .. 0.5 s"},
  };
  for (const auto& wrong : cases) {
    const std::string says = test::refusal_of([&] { return found_of(wrong.text); });
    if (says.find(wrong.key) == std::string::npos ||
        says.find(wrong.allowed) == std::string::npos) {
      fail_msg("--found %s: %s", wrong.text, says.c_str());
    }
  }
}

/// Campaigns of different machines have different texts.
TEST(a_scenario_says_it) {
  DigScenario scenario;
  scenario.errors = "kim";
  const std::string plain = scenario_text(scenario);
  assert_string_equal(plain.c_str(), "errors kim");
  scenario.scenario.found = found_of("exponent=1.4,oil=0.7");
  assert_string_equal(scenario_text(scenario).c_str(),
                      "errors kim, found oil 0.7 GPa, exponent 1.4");
  TaskScenario task;
  assert_string_equal(machine_text(task).c_str(), "errors none");
  task.found = found_of("dead_time=0.02");
  assert_string_equal(machine_text(task).c_str(), "errors none, found dead_time 0.02 s");
}

TEST(a_task_runs_on_what_is_told) {
  const machines::SimulatedExcavator nominal =
      machines::load_simulated_excavator(machines::find_profile("excavator_12t"));
  TaskScenario task;
  task.found = found_of("exponent=1.4");
  assert_near(arranged(nominal, task).plant.spool[kSwing].extend.opening_exponent, 1.4, 0.0);
  DigScenario dig;
  dig.scenario.found = task.found;
  dig.errors = "all";
  const machines::SimulatedExcavator drawn = arranged(nominal, dig);
  assert_near(drawn.plant.spool[kBoom].retract.opening_exponent, 1.4, 0.0);
  assert_true(drawn.plant.bulk_modulus_pa != nominal.plant.bulk_modulus_pa);
  dig.errors = "kim";
  assert_near(arranged(nominal, dig).plant.bulk_modulus_pa, nominal.plant.bulk_modulus_pa, 0.0);
}
