// SPDX-License-Identifier: Apache-2.0
/// What a scenario changes of a dozer and of what its controller takes it for.

#include "app/machines/simulated/simulated_dozer.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using machines::arranged;
using machines::DozerScenario;
using machines::SimulatedDozer;

const SimulatedDozer& nominal() {
  static const SimulatedDozer machine =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  return machine;
}

TEST(without_a_word_nothing_changes) {
  const SimulatedDozer plain = arranged(nominal(), {});
  assert_int_equal(plain.profile.travel.policy, SpeedPolicy::kBounded);
  assert_near(plain.profile.travel.speed_desired_mps, 1.6, 0.0);
  assert_near(plain.profile.travel.speed_min_mps, 0.1, 0.0);
  assert_near(plain.plant.machine.hst.engine_radps, 157.08, 0.0);
  assert_near(plain.plant.machine.body.mass_kg, 8900.0, 0.0);
  assert_false(plain.plant.sensor_errors);
}

/// Policy and speed are the controller's; nothing says that a slow operator is not obeyed.
TEST(speed_is_the_controllers) {
  DozerScenario scenario;
  scenario.policy = SpeedPolicy::kConstant;
  scenario.speed_mps = 0.06;
  const SimulatedDozer machine = arranged(nominal(), scenario);
  assert_int_equal(machine.profile.travel.policy, SpeedPolicy::kConstant);
  assert_near(machine.profile.travel.speed_desired_mps, 0.06, 0.0);
  assert_near(machine.profile.travel.speed_min_mps, 0.06, 0.0);
  assert_near(machine.plant.machine.travel.speed_desired_mps, 1.6, 0.0);
}

/// The throttle is the machine's: the controller has to measure it.
TEST(the_engine_is_the_machines) {
  DozerScenario scenario;
  scenario.engine_radps = 104.72;
  const SimulatedDozer machine = arranged(nominal(), scenario);
  assert_near(machine.plant.machine.hst.engine_radps, 104.72, 0.0);
  assert_near(machine.profile.hst.engine_radps, 157.08, 0.0);
}

TEST(the_ends_of_the_engines_range_are_in_it) {
  constexpr double kPerRpm = 3.14159265358979323846 / 30.0;
  for (const double rpm : {900.0, 2200.0}) {
    DozerScenario scenario;
    scenario.engine_radps = rpm * kPerRpm;
    assert_near(arranged(nominal(), scenario).plant.machine.hst.engine_radps, rpm * kPerRpm, 0.0);
  }
}

/// The simulated ground is level: there is nothing to fill it with.
TEST(a_design_above_the_ground_is_refused) {
  SimulatedDozer machine = nominal();
  machine.profile.grade.plane_slope = 0.01;
  test::expect_refusal([&] { return arranged(machine, {}); },
                       "above the simulated ground at x = 2.");
}

/// Its figures differ where it is refused, however little it is.
TEST(a_design_that_is_a_little_above_the_ground_says_by_how_much) {
  SimulatedDozer machine = nominal();
  machine.profile.grade.plane_height_m = 0.0204;
  test::expect_refusal([&] { return arranged(machine, {}); },
                       "0.0204 m above the simulated ground at x = 0.00 m; allowed: at most 0.02");
  machine.profile.grade.plane_height_m = 0.02 + 1e-9;
  assert_string_equal(test::refusal_of([&] { return arranged(machine, {}); }).c_str(), "");
}

/// A plane two metres down is reached from nowhere: it ended in fault 43 once the pass had begun.
TEST(a_design_that_begins_below_the_blades_reach_is_refused) {
  SimulatedDozer machine = nominal();
  machine.profile.grade.plane_height_m = -2.0;
  test::expect_refusal([&] { return arranged(machine, {}); },
                       "begins 2.000 m below the simulated ground at x = 0.00 m");
  test::expect_refusal([&] { return arranged(machine, {}); },
                       "allowed: at most the blade's reach, 0.38 m");
  machine.profile.grade.plane_height_m = -0.38;
  assert_string_equal(test::refusal_of([&] { return arranged(machine, {}); }).c_str(), "");
}

TEST(an_engine_out_of_range_is_refused) {
  for (const double radps : {94.2, 230.4}) {
    DozerScenario scenario;
    scenario.engine_radps = radps;
    test::expect_refusal([&] { return arranged(nominal(), scenario); }, "94.25 .. 230.38 rad/s");
  }
}

/// A drawn machine, with the throttle where it was set; its controller takes it for the nominal.
TEST(errors_draw_the_machine_only) {
  DozerScenario scenario;
  scenario.errors = true;
  scenario.seed = 5;
  scenario.engine_radps = 104.72;
  const SimulatedDozer machine = arranged(nominal(), scenario);
  const plant::DozerPlantProfile drawn = machines::draw_dozer(nominal(), 5);
  assert_true(machine.plant.sensor_errors && machine.plant.seed == 5);
  assert_near(machine.plant.machine.body.mass_kg, drawn.machine.body.mass_kg, 0.0);
  assert_near(machine.plant.machine.implement.efficiency, drawn.machine.implement.efficiency, 0.0);
  assert_near(machine.plant.machine.hst.engine_radps, 104.72, 0.0);
  assert_near(machine.profile.body.mass_kg, 8900.0, 0.0);
  assert_near(machine.profile.implement.efficiency, 0.94, 0.0);
}
