// SPDX-License-Identifier: Apache-2.0
// What every kind reads of operator, bus, identity, valve and engine, and what comes of its faults.

#include "firmware/safety/common_inputs.hpp"

#include <cmath>
#include <limits>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/inputs.hpp"

constexpr TimeUs kNow = 5 * kSecondUs;
constexpr TimeUs kStale = kNow - 50 * kMillisecondUs;
constexpr EngineRange kEngine{200.0, 100.0};

/// What is read while everything is there but for what a test changes.
struct Machine {
  BusCapabilities bus;
  MachineInputs inputs = test::complete_inputs(kNow);

  [[nodiscard]] CommonValid read() const {
    CommonValid valid;
    read_machine(bus, inputs, kEngine, Freshness(0.045, kNow), kNow, valid);
    return valid;
  }
};

CommonValid with_fault(Fault fault) {
  CommonValid valid;
  valid.faults.add(fault);
  return valid;
}

/// The only one there; kNone if there is none.
Fault only_of(const FaultSet& faults) {
  assert_int_equal(faults.after(faults.first()), Fault::kNone);
  return faults.first();
}

TEST(what_is_there_is_read, Machine machine) {
  machine.inputs.driver.task_number = test::fresh<std::uint8_t>(7, kNow);
  const CommonValid valid = machine.read();
  assert_true(valid.faults.empty());
  assert_true(valid.enable && valid.automatic);
  assert_int_equal(valid.task, Task::kDig);
  assert_int_equal(valid.task_number, 7);
  assert_near(valid.speed_override_ratio, 1.0, 0.0);
  machine.inputs.driver.task_number.stamp_us = kStale;
  assert_int_equal(machine.read().task_number, -1);
}

TEST(each_of_the_operators_signals_is_required) {
  TimeUs* (*const stamps[])(OperatorInputs&) = {
      [](OperatorInputs& driver) { return &driver.enable.stamp_us; },
      [](OperatorInputs& driver) { return &driver.mode.stamp_us; },
      [](OperatorInputs& driver) { return &driver.task.stamp_us; },
      [](OperatorInputs& driver) { return &driver.speed_override_ratio.stamp_us; }};
  for (const auto& stamp : stamps) {
    Machine machine;
    *stamp(machine.inputs.driver) = kStale;
    const CommonValid valid = machine.read();
    assert_int_equal(only_of(valid.faults), Fault::kOperatorMissing);
    assert_int_equal(valid.enable, stamp != stamps[0]);
    assert_false(valid.automatic);
    assert_int_equal(valid.task, Task::kNone);
  }
  Machine released;
  released.inputs.driver.enable.value = false;
  assert_false(released.read().enable);
  assert_true(released.read().faults.empty());
}

/// A number that no mode has is none of them.
TEST(only_automatic_is_automatic, Machine machine) {
  for (const int mode : {0, 1, 2}) {
    machine.inputs.driver.mode.value = static_cast<OperatorMode>(mode);
    assert_int_equal(machine.read().automatic, mode == 1);
  }
}

TEST(each_state_of_the_bus_has_its_fault) {
  const struct {
    BusState state;
    Fault fault;
  } rows[] = {{BusState::kActive, Fault::kNone},
              {BusState::kPassive, Fault::kBusPassive},
              {BusState::kOff, Fault::kBusOff},
              {BusState::kDown, Fault::kBusDown}};
  for (const auto& row : rows) {
    Machine machine;
    machine.inputs.link.bus = row.state;
    assert_int_equal(only_of(machine.read().faults), row.fault);
  }
}

TEST(the_links_own_faults_are_taken_over, Machine machine) {
  machine.inputs.link.message_faults.add(Fault::kMessageCorrupt);
  assert_int_equal(only_of(machine.read().faults), Fault::kMessageCorrupt);
  Machine refused;
  refused.inputs.link.out_of_range = true;
  assert_int_equal(only_of(refused.read().faults), Fault::kValueOutOfRange);
  for (const int cycles : {0, 1, 2, 3}) {
    Machine dropped;
    dropped.inputs.link.dropped_cycles = cycles;
    assert_int_equal(only_of(dropped.read().faults),
                     cycles < 2 ? Fault::kNone : Fault::kTransmitFailed);
  }
}

TEST(another_machine_or_none_is_refused, Machine other) {
  other.inputs.same_machine.value = false;
  assert_int_equal(only_of(other.read().faults), Fault::kIdentityMismatch);
  Machine silent;
  silent.inputs.same_machine.stamp_us = kNow - 2500 * kMillisecondUs;
  assert_true(silent.read().faults.empty());
  silent.inputs.same_machine.stamp_us -= 1;
  assert_int_equal(only_of(silent.read().faults), Fault::kIdentityMismatch);
  silent.bus.identity = false;
  assert_true(silent.read().faults.empty());
}

TEST(an_engine_below_idle_does_not_run, Machine machine) {
  Signal<double>& speed = machine.inputs.engine_speed_radps;
  for (const double radps : {80.0, 81.0, 240.0}) {
    speed.value = radps;
    assert_true(machine.read().faults.empty());
    assert_near(machine.read().engine_radps, radps, 0.0);
  }
  for (const double radps : {0.0, std::nextafter(80.0, 0.0)}) {
    speed.value = radps;
    assert_int_equal(only_of(machine.read().faults), Fault::kEngineStopped);
  }
  assert_near(machine.read().idle_radps, 100.0, 0.0);
}

/// What no engine runs at is not measured either; slow is safe.
TEST(an_engine_that_is_not_known_is_at_idle, Machine fast) {
  fast.inputs.engine_speed_radps.value = std::nextafter(240.0, 300.0);
  Machine old;
  old.inputs.engine_speed_radps.stamp_us = kStale;
  Machine no_number;
  no_number.inputs.engine_speed_radps.value = std::numeric_limits<double>::quiet_NaN();
  for (const Machine& machine : {fast, old, no_number}) {
    assert_int_equal(only_of(machine.read().faults), Fault::kEngineSpeedMissing);
    assert_near(machine.read().engine_radps, 100.0, 0.0);
  }
}

TEST(a_stand_in_is_said, Machine machine) {
  assert_false(machine.read().stand_in);
  machine.inputs.link.cannot_answer = true;
  assert_true(machine.read().stand_in);
  machine.inputs.link.cannot_answer = false;
  machine.bus.swash_feedback = false;
  assert_true(machine.read().stand_in);
}

TEST(the_valves_echo_is_read_where_the_bus_has_it, Machine machine) {
  assert_false(machine.read().valve_enabled);
  machine.inputs.valve_enabled.value = true;
  assert_true(machine.read().valve_enabled);
  machine.bus.valve_echo = false;
  assert_false(machine.read().valve_enabled);
  machine.inputs.valve_enabled.stamp_us = kStale;
  assert_true(machine.read().faults.empty());
  machine.bus.valve_echo = true;
  assert_int_equal(only_of(machine.read().faults), Fault::kSpoolMissing);
  assert_false(machine.read().valve_enabled);
}

/// Pressure and swash slow in motion, a stroke never does.
TEST(faults_stop_or_slow) {
  for (const bool moving : {false, true}) {
    CommonValid slowing = with_fault(Fault::kPressureMissing);
    slowing.faults.add(Fault::kSwashDisagrees);
    sort_faults(moving, {}, slowing);
    assert_int_equal(slowing.fault, moving ? Fault::kNone : Fault::kPressureMissing);
    assert_true(slowing.degraded == (moving ? slowing.faults : FaultSet{}));
    // The first that stops is named, wherever what slows stands.
    slowing.faults.add(Fault::kBusOff);
    slowing.faults.add(Fault::kStrokeJump);
    slowing.fault = Fault::kNone;
    sort_faults(moving, {}, slowing);
    assert_int_equal(slowing.fault, moving ? Fault::kBusOff : Fault::kPressureMissing);
    assert_false(slowing.degraded.has(Fault::kBusOff));
    CommonValid nothing;
    sort_faults(moving, {}, nothing);
    assert_int_equal(nothing.fault, Fault::kNone);
    assert_true(nothing.degraded.empty());
  }
}

/// As long as the last value before a jump is in time it only slows.
TEST(a_bridged_jump_slows) {
  const Bridge bridge{Fault::kStrokeJump, Fault::kStrokeMissing};
  CommonValid jumped = with_fault(Fault::kStrokeJump);
  sort_faults(true, {bridge}, jumped);
  assert_int_equal(jumped.fault, Fault::kNone);
  assert_true(jumped.degraded.has(Fault::kStrokeJump));
  jumped = with_fault(Fault::kStrokeJump);
  sort_faults(false, {bridge}, jumped);
  assert_int_equal(jumped.fault, Fault::kStrokeJump);
  jumped = with_fault(Fault::kStrokeJump);
  jumped.faults.add(Fault::kStrokeMissing);
  sort_faults(true, {bridge}, jumped);
  assert_int_equal(jumped.fault, Fault::kStrokeMissing);
  assert_true(jumped.degraded.empty());
}

TEST(what_stops_slows_or_is_said_is_added, CommonValid valid) {
  stop(with_fault(Fault::kStalled).faults, valid);
  stop(with_fault(Fault::kBusOff).faults, valid);
  assert_int_equal(valid.fault, Fault::kStalled);
  assert_true(valid.faults.has(Fault::kStalled) && valid.faults.has(Fault::kBusOff));
  degrade(Fault::kSwashDisagrees, valid);
  assert_true(valid.faults.has(Fault::kSwashDisagrees));
  assert_int_equal(only_of(valid.degraded), Fault::kSwashDisagrees);
  warn(Fault::kStalling, valid);
  assert_int_equal(only_of(valid.warned), Fault::kStalling);
  assert_false(valid.faults.has(Fault::kStalling));
}

/// A machine in motion, 16 cycles a second, with what is degraded and allowed in each.
struct Slowing {
  SlowingState state;
  CommonValid seen;
  bool moving = true;

  double step(Task task, double override_ratio, Fault degraded = Fault::kNone) {
    seen = {};
    seen.task = task;
    seen.speed_override_ratio = override_ratio;
    seen.engine_radps = 150.0;
    seen.idle_radps = 100.0;
    seen.degraded.add(degraded);
    state = slow_down(0.5, state, moving, 0.0625, seen);
    return seen.speed_override_ratio;
  }
};

/// The least of the last 0.2 s; without a task nothing is held.
TEST(the_override_is_the_least_of_late, Slowing machine) {
  assert_near(machine.step(Task::kNone, 0.0), 0.0, 0.0);
  for (const Task task : {Task::kDig, Task::kGrade, Task::kProgram}) {
    assert_near(machine.step(task, 1.0), 1.0, 0.0);
    assert_near(machine.step(task, 0.25), 0.25, 0.0);
    repeat(3, [&] { assert_near(machine.step(task, 1.0), 0.25, 0.0); });
    assert_near(machine.step(task, 1.0), 1.0, 0.0);
    assert_near(machine.step(task, 0.25), 0.25, 0.0);
    assert_near(machine.step(Task::kNone, 1.0), 1.0, 0.0);
  }
}

/// As low once more counts from then on.
TEST(the_override_is_held_from_its_last_least, Slowing machine) {
  machine.step(Task::kDig, 0.25);
  machine.step(Task::kDig, 1.0);
  assert_near(machine.step(Task::kDig, 0.25), 0.25, 0.0);
  repeat(3, [&] { assert_near(machine.step(Task::kDig, 1.0), 0.25, 0.0); });
  assert_near(machine.step(Task::kDig, 1.0), 1.0, 0.0);
  // Held to the end of its time, which is past when nothing is left of it.
  machine.state.override_ratio = 0.25;
  machine.state.override_for_s = 0.0625;
  assert_near(machine.step(Task::kDig, 1.0), 1.0, 0.0);
}

TEST(what_degraded_slows_for_a_second, Slowing machine) {
  assert_near(machine.step(Task::kDig, 1.0), 1.0, 0.0);
  assert_near(machine.seen.engine_radps, 150.0, 0.0);
  assert_near(machine.step(Task::kDig, 1.0, Fault::kEngineSpeedMissing), 0.5, 0.0);
  assert_near(machine.seen.engine_radps, 100.0, 0.0);
  for (int n = 1; n < 16; ++n) {
    assert_near(machine.step(Task::kDig, 1.0), 0.5, 0.0);
    assert_int_equal(only_of(machine.seen.degraded), Fault::kEngineSpeedMissing);
    assert_near(machine.seen.engine_radps, 100.0, 0.0);
  }
  assert_near(machine.step(Task::kDig, 1.0), 1.0, 0.0);
  assert_near(machine.seen.engine_radps, 150.0, 0.0);
  // With another fault the engine's speed is the measured one.
  assert_near(machine.step(Task::kDig, 1.0, Fault::kSwashDisagrees), 0.5, 0.0);
  assert_near(machine.seen.engine_radps, 150.0, 0.0);
  machine.moving = false;
  assert_near(machine.step(Task::kDig, 1.0), 1.0, 0.0);
  machine.moving = true;
  assert_near(machine.step(Task::kDig, 1.0), 1.0, 0.0);
}

TEST(closing_ends_centred_or_by_hand) {
  constexpr Fault kUnseen = Fault::kSpoolMissing;
  CommonValid valid;
  valid.automatic = true;
  assert_true(still_closing(true, false, kUnseen, valid));
  assert_false(still_closing(false, false, kUnseen, valid));
  assert_false(still_closing(true, true, kUnseen, valid));
  valid.faults.add(kUnseen);
  assert_true(still_closing(true, true, kUnseen, valid));
  valid.automatic = false;
  assert_false(still_closing(true, false, kUnseen, valid));
  valid.faults.add(Fault::kOperatorMissing);
  assert_true(still_closing(true, true, kUnseen, valid));
}

/// A task as the operator asks for it, at four fifths of its speed.
CommonValid asked(const UnknownDrives& unknown, Task task, int number = -1) {
  CommonValid valid;
  valid.task = task;
  valid.task_number = number;
  valid.speed_override_ratio = 0.8;
  tell_unknown(unknown, valid);
  return valid;
}

void assert_left(const CommonValid& valid, double speed_ratio, Fault fault) {
  assert_near(valid.speed_override_ratio, speed_ratio, 1e-12);
  assert_int_equal(valid.fault, fault);
  assert_int_equal(only_of(valid.faults), fault);
}

TEST(a_task_that_needs_unknown_drives_is_refused_or_slow) {
  UnknownDrives unknown;
  for (const Task task : {Task::kNone, Task::kDig, Task::kGrade, Task::kProgram}) {
    assert_left(asked(unknown, task, 0), 0.8, Fault::kNone);
  }
  unknown.tasks = 1U << static_cast<unsigned>(Task::kGrade);
  unknown.programs = 1U << 2;
  for (const double left : {0.0, 0.25}) {
    unknown.speed_ratio = left;
    const Fault fault = left > 0.0 ? Fault::kNone : Fault::kTaskUnknown;
    assert_left(asked(unknown, Task::kGrade), 0.8 * left, fault);
    assert_left(asked(unknown, Task::kProgram, 2), 0.8 * left, fault);
    for (const int known : {-1, 0, 1, 3, 32, 34}) {
      assert_left(asked(unknown, Task::kProgram, known), 0.8, Fault::kNone);
    }
    for (const Task task : {Task::kNone, Task::kDig, Task::kJog, Task::kCommission}) {
      assert_left(asked(unknown, task, 2), 0.8, Fault::kNone);
    }
  }
  // What can be no speed is none.
  for (const double wrong : {-1.0, std::nan("")}) {
    unknown.speed_ratio = wrong;
    assert_int_equal(asked(unknown, Task::kGrade).fault, Fault::kTaskUnknown);
  }
  // What came first stays the first.
  CommonValid late = with_fault(Fault::kBusOff);
  late.fault = Fault::kBusOff;
  late.task = Task::kGrade;
  unknown.speed_ratio = 0.0;
  tell_unknown(unknown, late);
  assert_int_equal(late.fault, Fault::kBusOff);
  assert_true(late.faults.has(Fault::kTaskUnknown));
}
