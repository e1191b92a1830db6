// SPDX-License-Identifier: Apache-2.0
// The swing as a drive among the others: what is needed of it, what its watches see, what the gate
// lets through; and that a machine without one does not look at it.

#include <cmath>
#include <limits>

#include "firmware/drives/drive_gate.hpp"
#include "firmware/excavator/safety/excavator_validation.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/inputs.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

using test::complete_inputs;
using test::validate;

constexpr TimeUs kNow = 5 * kSecondUs;
constexpr double kPeriod_s = 0.0625;
constexpr double kLever_m = 0.125;
constexpr double kOpen = 0.75;  // Duty; a spool begins to open at 0.25.

const ExcavatorProfile& profile() {
  static const ExcavatorProfile machine = test::plain_machine_with_swing();
  return machine;
}
const ExcavatorProfile& without_swing() {
  static const ExcavatorProfile machine = test::plain_machine();
  return machine;
}

TEST(the_swing_is_read_at_its_lever) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.swing.angle_rad.value = -1.5;
  inputs.swing.spool_ratio.value = 0.375;
  const test::Validated valid = validate(inputs, profile(), {}, false, kNow);
  assert_int_equal(valid.fault, Fault::kNone);
  assert_near(valid.drive[kSwing].stroke_m, -1.5 * kLever_m, 0.0);
  assert_near(valid.drive[kSwing].cap_pressure_pa, 4e6, 0.0);
  assert_near(valid.drive[kSwing].rod_pressure_pa, 3e6, 0.0);
  assert_near(valid.drive[kSwing].spool_ratio, 0.375, 0.0);
  assert_true(valid.drive[kSwing].load_known);
}

struct Row {
  Signal<double>* (*signal)(SwingInputs&);
  Fault missing;
  Fault wrong;
};
const Row kRows[] = {
    {[](SwingInputs& in) { return &in.angle_rad; }, Fault::kStrokeMissing, Fault::kSensorError},
    {[](SwingInputs& in) { return &in.left_pressure_pa; }, Fault::kPressureMissing,
     Fault::kPressureImplausible},
    {[](SwingInputs& in) { return &in.right_pressure_pa; }, Fault::kPressureMissing,
     Fault::kPressureImplausible},
    {[](SwingInputs& in) { return &in.spool_ratio; }, Fault::kSpoolMissing, Fault::kSensorError},
};

TEST(each_of_its_signals_is_required) {
  for (const Row& row : kRows) {
    for (const Validity validity : {Validity::kNotReceived, Validity::kNotAvailable,
                                    Validity::kError, Validity::kOutOfRange}) {
      ExcavatorInputs inputs = complete_inputs(kNow);
      row.signal(inputs.swing)->validity = validity;
      const test::Validated valid = validate(inputs, profile(), {}, false, kNow);
      assert_int_equal(valid.fault, row.missing);
      assert_int_equal(valid.faults.has(row.wrong), validity == Validity::kError);
      assert_int_equal(valid.drive[kSwing].load_known, row.missing != Fault::kPressureMissing);
    }
    ExcavatorInputs old = complete_inputs(kNow);
    row.signal(old.swing)->stamp_us = kNow - 45 * kMillisecondUs - 1;
    assert_int_equal(validate(old, profile(), {}, true, kNow).faults.first(), row.missing);
    ExcavatorInputs no_number = complete_inputs(kNow);
    row.signal(no_number.swing)->value = std::numeric_limits<double>::quiet_NaN();
    assert_int_equal(validate(no_number, profile(), {}, false, kNow).fault, row.missing);
  }
}

/// Whatever another machine's swing says, nothing of it is known here.
TEST(without_a_swing_drive_nothing_is_looked_at) {
  for (const Row& row : kRows) {
    ExcavatorInputs inputs = complete_inputs(kNow);
    row.signal(inputs.swing)->validity = Validity::kError;
    const test::Validated valid = validate(inputs, without_swing(), {}, false, kNow);
    assert_true(valid.faults.empty());
    assert_near(valid.drive[kSwing].stroke_m, 0.0, 0.0);
    assert_false(valid.drive[kSwing].load_known);
  }
}

/// 3.2 rad are the end of what its sensor tells.
TEST(an_angle_beyond_its_sensor_is_implausible) {
  for (const double sign : {1.0, -1.0}) {
    ExcavatorInputs inputs = complete_inputs(kNow);
    inputs.swing.angle_rad.value = sign * 3.2;
    assert_int_equal(validate(inputs, profile(), {}, false, kNow).fault, Fault::kNone);
    inputs.swing.angle_rad.value = std::nextafter(sign * 3.2, sign * 9.0);
    const test::Validated beyond = validate(inputs, profile(), {}, false, kNow);
    assert_int_equal(beyond.fault, Fault::kStrokeImplausible);
    assert_near(beyond.drive[kSwing].stroke_m, sign * 3.2 * kLever_m, 0.0);
  }
}

/// Twice its highest speed, and 15 mrad at once: a tenth of a metre at the teeth.
TEST(a_jump_is_not_believed) {
  const double most_rad = 2.0 * profile().swing.speed_max_radps * 0.010 + 0.015;
  for (const double sign : {1.0, -1.0}) {
    test::StrokesAccepted last =
        validate(complete_inputs(kNow - 10'000), profile(), {}, true, kNow - 10'000).state;
    ExcavatorInputs inputs = complete_inputs(kNow);
    inputs.swing.angle_rad.value = sign * (most_rad - 1e-9);
    assert_true(validate(inputs, profile(), last, true, kNow).faults.empty());
    inputs.swing.angle_rad.value = sign * (most_rad + 1e-9);
    const test::Validated jumped = validate(inputs, profile(), last, true, kNow);
    assert_true(jumped.degraded.has(Fault::kStrokeJump));
    assert_near(jumped.drive[kSwing].stroke_m, 0.0, 0.0);
  }
}

/// Which task file is meant: none where the operator does not say, or no longer.
TEST(a_task_number_is_believed_while_it_is_fresh) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  assert_int_equal(validate(inputs, profile(), {}, false, kNow).task_number, -1);
  inputs.driver.task_number.value = 3;
  inputs.driver.task_number.validity = Validity::kValid;
  inputs.driver.task_number.stamp_us = kNow - 45 * kMillisecondUs;
  assert_int_equal(validate(inputs, profile(), {}, false, kNow).task_number, 3);
  inputs.driver.task_number.stamp_us -= 1;
  assert_int_equal(validate(inputs, profile(), {}, false, kNow).task_number, -1);
}

TEST(its_spool_is_watched) {
  for (const bool has_swing : {true, false}) {
    const ExcavatorProfile& machine = has_swing ? profile() : without_swing();
    test::SpoolWatch state;
    ExcavatorValid valid;
    valid.drive[kSwing].spool_ratio = 0.5;
    assert_int_equal(test::spools_centred(machine, valid), !has_swing);
    bool stuck = false;
    for (int n = 0; n < kSpoolWrongCycles; ++n) {
      stuck = test::watch_spools(machine, state, {}, valid).has(Fault::kSpoolStuck);
    }
    assert_int_equal(stuck, has_swing);
  }
}

/// The swing between its spool and its angle; the cylinders rest.
struct Swing {
  std::array<MotionState, kDriveCount> state{};
  double angle_rad = 0.0;
  double spool = 0.0;
  double asked_radps = 0.0;

  FaultSet step(double period_s = kPeriod_s) {
    const ExcavatorBank bank = excavator_bank(profile());
    std::array<ValidDrive, kDriveCount> seen;
    seen[kSwing].stroke_m = kLever_m * angle_rad;
    seen[kSwing].spool_ratio = spool;
    const std::array<double, kDriveCount> asked_mps = {0.0, 0.0, 0.0, kLever_m * asked_radps};
    return watch_motion(bank.rows(), seen, asked_mps, period_s, state);
  }
  void run(int cycles) {
    repeat(cycles, [&] { assert_true(step().empty()); });
  }
};

/// 0.25 rad from where it came to rest, either way, and not a bit further.
TEST(a_swing_that_drifts_is_uncommanded) {
  for (const double sign : {1.0, -1.0}) {
    Swing swing;
    swing.run(60);
    swing.angle_rad = sign * 0.25;
    assert_true(swing.step(0.0).empty());
    swing.angle_rad = std::nextafter(sign * 0.25, sign * 9.0);
    assert_true(swing.step(0.0).has(Fault::kUncommandedMotion));
  }
}

/// 0.5 s and the 2 s that 1 rad/s takes at 0.5 rad/s^2: 40 cycles from its spool's closing.
TEST(its_mass_may_come_to_rest, Swing swing) {
  swing.spool = kOpen;
  swing.run(60);
  swing.spool = 0.0;
  for (int n = 0; n < 40; ++n) {
    swing.angle_rad += 0.0625;
    assert_true(swing.step().empty());
  }
  swing.angle_rad += 0.3125;
  assert_true(swing.step().has(Fault::kUncommandedMotion));
}

/// 0.5 rad asked of it while it stands.
TEST(a_swing_that_stands_still_is_stuck) {
  for (const double sign : {1.0, -1.0}) {
    Swing swing;
    swing.spool = sign * kOpen;
    swing.run(60);
    swing.asked_radps = sign;
    swing.run(8);
    assert_true(swing.step().has(Fault::kStrokeStuck));
  }
}

/// A swing that nothing is wanted of trips nothing, for as long as it stands.
TEST(a_swing_at_rest_is_well, Swing swing) {
  for (int n = 0; n < 2000; ++n) {
    swing.angle_rad = n % 2 == 0 ? 1e-4 : -1e-4;
    assert_true(swing.step().empty());
  }
}

/// Its pressures stand still over 0.06 m of travel, or at the rail.
TEST(its_pressures_are_watched) {
  for (const bool right : {false, true}) {
    for (const bool has_swing : {true, false}) {
      const ExcavatorProfile& machine = has_swing ? profile() : without_swing();
      const ExcavatorBank bank = excavator_bank(machine);
      ExcavatorWatchState state;
      LastCommands<kDriveCount> cycle;
      cycle.moving = true;
      bool wrong = false;
      for (int n = 0; n < 40; ++n) {
        ExcavatorValid valid;
        valid.drive[kSwing].load_known = has_swing;
        valid.drive[kSwing].cap_pressure_pa = right ? 5e6 + n : 5e6;
        valid.drive[kSwing].rod_pressure_pa = right ? 5e6 : 5e6 + n;
        valid.drive[kSwing].stroke_m = 0.004 * n;
        valid.drive[kSwing].spool_ratio = 0.0;
        watch(machine, bank.rows(), cycle, machine.dig_swash_ratio, 0.01, state, valid);
        wrong = wrong || valid.degraded.has(Fault::kPressureImplausible);
        assert_int_equal(valid.drive[kSwing].load_known, has_swing && !wrong);
      }
      assert_int_equal(wrong, has_swing);
    }
  }
}

TEST(the_gate_lets_it_through_like_the_others) {
  const double travel_m = profile().valve.spool_travel_m;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double sign : {1.0, -1.0}) {
    const test::Gated open =
        test::gate(profile(), {}, true, {0.0, 0.0, 0.0, sign * 0.5 * travel_m}, 1.0);
    assert_true(open.enable);
    assert_near(open.duty_ratio[kSwing], sign * 0.625, 1e-12);
    assert_near(open.duty_ratio[kBoom], 0.0, 0.0);
    assert_near(
        test::gate(profile(), open.state, false, {0.0, 0.0, 0.0, travel_m}, 1.0).duty_ratio[3], 0.0,
        0.0);
  }
  const test::Gated refused = test::gate(profile(), {}, true, {travel_m, 0.0, 0.0, nan}, 1.0);
  assert_false(refused.enable);
  assert_int_equal(refused.fault, Fault::kCommandNotFinite);
  const test::Gated held =
      test::gate(without_swing(), {}, true, {travel_m, 0.0, 0.0, travel_m}, 1.0);
  assert_true(held.enable);
  assert_near(held.duty_ratio[kSwing], 0.0, 0.0);
}
