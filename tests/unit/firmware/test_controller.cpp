// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include "tests/unit/firmware/running.hpp"

using test::assert_neutral;
using test::Running;

constexpr TimeUs kPeriod = Running::kPeriod;

const ExcavatorProfile& profile() { return test::excavator().profile; }

TEST(starts_silent_and_neutral) {
  const ExcavatorSetup setup(profile());
  ExcavatorController controller(setup);
  const ExcavatorOutputs outputs = controller.step({}, 0);
  assert_int_equal(outputs.status.mode, EcuMode::kSilent);
  assert_neutral(outputs);
}

TEST(moves_once_armed_with_a_task, Running running) {
  assert_int_equal(running.outputs.status.mode, EcuMode::kActive);
  assert_true(running.outputs.enable);
  assert_true(running.outputs.status.lambda > 0.0);
  double moved = 0.0;
  for (const double duty : running.outputs.duty_ratio) {
    moved += std::abs(duty);
  }
  assert_true(moved > 0.2);
}

/// Each spool moves the way its cylinder is wanted to.
TEST(duties_have_the_wanted_velocitys_signs, Running running) {
  const ExcavatorOutputs outputs = running.step(running.inputs());
  for (unsigned i = 0; i < kAxisCount; ++i) {
    if (outputs.duty_ratio[i] != 0.0) {
      assert_true(outputs.duty_ratio[i] * outputs.status.wanted_velocity_mps[i] > 0.0);
    }
  }
}

TEST(released_enable_is_neutral_in_the_same_cycle, Running running) {
  ExcavatorInputs released = running.inputs();
  released.driver.enable.value = false;
  assert_neutral(running.step(released));
}

/// 50 ms without a sensor: neutral, and latched until the operator lets go.
TEST(a_missing_sensor_is_neutral_within_50_ms) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    Running running;
    const TimeUs last_us = running.now_us - kPeriod;
    ExcavatorOutputs outputs;
    while (running.now_us - last_us <= 50 * kMillisecondUs) {
      ExcavatorInputs inputs = running.inputs();
      inputs.axis[axis].stroke_m.stamp_us = last_us;
      outputs = running.step(inputs);
    }
    assert_neutral(outputs);
    assert_int_equal(outputs.status.mode, EcuMode::kFault);
    assert_int_equal(outputs.status.fault, Fault::kStrokeMissing);
    assert_neutral(running.step(running.inputs()));
  }
}

/// Fresh inputs after a pause do not make up for what was not seen.
TEST(a_stalled_cycle_is_neutral_and_latched, Running running) {
  running.now_us += 30 * kMillisecondUs;
  assert_true(running.step(running.inputs()).enable);
  running.step(running.inputs());
  running.now_us += 60 * kMillisecondUs;
  const ExcavatorOutputs outputs = running.step(running.inputs());
  assert_neutral(outputs);
  assert_int_equal(outputs.status.fault, Fault::kCycleStalled);
  assert_neutral(running.step(running.inputs()));
}

/// Loads against every cylinder, just below where the sensors end and above what a pump's relief
/// lets it push: told within 0.7 s for the load's filter, and no spool opens against it. What is
/// open lets the pressure off.
TEST(an_impossible_load_is_not_pushed, Running running) {
  ExcavatorOutputs outputs;
  for (int n = 0; n < 70; ++n) {
    ExcavatorInputs inputs = running.inputs();
    for (unsigned i = 0; i < kAxisCount; ++i) {
      const bool extends = running.outputs.status.wanted_velocity_mps[i] > 0.0;
      inputs.axis[i].cap_pressure_pa.value = extends ? 39e6 : 0.0;
      inputs.axis[i].rod_pressure_pa.value = extends ? 0.0 : 39e6;
    }
    outputs = running.step(inputs);
  }
  assert_near(outputs.status.lambda, 0.0, 0.0);
  assert_int_equal(outputs.status.limit.kind, LimitKind::kBackFlow);
  for (unsigned i = 0; i < kDriveCount; ++i) {
    assert_true(outputs.duty_ratio[i] * outputs.status.wanted_velocity_mps[i] <= 0.0);
  }
}

/// The load's filter starts with what it sees: a start right after switching on is the same as one
/// after a second of rest, which any filter has followed.
TEST(every_start_sees_its_own_load, Running once) {
  Running again;
  again.step(again.at_rest(false));
  repeat(100, [&] { again.step(again.at_rest(true)); });
  again.step(again.inputs());
  for (int n = 0; n < 8; ++n) {
    once.step(once.inputs());
    again.step(again.inputs());
    assert_int_equal(again.outputs.status.mode, EcuMode::kActive);
    for (unsigned i = 0; i < kAxisCount; ++i) {
      assert_near(again.outputs.duty_ratio[i], once.outputs.duty_ratio[i], 1e-9);
    }
  }
}

/// From every rest lambda starts at one cycle's rise and goes up by no more.
TEST(lambda_rises_anew_from_every_rest) {
  const double rise = profile().control.lambda_rise.rate_ps * 0.01;
  Running running;
  for (int start = 0; start < 2; ++start) {
    assert_int_equal(running.outputs.status.mode, EcuMode::kActive);
    assert_near(running.outputs.status.lambda, rise, 1e-12);
    assert_int_equal(running.outputs.status.limit.kind, LimitKind::kRise);
    for (int n = 2; n < 8; ++n) {
      assert_near(running.step(running.inputs()).status.lambda, n * rise, 1e-12);
    }
    running.step(running.at_rest(false));
    running.step(running.at_rest(true));
    running.step(running.inputs());
  }
}

TEST(the_same_inputs_give_the_same_outputs, Running first) {
  Running second;
  for (int n = 0; n < 50; ++n) {
    const ExcavatorOutputs a = first.step(first.inputs());
    const ExcavatorOutputs b = second.step(second.inputs());
    for (unsigned i = 0; i < kAxisCount; ++i) {
      assert_near(a.duty_ratio[i], b.duty_ratio[i], 0.0);
    }
    assert_near(a.status.lambda, b.status.lambda, 0.0);
  }
}

/// The boom's spool at half its travel, whatever it is told.
ExcavatorInputs with_open_spool(ExcavatorInputs inputs) {
  inputs.axis[kBoom].spool_ratio.value = 0.5;
  return inputs;
}

/// The deadman is let go, and the spool does not close: the pilot pressure goes, and comes back
/// with a fresh enable only, although it has centred the spool.
TEST(a_spool_left_open_cuts_the_pilot_pressure, Running running) {
  for (int n = 0; n < 60 && !running.outputs.pilot_cut; ++n) {
    running.step(with_open_spool(running.at_rest(false)));
  }
  assert_true(running.outputs.pilot_cut);
  assert_int_equal(running.outputs.status.fault, Fault::kSpoolStuck);
  repeat(20, [&] { assert_true(running.step(running.at_rest(false)).pilot_cut); });
  assert_int_equal(running.outputs.status.mode, EcuMode::kReady);
  running.step(running.at_rest(true));
  assert_int_equal(running.outputs.status.mode, EcuMode::kArmed);
  assert_false(running.outputs.pilot_cut);
}

/// Once the spools have closed, or at once in manual mode, they are the operator's.
TEST(a_spool_moved_by_hand_is_no_fault) {
  for (const bool manual : {false, true}) {
    Running running;
    running.step(running.at_rest(false));
    running.step(manual ? with_open_spool(running.at_rest(false)) : running.at_rest(false));
    for (int n = 0; n < 60; ++n) {
      ExcavatorInputs inputs = with_open_spool(running.at_rest(false));
      inputs.driver.mode.value = manual ? OperatorMode::kManual : OperatorMode::kAutomatic;
      running.step(inputs);
      assert_false(running.outputs.pilot_cut);
      assert_int_equal(running.outputs.status.fault, Fault::kNone);
    }
  }
}

/// 40 mm at once are too much for the boom in 10 ms, not in 40 ms: frames that were refused give it
/// no time.
TEST(a_small_jump_that_stays_stops, Running running) {
  running.step(running.inputs());
  for (int n = 0; n < 5; ++n) {
    ExcavatorInputs inputs = running.inputs();
    inputs.axis[kBoom].stroke_m.value += 0.04;
    running.step(inputs);
  }
  assert_int_equal(running.outputs.status.mode, EcuMode::kFault);
  assert_true(running.outputs.status.faults.has(Fault::kStrokeJump));
  assert_neutral(running.outputs);
}

TEST(what_another_run_has_learnt_is_begun_with_if_it_can_be) {
  const auto setup = std::make_shared<ExcavatorSetup>(test::excavator().profile);
  ExcavatorController controller(*setup);
  LearntDrives learnt{};
  learnt[kArm] = {0.05, -0.07};
  assert_true(controller.begin(learnt));
  assert_near(controller.learnt()[kArm].extend, 0.05, 0.0);
  assert_near(controller.learnt()[kArm].retract, -0.07, 0.0);
  // What it stores is sealed with that: the next cycle is none of broken memory.
  const ExcavatorOutputs outputs = controller.step(test::complete_inputs(kSecondUs), kSecondUs);
  assert_false(outputs.status.faults.has(Fault::kMemoryCorrupt));
  assert_false(outputs.status.edges[kArm].extend.known);
  assert_near(controller.learnt()[kArm].extend, 0.05, 1e-9);
  for (const double wrong :
       {0.0701, -0.0701, 1e300, std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (const bool extends : {true, false}) {
      LearntDrives off = learnt;
      (extends ? off[kSwing].extend : off[kBoom].retract) = wrong;
      off[kArm].extend = 0.01;
      assert_false(controller.begin(off));
      assert_near(controller.learnt()[kArm].extend, 0.05, 1e-9);
    }
  }
}
