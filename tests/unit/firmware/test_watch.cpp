// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/safety/excavator_validation.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/watched_machine.hpp"

using namespace graben::test;

TEST(a_machine_that_obeys_is_left_alone, Machine machine) {
  for (int n = 0; n < 200; ++n) {
    assert_well(machine.step());
    // 2 pi 1e-5 and 4 pi 1e-5 m3/rev at 200 rad/s, swash 0.5 and 0.75.
    assert_near(machine.seen.pump_flow_m3ps[0], 1e-3, 1e-15);
    assert_near(machine.seen.pump_flow_m3ps[1], 3e-3, 1e-15);
  }
}

TEST(spools_and_cylinders_stop, Machine stuck) {
  stuck.run(20);
  stuck.inputs.drive[kArm].spool_ratio = 0.1875;  // Off, and yet within its deadband.
  stuck.run(kSpoolWrongCycles - 1);
  assert_well(stuck.seen);
  assert_stopped_by(Fault::kSpoolStuck, stuck.step());

  Machine drifting;
  drifting.run(20);
  drifting.inputs.drive[kBoom].stroke_m = 0.25;
  assert_stopped_by(Fault::kUncommandedMotion, drifting.step());

  Machine still;
  still.cycle.duty_ratio[kBucket] = still.inputs.drive[kBucket].spool_ratio = 0.75;
  still.cycle.asked_mps[kBucket] = 0.5;
  still.run(3);
  assert_well(still.seen);
  assert_stopped_by(Fault::kStrokeStuck, still.step());
}

/// Each drive that stands open with nothing in it; not while duties are tried, nor kept from then.
TEST(a_drive_that_its_pump_does_not_feed_stops) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    Machine machine;
    machine.frozen = true;
    machine.cycle.duty_ratio[axis] = machine.inputs.drive[axis].spool_ratio = 0.75;
    machine.cycle.asked_mps[axis] = 0.02;
    machine.run(4);
    assert_well(machine.seen);
    assert_stopped_by(Fault::kEngineDoubtful, machine.step());
    machine.cycle.tried = true;
    assert_false(machine.step().faults.has(Fault::kEngineDoubtful));
    machine.cycle.tried = false;
    machine.state.drives.tried_s = 0.0;
    machine.run(4);
    assert_false(machine.seen.faults.has(Fault::kEngineDoubtful));
  }
}

TEST(pressures_and_swash_slow, Machine pressure) {
  pressure.step();
  pressure.frozen = true;
  pressure.inputs.drive[kArm].rod_pressure_pa = 40e6;
  pressure.run(4);
  assert_well(pressure.seen);
  assert_slowed_by(Fault::kPressureImplausible, pressure.step());
  assert_true(pressure.seen.faults.has(Fault::kPressureImplausible));
  assert_true(pressure.seen.drive[kBoom].load_known);
  assert_false(pressure.seen.drive[kArm].load_known);
  assert_true(pressure.seen.drive[kBucket].load_known);

  Machine swash;
  swash.inputs.swash_ratio = {1.0, 0.0};
  swash.run(8);
  assert_well(swash.seen);
  assert_near(swash.seen.pump_flow_m3ps[0], 2e-3, 1e-15);
  assert_slowed_by(Fault::kSwashDisagrees, swash.step());
  assert_true(swash.seen.faults.has(Fault::kSwashDisagrees));
  assert_near(swash.seen.pump_flow_m3ps[0], 1e-3, 1e-15);  // As commanded: less than said.
  assert_near(swash.seen.pump_flow_m3ps[1], 0.0, 0.0);
  // Armed, without a command to the pumps, nothing is asked of them.
  swash.cycle.enable = swash.inputs.valve_enabled = false;
  swash.run(20);
  assert_well(swash.seen);
}

/// What came in as a stop stays the first; the watches' own are added.
TEST(the_first_fault_stays_the_first, Machine machine) {
  machine.inputs.valve_enabled = false;
  machine.run(kEchoCycles - 1);
  machine.inputs.fault = Fault::kBusOff;
  machine.inputs.faults.add(Fault::kBusOff);
  const ExcavatorValid& both = machine.step();
  assert_int_equal(both.fault, Fault::kBusOff);
  assert_true(both.faults.has(Fault::kBusOff));
  assert_true(both.faults.has(Fault::kValveNotFollowing));
  machine.inputs.fault = Fault::kNone;
  machine.inputs.faults = {};
  assert_stopped_by(Fault::kValveNotFollowing, machine.step());
}

/// With a fault that stops, the cylinders' watches begin afresh: no second fault from half of the
/// truth.
TEST(a_stopped_machine_is_not_judged, Machine machine) {
  machine.run(20);
  machine.inputs.fault = Fault::kStrokeMissing;
  machine.inputs.faults.add(Fault::kStrokeMissing);
  set_strokes(machine.inputs, {0.0, 0.0, 0.0, 0.0});
  machine.run(20);
  assert_true(machine.seen.faults == machine.inputs.faults);
  assert_near(machine.state.drives.motion[0].since_s, 0.0, 0.0);
}

/// A machine whose operator has let go of it while its spools were open.
struct Released : Machine {
  Released() {
    run(20);
    cycle = {};
    inputs.valve_enabled = false;
    set_spools(inputs, {0.0, 0.75, 0.0});
  }
  bool stuck_after(int count) {
    run(count);
    return seen.faults.has(Fault::kSpoolStuck);
  }
};

TEST(a_spool_that_does_not_close_after_motion_is_stuck, Released machine) {
  assert_true(machine.stuck_after(30));
  assert_int_equal(machine.seen.fault, Fault::kSpoolStuck);
  set_spools(machine.inputs, {0.0, 0.0, 0.0});
  assert_false(machine.stuck_after(1));
}

/// Once all have been in their middle, or manual mode says so, it is somebody's hand.
TEST(what_a_hand_opens_afterwards_is_not_stuck, Released closed) {
  set_spools(closed.inputs, {0.0, 0.0, 0.0});
  closed.run(1);
  set_spools(closed.inputs, {0.0, 0.75, 0.0});
  assert_false(closed.stuck_after(30));
  Released manual;
  manual.inputs.automatic = false;
  assert_false(manual.stuck_after(30));
}

/// Neither spools that are not seen nor an operator who is not heard have closed or taken over.
TEST(what_is_not_known_does_not_end_the_closing, Released machine) {
  machine.inputs.faults.add(Fault::kSpoolMissing);
  machine.inputs.faults.add(Fault::kOperatorMissing);
  machine.inputs.automatic = false;
  assert_false(machine.stuck_after(30));
  machine.inputs.faults = {};
  machine.inputs.faults.add(Fault::kOperatorMissing);
  assert_true(machine.stuck_after(30));
}

/// Outside motion people move it: spools, strokes, pressures, swash are theirs. The valve's echo is
/// not.
TEST(not_in_motion_the_machine_is_the_operators, Machine machine) {
  machine.cycle = {};
  machine.inputs.valve_enabled = false;
  machine.inputs.degraded.add(Fault::kPressureMissing);  // Left over; means nothing here.
  machine.frozen = true;
  machine.inputs.drive[0].cap_pressure_pa = 40e6;
  machine.inputs.swash_ratio = {1.0, 0.0};
  for (int n = 0; n < 100; ++n) {
    set_spools(machine.inputs, {1.0, -1.0, 0.75});
    set_strokes(machine.inputs, {0.01 * n, 0.5 - 0.01 * n, 0.0, 0.0});
    const ExcavatorValid& inputs = machine.step();
    assert_int_equal(inputs.fault, Fault::kNone);
    assert_true(inputs.faults.empty());
    assert_true(inputs.drive[0].load_known);
    assert_near(inputs.speed_override_ratio, 0.5, 0.0);
  }
  machine.inputs.valve_enabled = true;
  machine.run(kEchoCycles);
  assert_int_equal(machine.seen.fault, Fault::kValveNotFollowing);
}

/// Armed after that, every watch begins afresh, but for what was sent.
TEST(every_motion_begins_afresh, Machine machine) {
  machine.inputs.swash_ratio[0] = 0.0;
  machine.run(7);
  assert_true(machine.state.swash[0].off_s > 0.0);
  assert_true(machine.state.drives.motion[0].since_s > 0.0);
  machine.cycle.moving = false;
  machine.step();
  assert_near(machine.state.swash[0].off_s, 0.0, 0.0);
  assert_near(machine.state.drives.motion[0].since_s, 0.0, 0.0);
  assert_near(machine.state.drives.pressure[0][0].last_pa, 0.0, 0.0);
  machine.cycle.moving = true;
  machine.run(8);
  assert_well(machine.seen);
}

/// A value that comes and goes does not make the machine jerk: kSlowAfter_s after it has come back
/// the speed does.
TEST(what_degraded_goes_on_for_a_second, Machine machine) {
  machine.step();
  for (int round = 0; round < 2; ++round) {
    machine.inputs.degraded.add(Fault::kEngineSpeedMissing);
    assert_slowed_by(Fault::kEngineSpeedMissing, machine.step());
    assert_slowed_by(Fault::kEngineSpeedMissing, machine.step());
    machine.inputs.degraded = {};
    for (int n = 1; n < 16; ++n) {  // 15 * 0.0625 s
      assert_slowed_by(Fault::kEngineSpeedMissing, machine.step());
      assert_true(machine.seen.faults.empty());  // It is not there any more.
    }
    assert_well(machine.step());
    assert_well(machine.step());
  }
}

/// A cycle that lacks it, and it is back.
void degrade_once(Machine& machine, Fault fault) {
  machine.inputs.degraded.add(fault);
  machine.step();
  machine.inputs.degraded = {};
}

/// Several at once are all named, until the last of them has been gone for as long.
TEST(all_that_degraded_is_named, Machine machine) {
  degrade_once(machine, Fault::kPressureMissing);
  machine.run(4);
  degrade_once(machine, Fault::kValueOutOfRange);
  machine.run(15);
  assert_slowed_by(Fault::kPressureMissing, machine.seen);
  assert_slowed_by(Fault::kValueOutOfRange, machine.seen);
  assert_well(machine.step());
}

/// The next motion does not begin slow for what the last one lost.
TEST(the_end_of_motion_ends_it, Machine machine) {
  degrade_once(machine, Fault::kPressureMissing);
  machine.step();
  assert_slowed_by(Fault::kPressureMissing, machine.seen);
  machine.cycle.moving = false;
  machine.step();
  assert_near(machine.seen.speed_override_ratio, 0.5, 0.0);
  machine.cycle.moving = true;
  assert_well(machine.step());
}

/// The arm pushes with this on its cap side, and is asked to go on.
struct Pushing : Machine {
  explicit Pushing(double cap_pa) {
    DriveRow& row = bank.row[1];
    row.watch.relief_pa = 32e6;
    row.watch.pressure_rail_pa = 40e6;
    row.watch.unseen_m = row.watch.off_m = 0.0;
    cycle.duty_ratio[1] = 0.75;
    cycle.asked_mps[1] = cycle.towards_mps[1] = 0.05;
    cycle.line_pa[1] = 31e6;
    inputs.drive[1].spool_ratio = 0.75;
    inputs.drive[1].stroke_is_new = true;
    inputs.drive[1].cap_pressure_pa = cap_pa;
    frozen = true;
  }
  bool meets(Fault fault, int most) {
    for (int n = 0; n < most; ++n) {
      inputs.drive[1].cap_pressure_pa += n % 2 == 0 ? 1.0 : -1.0;
      inputs.drive[1].rod_pressure_pa = n % 2;
      if (step(0.01).faults.has(fault)) {
        return true;
      }
    }
    return false;
  }
};

/// A rock is no stuck sensor: what strains need not move. At less pressure it must.
TEST(what_its_load_holds_is_not_stuck) {
  Pushing rock(28e6);
  assert_false(rock.meets(Fault::kStrokeStuck, 1000));
  assert_int_equal(rock.state.drives.blocked[1].side, 1);
  Pushing eased(30e6);
  assert_false(eased.meets(Fault::kStrokeStuck, 60));
  eased.inputs.drive[1].cap_pressure_pa = 20e6;  // Let off, and still held.
  assert_false(eased.meets(Fault::kStrokeStuck, 100));
  assert_int_equal(eased.state.drives.blocked[1].side, 1);
  assert_false(eased.state.drives.blocked[1].strains);
  Pushing stuck(20e6);
  assert_true(stuck.meets(Fault::kStrokeStuck, 300));
  assert_int_equal(stuck.state.drives.blocked[1].side, 0);
}

/// Thrown by its own oil against its spool, while it lets off; the same without a rock before it is
/// a drive that goes the wrong way.
TEST(what_its_load_lets_go_is_not_the_wrong_way) {
  for (const double before_pa : {31e6, 10e6}) {
    Pushing arm(before_pa);
    arm.bank.row[1].watch.wrong_m = 0.010;
    arm.meets(Fault::kNone, 100);
    assert_int_equal(arm.state.drives.blocked[1].side, before_pa > 20e6 ? 1 : 0);
    arm.cycle.duty_ratio[1] = -0.75;
    arm.cycle.asked_mps[1] = -0.03;
    arm.inputs.drive[1].spool_ratio = -0.75;
    arm.meets(Fault::kNone, 20);
    bool wrong = false;
    for (int n = 0; n < 8; ++n) {
      arm.inputs.drive[1].stroke_m += 0.005;
      wrong = wrong || arm.meets(Fault::kWrongDirection, 1);
    }
    assert_int_equal(wrong, before_pa < 20e6);
  }
}

/// Nobody asks it to move: in no mode that moves, or Armed.
struct AtRest : Machine {
  AtRest() {
    for (ValidDrive& drive : inputs.drive) {
      drive.stroke_known = true;
    }
    run(5);
    cycle.active = false;
    run(20);
  }
  /// Of the boom. True: it was stopped.
  bool move(double mps, int count) {
    bool stopped = false;
    for (int n = 0; n < count; ++n) {
      inputs.drive[kBoom].stroke_m += mps * kPeriod_s;
      stopped = step().faults.has(Fault::kUncommandedMotion) || stopped;
    }
    return stopped;
  }
};

TEST(a_drive_that_moves_at_rest_stops, AtRest machine) {
  assert_well(machine.seen);
  machine.cycle.moving = false;
  machine.move(0.1, 9);
  assert_stopped_by(Fault::kUncommandedMotion, machine.seen);
}

TEST(armed_it_does_so_too, AtRest machine) {
  machine.move(0.1, 9);
  assert_stopped_by(Fault::kUncommandedMotion, machine.seen);
}

TEST(by_hand_it_is_said_alone, AtRest machine) {
  machine.cycle.moving = false;
  machine.inputs.automatic = false;
  machine.move(0.1, 12);
  assert_int_equal(machine.seen.fault, Fault::kNone);
  assert_true(machine.seen.warned.has(Fault::kUncommandedMotion));
}

/// No faster than `safety.sink`, with its spool seen in its middle.
TEST(sinking_is_said_alone, AtRest machine) {
  machine.cycle.moving = false;
  machine.profile.safety.sink_mps = 0.005;
  machine.bank = excavator_bank(machine.profile);
  AtRest unseen = machine;
  AtRest open = machine;
  assert_false(machine.move(-0.004, 220));
  assert_true(machine.seen.warned.has(Fault::kUncommandedMotion));
  unseen.inputs.faults.add(Fault::kSpoolMissing);
  assert_true(unseen.move(-0.004, 220));
  AtRest blind = machine;
  blind.profile.bus.spool_feedback = false;
  blind.bank = excavator_bank(blind.profile);
  assert_true(blind.move(-0.004, 220));
  open.inputs.drive[kBoom].spool_ratio = 0.5;
  assert_true(open.move(-0.004, 220));
}

/// The levers of his machine: said is what moves without them.
TEST(a_spool_that_a_hand_opens_moves_its_drive, AtRest machine) {
  machine.cycle.moving = false;
  machine.inputs.automatic = false;
  machine.inputs.drive[kBoom].spool_ratio = 0.5;
  machine.move(0.1, 30);
  machine.inputs.drive[kBoom].spool_ratio = 0.0;
  machine.run(20);
  assert_true(machine.seen.warned.empty());
}

/// What a sensor that fails for a moment each second does not see of it.
TEST(a_stroke_that_comes_and_goes_hides_nothing, AtRest machine) {
  machine.cycle.moving = false;
  bool stopped = false;
  for (int n = 0; n < 60 && !stopped; ++n) {
    machine.inputs.drive[kBoom].stroke_known = n % 4 != 0;
    stopped = machine.move(0.02, 1);
  }
  assert_true(stopped);
  machine.inputs.drive[kBoom].stroke_known = false;
  assert_true(machine.move(0.0, 1));
}

/// For as long as duties that were tried may still be under way.
TEST(what_was_tried_may_go_on, AtRest machine) {
  machine.cycle.tried = true;
  machine.step();
  machine.cycle = {};
  machine.move(0.1, 14);
  assert_false(machine.seen.faults.has(Fault::kUncommandedMotion));
}
