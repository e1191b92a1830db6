// SPDX-License-Identifier: Apache-2.0
// A bus that can't say something: what it lacks is not asked for, what stands in for it still
// protects, and what a complete bus must say is missed as ever.

#include "firmware/signals/bus_capabilities.hpp"

#include "firmware/dozer/safety/dozer_watch.hpp"
#include "firmware/excavator/safety/excavator_validation.hpp"
#include "firmware/safety/cycle.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/plain_dozer.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

using Silence = void (*)(ExcavatorInputs&);

void no_identity(ExcavatorInputs& inputs) { inputs.same_machine = {}; }
void no_echo(ExcavatorInputs& inputs) { inputs.valve_enabled = {}; }
void no_spools(ExcavatorInputs& inputs) {
  for (AxisInputs& axis : inputs.axis) {
    axis.spool_ratio = {};
  }
}
void no_pressures(ExcavatorInputs& inputs) {
  for (AxisInputs& axis : inputs.axis) {
    axis.cap_pressure_pa = axis.rod_pressure_pa = {};
  }
}
void no_swash(ExcavatorInputs& inputs) { inputs.swash_ratio = {}; }

struct Case {
  bool BusCapabilities::*lacks;
  Silence silence;
  Fault missed;  ///< On a bus that should say it.
};
const Case kCases[] = {{&BusCapabilities::identity, no_identity, Fault::kIdentityMismatch},
                       {&BusCapabilities::valve_echo, no_echo, Fault::kSpoolMissing},
                       {&BusCapabilities::spool_feedback, no_spools, Fault::kSpoolMissing},
                       {&BusCapabilities::pressures, no_pressures, Fault::kPressureMissing},
                       {&BusCapabilities::swash_feedback, no_swash, Fault::kSwashMissing}};

ExcavatorProfile with_bus(ExcavatorProfile profile, bool BusCapabilities::*lacks) {
  profile.bus.*lacks = false;
  return profile;
}

TEST(our_own_bus_lacks_nothing) {
  assert_false(BusCapabilities{}.lacks_any());
  for (const Case& row : kCases) {
    BusCapabilities bus;
    bus.*row.lacks = false;
    assert_true(bus.lacks_any());
  }
  BusCapabilities bare;
  bare.protection = false;
  assert_true(bare.lacks_any());
}

ExcavatorValid seen(const ExcavatorProfile& profile, Silence silence) {
  ExcavatorInputs inputs = test::complete_inputs(kSecondUs);
  silence(inputs);
  return test::validate(inputs, profile, {}, false, kSecondUs);
}

bool shows_stand_in(const ExcavatorValid& valid) {
  CycleMemory memory;
  MachineOutputs outputs;
  MachineStatus status;
  end_cycle({}, valid, memory, outputs, status);
  return status.stand_in;
}

/// What arming and motion want of the inputs is there, and it is said that something stands in.
TEST(what_the_bus_lacks_is_not_asked_for) {
  for (const Case& row : kCases) {
    const ExcavatorValid valid = seen(with_bus(test::plain_machine(), row.lacks), row.silence);
    assert_int_equal(valid.fault, Fault::kNone);
    assert_true(valid.faults.empty());
    assert_true(valid.stand_in);
    assert_true(shows_stand_in(valid));
  }
}

TEST(what_the_bus_should_say_is_missed) {
  for (const Case& row : kCases) {
    const ExcavatorValid valid = seen(test::plain_machine(), row.silence);
    assert_int_equal(valid.fault, row.missed);
    assert_false(valid.stand_in);
    assert_false(shows_stand_in(valid));
  }
}

/// One lack does not excuse another.
TEST(each_lack_excuses_itself_alone) {
  for (const Case& lacking : kCases) {
    for (const Case& silent : kCases) {
      const ExcavatorValid valid =
          seen(with_bus(test::plain_machine(), lacking.lacks), silent.silence);
      assert_int_equal(valid.fault, silent.lacks == lacking.lacks ? Fault::kNone : silent.missed);
    }
  }
}

/// A machine in motion of whose spools nothing is heard.
struct Unseen {
  ExcavatorProfile profile = with_bus(test::plain_machine(), &BusCapabilities::spool_feedback);
  ExcavatorWatchState state;
  LastCommands<kDriveCount> cycle;
  ExcavatorValid inputs;

  Unseen() {
    cycle.moving = cycle.enable = true;
    inputs.enable = inputs.automatic = inputs.valve_enabled = true;
    for (unsigned i = 0; i < kAxisCount; ++i) {
      inputs.drive[i].stroke_m = 0.5;
    }
    inputs.swash_ratio = profile.dig_swash_ratio;
    inputs.engine_radps = 200.0;
  }
  Fault step() {
    const ExcavatorBank bank = excavator_bank(profile);
    ExcavatorValid seen = inputs;
    watch(profile, bank.rows(), cycle, profile.dig_swash_ratio, 0.01, state, seen);
    return seen.fault;
  }
  Fault run(int cycles) {
    Fault fault = Fault::kNone;
    for (int n = 0; n < cycles && fault == Fault::kNone; ++n) {
      fault = step();
    }
    return fault;
  }
};

/// Commanded closed, a cylinder that runs off is found without its spool.
TEST(the_command_stands_in_for_the_spool, Unseen machine) {
  assert_int_equal(machine.run(100), Fault::kNone);
  for (int n = 0; n < 20; ++n) {
    machine.inputs.drive[1].stroke_m += 0.005;
    const Fault fault = machine.step();
    if (fault != Fault::kNone) {
      assert_int_equal(fault, Fault::kUncommandedMotion);
      return;
    }
  }
  fail_msg("0.1 m without a command, and no fault");
}

/// Commanded open it may go there, and one that does not is stuck.
TEST(a_commanded_cylinder_may_move_and_must, Unseen machine) {
  machine.cycle.duty_ratio[1] = 0.75;
  machine.cycle.asked_mps[1] = 0.1;
  for (int n = 0; n < 100; ++n) {
    machine.inputs.drive[1].stroke_m += 0.001;
    assert_int_equal(machine.step(), Fault::kNone);
  }
  assert_int_equal(machine.run(100), Fault::kStrokeStuck);
}

/// After its command has ended, dead time and lag of the spool are waited for.
TEST(a_closing_spool_has_its_time) {
  for (const double dead_time_s : {0.0, 0.2}) {
    Unseen machine;
    machine.profile.control.dead_time_s = dead_time_s;
    machine.cycle.duty_ratio[1] = 0.75;
    machine.run(100);
    machine.cycle.duty_ratio[1] = 0.0;
    // 0.5 s for the oil, settle_s for the spool, 1.3 dead times; then 0.0625 m.
    const double allowed_s = 0.5 + 0.1 + 1.3 * dead_time_s;
    int cycles = 0;
    while (machine.step() == Fault::kNone && cycles < 500) {
      machine.inputs.drive[1].stroke_m += 0.001;
      machine.state.drives.way[1] = {};  // What was asked is another matter.
      ++cycles;
    }
    assert_near(cycles * 0.01, allowed_s + 0.63, 0.05);
  }
}

/// Nobody knows whether they are in their middle: that condition of arming is off.
TEST(unseen_spools_count_as_centred, ExcavatorValid valid) {
  for (ValidDrive& drive : valid.drive) {
    drive.spool_ratio = 1.0;
  }
  assert_false(test::spools_centred(test::plain_machine(), valid));
  assert_true(test::spools_centred(Unseen{}.profile, valid));
}

TEST(no_echo_no_fault_of_following) {
  for (const bool carried : {true, false}) {
    Unseen machine;
    machine.profile.bus.valve_echo = carried;
    machine.inputs.valve_enabled = false;
    assert_int_equal(machine.run(50), carried ? Fault::kValveNotFollowing : Fault::kNone);
  }
}

/// Its swash is no signal that is missing.
TEST(the_command_stands_in_for_the_swash) {
  const ExcavatorProfile profile =
      with_bus(test::plain_machine(), &BusCapabilities::swash_feedback);
  ExcavatorInputs inputs = test::complete_inputs(kSecondUs);
  no_swash(inputs);
  const ExcavatorValid valid = test::validate(inputs, profile, {}, false, kSecondUs);
  assert_false(valid.faults.has(Fault::kSwashMissing));
  assert_true(valid.stand_in);
}

/// A pump that sets its own swash has none that is missing.
TEST(a_regulated_pump_tells_no_swash) {
  ExcavatorProfile profile = test::plain_machine();
  ExcavatorInputs inputs = test::complete_inputs(kSecondUs);
  no_swash(inputs);
  assert_true(
      test::validate(inputs, profile, {}, false, kSecondUs).faults.has(Fault::kSwashMissing));
  for (PumpProfile& pump : profile.pump) {
    pump.regulator.kind = PumpKind::kNegativeFlow;
  }
  assert_false(
      test::validate(inputs, profile, {}, false, kSecondUs).faults.has(Fault::kSwashMissing));
}

/// Nothing is held against a pump's command but what the bus carries.
TEST(a_swash_that_is_not_carried_is_not_judged) {
  for (const bool carried : {true, false}) {
    const ExcavatorProfile profile =
        carried ? test::plain_machine()
                : with_bus(test::plain_machine(), &BusCapabilities::swash_feedback);
    const ExcavatorBank bank = excavator_bank(profile);
    ExcavatorWatchState state;
    LastCommands<kDriveCount> cycle;
    cycle.moving = cycle.enable = true;
    bool judged = false;
    for (int n = 0; n < 60; ++n) {
      ExcavatorValid seen;  // its swash is 0, which no pump was told
      seen.enable = seen.automatic = seen.valve_enabled = true;
      watch(profile, bank.rows(), cycle, profile.dig_swash_ratio, 0.01, state, seen);
      judged = judged || seen.degraded.has(Fault::kSwashDisagrees);
    }
    assert_int_equal(judged, carried);
  }
}

TEST(a_dozer_without_them_is_not_asked_either) {
  struct DozerCase {
    bool BusCapabilities::*lacks;
    void (*silence)(DozerInputs&);
    Fault missed;
  };
  const DozerCase cases[] = {
      {&BusCapabilities::identity, [](DozerInputs& inputs) { inputs.same_machine = {}; },
       Fault::kIdentityMismatch},
      {&BusCapabilities::valve_echo, [](DozerInputs& inputs) { inputs.valve_enabled = {}; },
       Fault::kSpoolMissing},
      {&BusCapabilities::spool_feedback, [](DozerInputs& inputs) { inputs.blade_spool_ratio = {}; },
       Fault::kSpoolMissing}};
  for (const DozerCase& row : cases) {
    DozerProfile profile = test::plain_dozer();
    DozerInputs inputs = test::complete_dozer_inputs(kSecondUs);
    row.silence(inputs);
    const DozerValid missed = test::validate(inputs, profile, {}, false, kSecondUs);
    assert_int_equal(missed.fault, row.missed);
    assert_false(missed.stand_in);
    profile.bus.*row.lacks = false;
    const DozerValid excused = test::validate(inputs, profile, {}, false, kSecondUs);
    assert_int_equal(excused.fault, Fault::kNone);
    assert_true(excused.stand_in);
  }
}

/// The blade's spool stuck open shows where it is measured; unseen, a blade that runs off shows.
TEST(the_blade_is_watched_by_its_command) {
  DozerProfile profile = test::plain_dozer();
  profile.bus.spool_feedback = false;
  DozerWatchState state;
  const DozerBank bank = dozer_bank(profile);
  DozerLastCommands cycle;
  cycle.drives.moving = cycle.drives.enable = true;
  DozerValid inputs;
  inputs.valve_enabled = true;
  inputs.drive[0].spool_ratio = 1.0;  // is not looked at
  inputs.drive[0].stroke_m = 0.2;
  inputs.motor_ratio = cycle.ratios.motor;
  const auto fault_of = [&](DozerValid seen) {
    watch(profile, bank.rows(), cycle, 0.01, state, seen);
    return seen.fault;
  };
  repeat(100, [&] { assert_int_equal(fault_of(inputs), Fault::kNone); });
  Fault fault = Fault::kNone;
  for (int n = 0; n < 100 && fault == Fault::kNone; ++n) {
    inputs.drive[0].stroke_m += 0.005;
    fault = fault_of(inputs);
  }
  assert_int_equal(fault, Fault::kUncommandedMotion);
  assert_true(spools_centred(bank.rows(), inputs.drive));
}
