// SPDX-License-Identifier: Apache-2.0
// The dozer against its commands.

#include "firmware/dozer/travel/tracks.hpp"
#include "tests/unit/firmware/dozer_watch_machine.hpp"

using namespace graben::test::of_dozer;

TEST(a_machine_that_obeys_is_left_alone, Machine machine) {
  for (int n = 0; n < 200; ++n) {
    machine.drive(0.5 * std::sin(0.02 * n), 1.0);
    machine.inputs.drive[0].stroke_m = 0.5 + 0.01 * std::sin(0.02 * n);
    assert_well(machine.step());
  }
}

TEST(the_spool_and_its_echo_stop, Machine stuck) {
  stuck.run(kSpoolUnderWay);
  stuck.inputs.drive[0].spool_ratio = kOpen;
  assert_int_equal(stuck.cycles_until(Fault::kSpoolStuck), kSpoolWrongCycles);
  assert_stopped_by(Fault::kSpoolStuck, stuck.seen);
  // Within its tolerance it is well.
  stuck.inputs.drive[0].spool_ratio = 0.125;
  assert_well(stuck.step());
  stuck.cycle.drives.duty_ratio[0] = kOpen;
  stuck.step();
  stuck.cycle.drives.duty_ratio[0] = 0.0;
  stuck.inputs.drive[0].spool_ratio = kOpen;
  assert_int_equal(stuck.cycles_until(Fault::kSpoolStuck), kSpoolUnderWay - 1 + kSpoolWrongCycles);

  Machine deaf;
  deaf.inputs.valve_enabled = false;
  assert_int_equal(deaf.cycles_until(Fault::kValveNotFollowing), kEchoCycles);
  assert_stopped_by(Fault::kValveNotFollowing, deaf.seen);
  deaf.inputs.valve_enabled = true;
  assert_well(deaf.step());
}

/// What is not received is not judged, and counted afresh when it is.
TEST(a_spool_that_is_not_seen_is_not_judged, Machine machine) {
  machine.inputs.valve_enabled = false;
  machine.inputs.drive[0].spool_ratio = kOpen;
  machine.run(kSpoolWrongCycles - 1);
  machine.inputs.faults.add(Fault::kSpoolMissing);
  machine.inputs.fault = Fault::kSpoolMissing;
  machine.run(50);
  assert_false(machine.seen.faults.has(Fault::kSpoolStuck));
  assert_false(machine.seen.faults.has(Fault::kValveNotFollowing));
  machine.inputs.faults = {};
  machine.inputs.fault = Fault::kNone;
  assert_int_equal(machine.cycles_until(Fault::kSpoolStuck), kSpoolWrongCycles);
  assert_int_equal(machine.cycles_until(Fault::kValveNotFollowing),
                   kEchoCycles - kSpoolWrongCycles);
}

TEST(the_blade_stops, Machine moves) {
  moves.run(20);
  moves.inputs.drive[0].stroke_m = 0.625;
  assert_stopped_by(Fault::kUncommandedMotion, moves.step());

  Machine stuck;
  stuck.cycle.drives.duty_ratio[0] = stuck.inputs.drive[0].spool_ratio = kOpen;
  stuck.run(20);
  stuck.cycle.drives.asked_mps[0] = 0.125;
  assert_well(stuck.run(8));
  assert_stopped_by(Fault::kStrokeStuck, stuck.step());
  // Within the deadband the spool is closed, and the blade may stand.
  Machine closed;
  closed.cycle.drives.duty_ratio[0] = closed.inputs.drive[0].spool_ratio = 0.25;
  closed.cycle.drives.asked_mps[0] = 0.125;
  assert_well(closed.run(100));
}

/// Each of the four.
TEST(a_displacement_that_stays_behind_stops) {
  for (unsigned track = 0; track < kTrackCount; ++track) {
    for (const bool motor : {false, true}) {
      Machine machine;
      machine.run(kUnderWay);
      (motor ? machine.cycle.ratios.motor : machine.cycle.ratios.pump)[track] = 0.75;
      // 0.5 s are eight cycles.
      assert_false(machine.run(8).faults.has(Fault::kDisplacementDisagrees));
      machine.step();
      assert_true(machine.seen.faults.has(Fault::kDisplacementDisagrees));
      assert_false(machine.seen.faults.has(Fault::kDisplacementRunaway));
      assert_int_equal(machine.seen.fault, Fault::kDisplacementDisagrees);
    }
  }
}

TEST(a_displacement_that_runs_away_stops) {
  for (unsigned track = 0; track < kTrackCount; ++track) {
    for (const bool motor : {false, true}) {
      Machine machine;
      machine.run(kUnderWay);
      (motor ? machine.inputs.motor_ratio : machine.inputs.pump_ratio)[track] = 0.75;
      machine.inputs.track_speed_mps[track] *= motor ? 1.0 / 0.75 : 1.5;
      assert_int_equal(machine.cycles_until(Fault::kDisplacementRunaway), kRunawayCycles);
      assert_stopped_by(Fault::kDisplacementRunaway, machine.seen);
    }
  }
}

TEST(the_first_fault_stays_the_first, Machine machine) {
  machine.inputs.valve_enabled = false;
  machine.run(kEchoCycles - 1);
  machine.inputs.fault = Fault::kBusOff;
  machine.inputs.faults.add(Fault::kBusOff);
  const DozerValid& both = machine.step();
  assert_int_equal(both.fault, Fault::kBusOff);
  assert_true(both.faults.has(Fault::kBusOff) && both.faults.has(Fault::kValveNotFollowing));
}

/// With a fault that stops, the blade's watch begins afresh.
TEST(a_stopped_blade_is_not_judged, Machine machine) {
  machine.run(20);
  assert_true(machine.state.drives.motion[0].since_s > 0.0);
  machine.inputs.fault = Fault::kStrokeMissing;
  machine.inputs.faults.add(Fault::kStrokeMissing);
  machine.inputs.drive[0].stroke_m = 0.0;
  assert_false(machine.run(20).faults.has(Fault::kUncommandedMotion));
  assert_near(machine.state.drives.motion[0].since_s, 0.0, 0.0);
}

/// Outside motion people move it: blade and transmission are theirs. The valve's echo is not.
TEST(not_in_motion_the_machine_is_the_operators, Machine machine) {
  const DozerLastCommands nothing;
  machine.cycle = nothing;
  machine.inputs.valve_enabled = false;
  machine.inputs.automatic = false;
  for (int n = 0; n < 100; ++n) {
    machine.inputs.drive[0].spool_ratio = 1.0;
    machine.inputs.drive[0].stroke_m = 0.005 * n;
    machine.inputs.pump_ratio = {0.01 * n, -0.01 * n};
    machine.inputs.motor_ratio = {0.5, 0.25};
    assert_well(machine.step());
  }
  machine.inputs.valve_enabled = true;
  assert_int_equal(machine.cycles_until(Fault::kValveNotFollowing), kEchoCycles);
}

/// Nobody asks for it; its displacements say that they are at 0.
struct RunsOn : Machine {
  RunsOn() {
    run(5);
    const DozerLastCommands nothing;
    cycle = nothing;
    inputs.pump_ratio = {0.0, 0.0};
    inputs.valve_enabled = false;
    run_at(0.0);
    run(30);
  }
};

TEST(a_track_that_runs_on_runs_away, RunsOn machine) {
  assert_well(machine.step());
  machine.run_at(0.5);
  assert_in_range(machine.cycles_until(Fault::kDisplacementRunaway), 5, 7);
  assert_int_equal(machine.seen.fault, Fault::kDisplacementRunaway);
  // It is at rest once it has stood for 1 s.
  machine.run_at(0.0);
  machine.run(30);
  assert_well(machine.seen);
}

TEST(what_its_last_speed_explains_does_not_run_away, Machine machine) {
  machine.cycle.speed_mps = 1.0;
  machine.run(5);
  const DozerLastCommands nothing;
  machine.cycle = nothing;
  machine.inputs.pump_ratio = {0.0, 0.0};
  machine.inputs.valve_enabled = false;
  machine.run_at(0.5);
  machine.run(5);
  machine.run_at(0.0);
  machine.run(60);
  assert_well(machine.seen);
}

/// By its body it is seen, by either where one is not known.
TEST(a_track_that_is_not_seen_is_judged_by_the_body, RunsOn machine) {
  machine.inputs.faults.add(Fault::kTransmissionMissing);
  machine.inputs.velocity_mps = 0.5;
  RunsOn blind = machine;
  assert_true(machine.cycles_until(Fault::kDisplacementRunaway) > 0);
  blind.inputs.faults.add(Fault::kPoseMissing);
  blind.run_at(0.5);
  assert_int_equal(blind.cycles_until(Fault::kDisplacementRunaway), -1);
}

/// Both sensors' zeros off the same way.
TEST(a_zero_that_is_off_is_no_motion, RunsOn machine) {
  machine.run_at(0.0625 * 0.25);
  machine.run(1000);
  assert_well(machine.seen);
}

TEST(a_track_whose_body_stands_runs_nowhere, RunsOn machine) {
  machine.inputs.track_speed_mps = {0.5, 0.5};
  assert_int_equal(machine.cycles_until(Fault::kDisplacementRunaway), -1);
  machine.inputs.faults.add(Fault::kPoseMissing);
  assert_true(machine.cycles_until(Fault::kDisplacementRunaway) > 0);
}

TEST(by_hand_it_is_only_said, RunsOn machine) {
  machine.inputs.automatic = false;
  machine.run_at(0.5);
  assert_int_equal(machine.cycles_until(Fault::kDisplacementRunaway), -1);
  assert_true(machine.seen.warned.has(Fault::kDisplacementRunaway));
  assert_int_equal(machine.seen.fault, Fault::kNone);
}

/// Its own speed, or that of its displacements where it is not to be believed.
TEST(a_track_is_believed_unless_it_disagrees, Machine machine) {
  machine.run_at(0.25);
  const HstProfile& hst = machine.profile.hst;
  DozerValid& valid = machine.inputs;
  const double by_displacements_mps =
      track_speed_mps(hst, valid.engine_radps, valid.pump_ratio[kLeft], valid.motor_ratio[kLeft]);
  assert_near(believed_track_mps(hst, valid, kLeft), 0.25, 0.0);
  valid.track_outvoted[kLeft] = true;
  assert_near(believed_track_mps(hst, valid, kLeft), by_displacements_mps, 1e-12);
  assert_near(believed_track_mps(hst, valid, kRight), 0.25, 0.0);
  valid.track_outvoted[kLeft] = false;
  valid.degraded.add(Fault::kTrackSpeedDisagrees);
  assert_near(believed_track_mps(hst, valid, kRight), by_displacements_mps, 1e-12);
}

TEST(a_spool_that_does_not_close_after_motion_is_stuck, Released machine) {
  assert_int_equal(machine.cycles_until(Fault::kSpoolStuck),
                   kSpoolUnderWay - 1 + kSpoolWrongCycles);
  machine.inputs.drive[0].spool_ratio = 0.0;
  machine.inputs.pump_ratio = {0.0, 0.0};
  machine.step();
  machine.inputs.drive[0].spool_ratio = kOpen;
  assert_int_equal(machine.cycles_until(Fault::kSpoolStuck), -1);  // A hand has opened it.
}

/// The pumps have the time to settle; one that stays drives the machine.
TEST(a_pump_that_does_not_return_after_motion_runs_away) {
  for (unsigned track = 0; track < kTrackCount; ++track) {
    Released machine;
    machine.inputs.pump_ratio[1 - track] = 0.0;
    assert_int_equal(machine.cycles_until(Fault::kDisplacementRunaway),
                     kUnderWay - 1 + kRunawayCycles);
    machine.inputs.pump_ratio[track] = -0.125;
    machine.step();
    assert_false(machine.seen.faults.has(Fault::kDisplacementRunaway));
    machine.inputs.pump_ratio[track] = 0.5;
    assert_int_equal(machine.cycles_until(Fault::kDisplacementRunaway), -1);
  }
}

/// Taken over in manual mode, it is somebody's hand; an operator who is not heard has not.
TEST(manual_mode_takes_over, Released taken) {
  taken.inputs.automatic = false;
  assert_int_equal(taken.cycles_until(Fault::kDisplacementRunaway), -1);
  assert_false(taken.seen.faults.has(Fault::kSpoolStuck));
  Released unheard;
  unheard.inputs.automatic = false;
  unheard.inputs.faults.add(Fault::kOperatorMissing);
  assert_true(unheard.cycles_until(Fault::kDisplacementRunaway) > 0);
  assert_true(unheard.seen.faults.has(Fault::kSpoolStuck));
}

/// A transmission that is not seen is not judged, and has not returned either.
TEST(what_is_not_seen_has_not_returned, Released machine) {
  machine.inputs.faults.add(Fault::kTransmissionMissing);
  machine.inputs.pump_ratio = {0.0, 0.0};
  assert_int_equal(machine.cycles_until(Fault::kDisplacementRunaway), -1);
  machine.inputs.faults = {};
  machine.inputs.pump_ratio = {0.5, 0.5};
  assert_int_equal(machine.cycles_until(Fault::kDisplacementRunaway), kRunawayCycles);
}

/// After motion the tracks coast as they like.
TEST(tracks_are_judged_in_motion_only, Released machine) {
  machine.inputs.track_speed_mps = {3.0, 3.0};
  machine.run(20);
  assert_false(machine.seen.faults.has(Fault::kTrackSpeedDisagrees));
}

TEST(what_degraded_goes_on_for_a_second, Machine machine) {
  machine.inputs.degraded.add(Fault::kEngineSpeedMissing);
  assert_slowed_by(Fault::kEngineSpeedMissing, machine.step());
  machine.inputs.degraded = {};
  assert_slowed_by(Fault::kEngineSpeedMissing, machine.run(15));
  assert_well(machine.step());
}

TEST(centred_is_within_the_tolerance) {
  const DozerBank bank = dozer_bank(test::plain_dozer());
  DozerValid valid;
  for (const double sign : {1.0, -1.0}) {
    valid.drive[0].spool_ratio = sign * 0.125;
    assert_true(spools_centred(bank.rows(), valid.drive));
    valid.drive[0].spool_ratio = std::nextafter(sign * 0.125, sign * 9.0);
    assert_false(spools_centred(bank.rows(), valid.drive));
  }
}
