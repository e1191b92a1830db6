// SPDX-License-Identifier: Apache-2.0
// Watches while duties are tried on valves that nobody knows.

#include "firmware/excavator/safety/excavator_validation.hpp"

#include "tests/unit/firmware/watched_machine.hpp"

using namespace graben::test;

/// What the valve's model says of a machine that nobody knows counts for nothing: neither while
/// duties are tried nor until they have arrived; and pressures still do.
TEST(duties_that_are_tried_are_not_judged_by_the_model) {
  for (const bool tried : {true, false}) {
    Machine machine;
    machine.run(20);
    machine.cycle.tried = tried;
    machine.run(1);
    machine.cycle.tried = false;
    machine.inputs.drive[kBoom].stroke_m = 0.25;
    machine.run(15);
    if (tried) {
      assert_well(machine.seen);
      machine.run(10);
      assert_well(machine.seen);
      machine.inputs.drive[kBoom].stroke_m = 0.5;
      machine.run(20);
    }
    assert_stopped_by(Fault::kUncommandedMotion, machine.seen);
  }
  Machine blind;
  blind.cycle.tried = true;
  blind.inputs.drive[kArm].cap_pressure_pa = blind.profile.safety.pressure_rail_pa;
  blind.frozen = true;
  blind.run(10);
  assert_slowed_by(Fault::kPressureImplausible, blind.seen);
}

/// What a sensor of unknown zero shows of an empty chamber is not stuck while duties are tried.
TEST(an_empty_chamber_slows_nobody_who_tries, Machine machine) {
  machine.frozen = true;
  machine.cycle.tried = true;
  for (int n = 0; n < 40; ++n) {
    for (unsigned axis = 0; axis < kAxisCount; ++axis) {
      machine.inputs.drive[axis].cap_pressure_pa = 8e6 + n;
      machine.inputs.drive[axis].rod_pressure_pa = 8e6 + n;
    }
    machine.inputs.drive[kArm].rod_pressure_pa = 0.47e6;
    machine.inputs.drive[kArm].stroke_m += 0.004;
    machine.step(0.01);
  }
  assert_well(machine.seen);
  machine.inputs.drive[kArm].rod_pressure_pa = 1.6e6;
  machine.step(0.01);
  machine.inputs.drive[kArm].stroke_m += 0.1;
  machine.step(0.01);
  assert_slowed_by(Fault::kPressureImplausible, machine.seen);
}

/// Its drives move for another reason than what was asked: nothing is learnt of the valve.
TEST(nothing_is_learnt_of_duties_that_are_tried) {
  for (const bool tried : {true, false}) {
    Machine machine;
    machine.cycle.tried = tried;
    machine.cycle.asked_mps[kBoom] = 0.1;
    machine.cycle.opening[kBoom] = 0.5;
    machine.cycle.duty_ratio[kBoom] = 0.75;
    machine.inputs.drive[kBoom].spool_ratio = 0.75;
    for (int n = 0; n < 60; ++n) {
      machine.inputs.drive[kBoom].stroke_m += 0.12 * 0.01;
      machine.inputs.drive[kBoom].stroke_is_new = true;
      machine.step(0.01);
    }
    const bool learnt = machine.state.drives.learnt[kBoom].extend.edge != 0.0;
    assert_true(learnt != tried);
  }
}

/// Slow motion says nothing of a valve for 10 s after a load has pressed on any drive; nor while
/// one is not known, which is no reason to wait on.
TEST(a_load_that_has_pressed_is_remembered, Machine machine) {
  for (DriveRow& row : machine.bank.row) {
    row.watch.relief_pa = 35e6;
  }
  machine.run(20);
  const double& pressed_s = machine.state.drives.pressed_s;
  assert_near(pressed_s, 0.0, 0.0);
  machine.frozen = true;
  machine.inputs.drive[kArm].rod_pressure_pa = 30e6;
  machine.step();
  assert_near(pressed_s, 10.0, 0.0);
  machine.frozen = false;
  machine.run(8);
  assert_near(pressed_s, 10.0 - 8.0 * kPeriod_s, 1e-9);
  machine.run(static_cast<int>(10.0 / kPeriod_s));
  assert_near(pressed_s, 0.0, 0.0);
}
