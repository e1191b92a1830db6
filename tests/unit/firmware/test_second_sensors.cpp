// SPDX-License-Identifier: Apache-2.0
// Second sensors of an excavator's joints, watched against what the controller goes by.

#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/safety/excavator_validation.hpp"
#include "firmware/safety/tuning.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

constexpr TimeUs kPeriod_us = 20 * kMillisecondUs;

struct Machine {
  ExcavatorProfile profile = test::plain_machine();
  SecondStates states;
  ExcavatorInputs inputs;
  ExcavatorValid valid;
  bool moving = true;
  TimeUs now_us = kSecondUs;
  double swing_rad = 0.0;

  Machine() {
    profile.drive_count = kDriveCount;
    profile.swing.lever_m = 0.25;
    profile.second = {{true, true, true, true}, 0.005, 0.01, 0.001, 0.002};
    for (unsigned i = 0; i < kAxisCount; ++i) {
      inputs.second_stroke_m[i] = {0.5 + 0.1 * i, Validity::kValid, 0};
    }
    inputs.second_swing_rad = {0.0, Validity::kValid, 0};
  }
  /// Frames of all, and a first sensor for each.
  const ExcavatorValid& step() {
    now_us += kPeriod_us;
    for (Signal<double>& second : inputs.second_stroke_m) {
      second.stamp_us = now_us;
    }
    inputs.second_swing_rad.stamp_us = now_us;
    return look();
  }
  const ExcavatorValid& look() {
    const ExcavatorBank bank = excavator_bank(profile);
    valid = {};
    for (unsigned i = 0; i < kAxisCount; ++i) {
      valid.drive[i].stroke_m = 0.5 + 0.1 * i;
    }
    valid.drive[kSwing].stroke_m = swing_rad * profile.swing.lever_m;
    for (ValidDrive& drive : valid.drive) {
      drive.stroke_known = knows_first;
    }
    watch_seconds(profile, bank.rows(), inputs, moving, now_us, states, valid);
    return valid;
  }
  bool knows_first = true;

  const ExcavatorValid& run(int count) {
    repeat(count, [&] { step(); });
    return valid;
  }
};

void assert_well(const ExcavatorValid& valid) {
  assert_int_equal(valid.fault, Fault::kNone);
  assert_true(valid.faults.empty() && valid.degraded.empty() && valid.warned.empty());
}

TEST(sensors_that_agree, Machine machine) { assert_well(machine.run(20)); }

/// Each joint by itself, in motion, at rest, by hand.
TEST(a_joint_that_contradicts_stops, Machine machine) {
  for (const bool moving : {true, false}) {
    for (unsigned i = 0; i < kDriveCount; ++i) {
      machine = Machine();
      machine.moving = moving;
      assert_well(machine.run(5));
      Signal<double>& second =
          i == kSwing ? machine.inputs.second_swing_rad : machine.inputs.second_stroke_m[i];
      second.value += 0.012;
      assert_well(machine.run(kWitnessApart - 1));
      const ExcavatorValid& valid = machine.step();
      assert_int_equal(valid.fault, Fault::kWitnessDisagrees);
      assert_true(valid.faults.has(Fault::kWitnessDisagrees) && valid.degraded.empty());
    }
  }
}

/// Strokes and swing have bands of their own.
TEST(bands_are_the_joints_own, Machine machine) {
  for (const double off_rad : {-0.0099, 0.0099}) {
    machine = Machine();
    machine.inputs.second_swing_rad.value = off_rad;
    assert_well(machine.run(5));
    machine.inputs.second_swing_rad.value = off_rad > 0.0 ? 0.0101 : -0.0101;
    assert_int_equal(machine.run(2).fault, Fault::kWitnessDisagrees);
  }
  machine = Machine();
  machine.inputs.second_stroke_m[1].value += 0.0049;
  assert_well(machine.run(5));
  machine.inputs.second_stroke_m[1].value += 0.0002;
  assert_int_equal(machine.run(2).fault, Fault::kWitnessDisagrees);
  machine = Machine();
  machine.run(5);
  machine.inputs.second_swing_rad.value = 0.0019;
  assert_well(machine.run(5));
  machine.inputs.second_swing_rad.value = 0.0021;
  assert_int_equal(machine.run(2).fault, Fault::kWitnessDisagrees);
}

/// A sensor that does not count turns may show the other end of its range.
TEST(a_whole_turn_is_no_difference, Machine machine) {
  machine.swing_rad = 3.14;
  machine.inputs.second_swing_rad.value = 3.141 - 2.0 * 3.14159265358979;
  assert_well(machine.run(5));
  machine.swing_rad = -3.14;
  assert_int_equal(machine.run(3).fault, Fault::kWitnessDisagrees);
}

TEST(a_joint_without_one_is_not_looked_at, Machine machine) {
  for (unsigned i = 0; i < kDriveCount; ++i) {
    machine = Machine();
    machine.profile.second.has[i] = false;
    Signal<double>& second =
        i == kSwing ? machine.inputs.second_swing_rad : machine.inputs.second_stroke_m[i];
    second = {};
    assert_well(machine.run(5));
    second = {9.0, Validity::kValid, 0};
    assert_well(machine.run(5));
  }
  machine = Machine();
  machine.profile.drive_count = kAxisCount;
  machine.inputs.second_swing_rad = {};
  machine.step();
  machine.inputs.second_swing_rad = {};
  assert_well(machine.look());
}

/// In motion it slows, at rest it does not arm, unless it is allowed to.
TEST(a_second_sensor_that_is_missing, Machine machine) {
  for (const Validity lost : {Validity::kNotReceived, Validity::kNotAvailable, Validity::kError}) {
    machine = Machine();
    machine.run(5);
    machine.inputs.second_stroke_m[2].validity = lost;
    const ExcavatorValid& valid = machine.look();
    assert_int_equal(valid.fault, Fault::kNone);
    assert_true(valid.degraded.has(Fault::kWitnessMissing));
    assert_true(valid.faults.has(Fault::kWitnessMissing));
    machine.profile.second.arms_without = true;
    assert_true(machine.look().degraded.has(Fault::kWitnessMissing));
    machine.moving = false;
    assert_int_equal(machine.look().fault, Fault::kNone);
    assert_true(machine.valid.faults.empty() && machine.valid.degraded.empty());
    assert_true(machine.valid.warned.has(Fault::kWitnessMissing));
    machine.profile.second.arms_without = false;
    assert_int_equal(machine.look().fault, Fault::kWitnessMissing);
    assert_true(machine.valid.degraded.empty());
  }
}

TEST(silence_of_frames, Machine machine) {
  machine.run(5);
  machine.now_us += 90 * kMillisecondUs;
  assert_well(machine.look());
  machine.now_us += 1;
  assert_true(machine.look().degraded.has(Fault::kWitnessMissing));
  machine = Machine();
  machine.profile.second.has = {false, false, false, true};
  machine.run(5);
  machine.now_us += 160 * kMillisecondUs;
  assert_well(machine.look());
  machine.now_us += 1;
  assert_true(machine.look().degraded.has(Fault::kWitnessMissing));
}

/// What comes back is compared with what it was installed as, not with what it was before.
TEST(silence_begins_anew, Machine machine) {
  machine.run(5);
  machine.inputs.second_stroke_m[0].validity = Validity::kError;
  machine.run(5);
  machine.inputs.second_stroke_m[0] = {0.504, Validity::kValid, 0};
  assert_well(machine.run(5));
  machine.inputs.second_stroke_m[0].value = 0.506;
  assert_int_equal(machine.run(2).fault, Fault::kWitnessDisagrees);
}

/// A first sensor that is lost is another watch's; a contradiction stops though one is missing.
TEST(either_may_fail, Machine machine) {
  machine.run(5);
  machine.knows_first = false;
  machine.inputs.second_stroke_m[0].value = 0.9;
  assert_well(machine.run(5));
  machine.knows_first = true;
  machine.inputs.second_stroke_m[1].validity = Validity::kError;
  machine.run(2);
  assert_int_equal(machine.valid.fault, Fault::kWitnessDisagrees);
  assert_true(machine.valid.degraded.has(Fault::kWitnessMissing));
}
