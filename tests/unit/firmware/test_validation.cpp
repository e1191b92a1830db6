// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "firmware/excavator/safety/excavator_validation.hpp"
#include "firmware/hydraulics/flow.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/inputs.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

using test::complete_inputs;
using test::validate;

constexpr TimeUs kNow = 5 * kSecondUs;

const ExcavatorProfile& profile() {
  static const ExcavatorProfile machine = test::plain_machine();
  return machine;
}

test::Validated judged(const ExcavatorInputs& inputs, const ExcavatorProfile& machine = profile()) {
  return validate(inputs, machine, {}, false, kNow);
}
Fault fault_of(const ExcavatorInputs& inputs) { return judged(inputs).fault; }

TEST(complete_inputs_become_a_state) {
  const test::Validated valid = judged(complete_inputs(kNow));
  assert_int_equal(valid.fault, Fault::kNone);
  assert_true(valid.enable && valid.automatic);
  assert_int_equal(valid.task, Task::kDig);
  assert_near(valid.drive[kArm].stroke_m, 1.1, 0.0);
  assert_true(valid.faults.empty() && valid.degraded.empty());
  for (unsigned i = 0; i < kAxisCount; ++i) {
    assert_true(valid.drive[i].load_known);
    assert_near(valid.drive[i].cap_pressure_pa, 4e6, 0.0);
    assert_near(valid.drive[i].rod_pressure_pa, 3e6, 0.0);
  }
}

/// 2 pi 1e-5 and 4 pi 1e-5 m3/rev; a swash that reads below zero pumps nothing.
TEST(flow_is_displacement_speed_and_swash) {
  assert_near(pump_flow_m3ps(profile().pump[0], 200.0, 0.5), 1e-3, 1e-15);
  assert_near(pump_flow_m3ps(profile().pump[1], 200.0, 0.75), 3e-3, 1e-15);
  assert_near(pump_flow_m3ps(profile().pump[0], 200.0, -0.01), 0.0, 0.0);
}

/// What a machine with one pump says of a second is neither missed nor read.
TEST(a_second_pump_that_is_not_there) {
  ExcavatorProfile single = profile();
  single.pump_count = 1;
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.swash_ratio[1].validity = Validity::kNotAvailable;
  test::Validated valid = judged(inputs, single);
  assert_int_equal(valid.fault, Fault::kNone);
  assert_true(valid.faults.empty());
  assert_near(valid.swash_ratio[1], 0.0, 0.0);
  inputs.swash_ratio[1].validity = Validity::kError;
  assert_true(judged(inputs, single).faults.empty());
  inputs.swash_ratio[0].validity = Validity::kNotAvailable;
  assert_int_equal(judged(inputs, single).fault, Fault::kSwashMissing);
}

/// Every required signal, each in every state that is not usable, gives its own fault.
TEST(each_signal_is_required) {
  struct Row {
    Signal<double>* (*signal)(ExcavatorInputs&, unsigned number);
    unsigned count;
    Fault fault;
  };
  using In = ExcavatorInputs;
  const Row rows[] = {
      {[](In& in, unsigned i) { return &in.axis[i].stroke_m; }, 3, Fault::kStrokeMissing},
      {[](In& in, unsigned i) { return &in.axis[i].cap_pressure_pa; }, 3, Fault::kPressureMissing},
      {[](In& in, unsigned i) { return &in.axis[i].rod_pressure_pa; }, 3, Fault::kPressureMissing},
      {[](In& in, unsigned i) { return &in.axis[i].spool_ratio; }, 3, Fault::kSpoolMissing},
      {[](In& in, unsigned i) { return &in.swash_ratio[i]; }, 2, Fault::kSwashMissing},
      {[](In& in, unsigned) { return &in.engine_speed_radps; }, 1, Fault::kEngineSpeedMissing},
      {[](In& in, unsigned) { return &in.driver.speed_override_ratio; }, 1,
       Fault::kOperatorMissing},
  };
  for (const Row& row : rows) {
    for (unsigned number = 0; number < row.count; ++number) {
      const auto fault_with = [&](const auto& spoil) {
        ExcavatorInputs inputs = complete_inputs(kNow);
        spoil(*row.signal(inputs, number));
        return fault_of(inputs);
      };
      for (const Validity validity : {Validity::kNotReceived, Validity::kNotAvailable,
                                      Validity::kError, Validity::kOutOfRange}) {
        assert_int_equal(fault_with([&](auto& signal) { signal.validity = validity; }), row.fault);
      }
      const TimeUs oldest = kNow - 45 * kMillisecondUs;
      const auto fault_at = [&](TimeUs stamp_us) {
        return fault_with([&](auto& signal) { signal.stamp_us = stamp_us; });
      };
      assert_int_equal(fault_at(oldest), Fault::kNone);
      for (const TimeUs wrong :
           {kNow - 50 * kMillisecondUs, oldest - 1, kNow + 1, std::numeric_limits<TimeUs>::min(),
            std::numeric_limits<TimeUs>::max()}) {
        assert_int_equal(fault_at(wrong), row.fault);
      }
    }
  }
}

TEST(a_value_that_is_no_number_is_missing) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.axis[0].stroke_m.value = std::numeric_limits<double>::quiet_NaN();
  assert_int_equal(fault_of(inputs), Fault::kStrokeMissing);
  inputs = complete_inputs(kNow);
  inputs.driver.speed_override_ratio.value = std::numeric_limits<double>::quiet_NaN();
  assert_int_equal(fault_of(inputs), Fault::kOperatorMissing);
}

TEST(enable_must_be_fresh) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.driver.enable.stamp_us = kNow - 60 * kMillisecondUs;
  const test::Validated stale = judged(inputs);
  assert_false(stale.enable);
  assert_int_equal(stale.fault, Fault::kOperatorMissing);
}

/// Each of the operator's signals by itself; without them there is neither task nor speed.
TEST(the_operator_must_be_whole) {
  const auto stale = kNow - 60 * kMillisecondUs;
  void (*const losses[])(OperatorInputs&) = {
      [](OperatorInputs& driver) { driver.enable.stamp_us = stale; },
      [](OperatorInputs& driver) { driver.mode.stamp_us = stale; },
      [](OperatorInputs& driver) { driver.task.stamp_us = stale; },
      [](OperatorInputs& driver) { driver.mode.validity = Validity::kNotAvailable; },
      [](OperatorInputs& driver) { driver.task.validity = Validity::kError; },
      [](OperatorInputs& driver) { driver.speed_override_ratio.stamp_us = stale; }};
  for (const auto& lose : losses) {
    ExcavatorInputs inputs = complete_inputs(kNow);
    lose(inputs.driver);
    const test::Validated valid = judged(inputs);
    assert_int_equal(valid.fault, Fault::kOperatorMissing);
    assert_false(valid.automatic);
    assert_int_equal(valid.task, Task::kNone);
    assert_near(valid.speed_override_ratio, 0.0, 0.0);
  }
}

TEST(what_the_operator_gives_is_read) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.driver.enable.value = false;
  inputs.driver.mode.value = OperatorMode::kManual;
  inputs.driver.speed_override_ratio.value = 1.5;
  const test::Validated manual = judged(inputs);
  assert_int_equal(manual.fault, Fault::kNone);
  assert_false(manual.enable);
  assert_false(manual.automatic);
  assert_near(manual.speed_override_ratio, 1.0, 0.0);
  inputs.driver.speed_override_ratio.value = -0.5;
  assert_near(judged(inputs).speed_override_ratio, 0.0, 0.0);
}

/// The echo belongs to the spools' frame.
TEST(the_valves_echo_is_required) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.valve_enabled.value = true;
  assert_true(judged(inputs).valve_enabled);
  inputs.valve_enabled.stamp_us = kNow - 50 * kMillisecondUs;
  const test::Validated stale = judged(inputs);
  assert_int_equal(stale.fault, Fault::kSpoolMissing);
  assert_false(stale.valve_enabled);
  inputs.valve_enabled = test::fresh(true, kNow);
  inputs.valve_enabled.validity = Validity::kNotAvailable;
  assert_int_equal(fault_of(inputs), Fault::kSpoolMissing);
}

/// A machine with another profile, one that does not say, and one that fell silent.
TEST(another_machine_is_refused) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.same_machine.value = false;
  assert_int_equal(fault_of(inputs), Fault::kIdentityMismatch);
  inputs.same_machine = {};
  assert_int_equal(fault_of(inputs), Fault::kIdentityMismatch);
  inputs.same_machine = test::fresh(true, kNow - 2 * kSecondUs);
  assert_int_equal(fault_of(inputs), Fault::kNone);
  inputs.same_machine = test::fresh(true, kNow - 3 * kSecondUs);
  assert_int_equal(fault_of(inputs), Fault::kIdentityMismatch);
}

TEST(strokes_outside_their_cylinder_are_implausible) {
  const double most = profile().geometry.cylinder[kBucket].stroke_m;
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.axis[kBucket].stroke_m.value = most + 0.002;  // A worn encoder at the stroke's end.
  const test::Validated biased = judged(inputs);
  assert_int_equal(biased.fault, Fault::kNone);
  assert_near(biased.drive[kBucket].stroke_m, most, 0.0);
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    const double out_m = profile().geometry.cylinder[axis].stroke_m + kStrokeMargin_m;
    for (const double edge_m : {out_m, -kStrokeMargin_m}) {
      ExcavatorInputs at_edge = complete_inputs(kNow);
      at_edge.axis[axis].stroke_m.value = edge_m;
      assert_int_equal(fault_of(at_edge), Fault::kNone);
      at_edge.axis[axis].stroke_m.value = std::nextafter(edge_m, 9.0 * edge_m);
      assert_int_equal(fault_of(at_edge), Fault::kStrokeImplausible);
    }
  }
  inputs.axis[kBucket].stroke_m.value = -0.002;
  assert_near(judged(inputs).drive[kBucket].stroke_m, 0.0, 0.0);
}

/// Each of its own; no pressure is below nothing because of it, and one that is stays so.
TEST(zeros_are_taken_off) {
  ExcavatorProfile machine = profile();
  machine.sensor_zero.stroke_m = {0.01, -0.02, 0.03};
  machine.sensor_zero.cap_pa = {1e6, -0.5e6, 5e6};
  machine.sensor_zero.rod_pa = {0.25e6, 4e6, -1e6};
  const ExcavatorInputs inputs = complete_inputs(kNow);
  const test::Validated valid = judged(inputs, machine);
  assert_int_equal(valid.fault, Fault::kNone);
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    const double shown_m = inputs.axis[axis].stroke_m.value;
    assert_near(valid.drive[axis].stroke_m, shown_m - machine.sensor_zero.stroke_m[axis], 1e-12);
  }
  assert_near(valid.drive[kBoom].cap_pressure_pa, 3e6, 1e-3);
  assert_near(valid.drive[kArm].cap_pressure_pa, 4.5e6, 1e-3);
  assert_near(valid.drive[kBucket].cap_pressure_pa, 0.0, 0.0);
  assert_near(valid.drive[kBoom].rod_pressure_pa, 2.75e6, 1e-3);
  assert_near(valid.drive[kArm].rod_pressure_pa, 0.0, 0.0);
  assert_near(valid.drive[kBucket].rod_pressure_pa, 4e6, 1e-3);
}

/// Levers and duties, all in their places, and at rest where they are.
TEST(what_the_hands_do_is_read) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  test::Validated valid = judged(inputs);
  assert_true(valid.hands_rest());
  inputs.lever_ratio = test::fresh(std::array<double, 4>{0.1, -0.2, 0.3, -0.4}, kNow);
  valid = judged(inputs);
  assert_false(valid.hands_rest());
  for (const double lever : {valid.lever_ratio[0], -0.5 * valid.lever_ratio[1],
                             valid.lever_ratio[2] / 3.0, -0.25 * valid.lever_ratio[3]}) {
    assert_near(lever, 0.1, 1e-15);
  }
  inputs.lever_ratio = {};
  inputs.tried_ratio = test::fresh(std::array<double, 3>{0.0, 0.0, -0.3}, kNow);
  valid = judged(inputs);
  assert_false(valid.hands_rest());
  assert_near(valid.tried_ratio[2], -0.3, 0.0);
}

/// Only the task that goes by them needs them, as fresh as all that the operator gives.
TEST(a_task_by_hand_needs_its_hands) {
  for (const Task task :
       {Task::kDig, Task::kJog, Task::kCoordinated, Task::kCommission, Task::kAssist}) {
    const bool by_lever = task != Task::kDig && task != Task::kCommission;
    ExcavatorInputs inputs = complete_inputs(kNow);
    inputs.driver.task.value = task;
    assert_int_equal(fault_of(inputs), task == Task::kDig ? Fault::kNone : Fault::kOperatorMissing);
    inputs.lever_ratio = test::fresh(std::array<double, 4>{}, kNow);
    assert_int_equal(fault_of(inputs),
                     task == Task::kCommission ? Fault::kOperatorMissing : Fault::kNone);
    inputs.tried_ratio = test::fresh(std::array<double, 3>{}, kNow);
    assert_int_equal(fault_of(inputs), Fault::kNone);
    if (task == Task::kDig) {
      continue;
    }
    ExcavatorInputs old = inputs;
    TimeUs& stamp_us = by_lever ? old.lever_ratio.stamp_us : old.tried_ratio.stamp_us;
    stamp_us = kNow - 45 * kMillisecondUs;
    assert_int_equal(fault_of(old), Fault::kNone);
    stamp_us -= 1;
    assert_int_equal(fault_of(old), Fault::kOperatorMissing);
    ExcavatorInputs wrong = inputs;
    (by_lever ? wrong.lever_ratio.value[1] : wrong.tried_ratio.value[1]) =
        std::numeric_limits<double>::quiet_NaN();
    assert_int_equal(fault_of(wrong), Fault::kOperatorMissing);
    (by_lever ? wrong.lever_ratio.validity : wrong.tried_ratio.validity) = Validity::kError;
    assert_int_equal(fault_of(wrong), Fault::kOperatorMissing);
  }
}

TEST(no_three_duties_are_tried) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.driver.task.value = Task::kCommission;
  inputs.tried_ratio = test::fresh(std::array<double, 3>{0.1, 0.0, -0.1}, kNow);
  assert_int_equal(fault_of(inputs), Fault::kNone);
  inputs.tried_ratio.value[1] = 0.1;
  assert_int_equal(fault_of(inputs), Fault::kCommissionBound);
  inputs.driver.task.value = Task::kDig;
  assert_int_equal(fault_of(inputs), Fault::kNone);
}

/// Windows come by turns: each counts for a second.
TEST(windows_hold_for_a_second) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    ExcavatorInputs inputs = complete_inputs(kNow);
    inputs.window[axis] = test::fresh(StrokeWindow{0.1, 0.2, 0.3}, kNow - kSecondUs);
    test::Validated valid = judged(inputs);
    for (unsigned i = 0; i < kAxisCount; ++i) {
      assert_near(valid.window[i].least_m, i == axis ? 0.1 : 0.0, 0.0);
      assert_near(valid.window[i].most_m, i == axis ? 0.2 : 0.0, 0.0);
      assert_near(valid.window[i].most_mps, i == axis ? 0.3 : 0.0, 0.0);
    }
    inputs.window[axis].stamp_us -= 1;
    assert_near(judged(inputs).window[axis].most_mps, 0.0, 0.0);
    inputs.window[axis].stamp_us = kNow;
    inputs.window[axis].validity = Validity::kNotAvailable;
    assert_near(judged(inputs).window[axis].most_mps, 0.0, 0.0);
  }
}

/// Strokes found from IMUs stand in the place of those that are sent, and as they do.
TEST(strokes_from_imus_stand_as_measured_ones) {
  ExcavatorProfile machine = profile();
  machine.imu.mount[0].address = 226;
  const ExcavatorBank bank = excavator_bank(machine);
  ExcavatorInputs inputs = complete_inputs(kNow);
  std::array<Signal<double>, kAxisCount> strokes_m;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    strokes_m[axis] = inputs.axis[axis].stroke_m;
    strokes_m[axis].value += 0.05;
    inputs.axis[axis].stroke_m.validity = Validity::kNotAvailable;
  }
  test::StrokesAccepted last{};
  const auto valid_with = [&](Span<const Signal<double>> strokes) {
    return graben::validate(machine, bank.rows(), inputs, false, kNow, last, strokes);
  };
  const ExcavatorValid valid = valid_with(strokes_m);
  assert_int_equal(valid.fault, Fault::kNone);
  assert_true(valid.stand_in);
  assert_near(valid.drive[kArm].stroke_m, 1.15, 1e-12);
  strokes_m[kArm].validity = Validity::kNotAvailable;
  assert_int_equal(valid_with(strokes_m).fault, Fault::kStrokeMissing);
}
