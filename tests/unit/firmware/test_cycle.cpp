// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "firmware/safety/cycle.hpp"

#include "firmware/safety/fault_table.hpp"
#include "firmware/safety/tuning.hpp"
#include "tests/unit/cmocka_cpp.hpp"

constexpr EcuMode kModes[] = {EcuMode::kSilent, EcuMode::kReady,    EcuMode::kArmed,
                              EcuMode::kActive, EcuMode::kStopping, EcuMode::kFault};

FaultSet only(Fault fault) {
  FaultSet faults;
  faults.add(fault);
  return faults;
}

TEST(the_first_fault_is_named) {
  assert_int_equal(first_of({}), Fault::kNone);
  assert_int_equal(first_of({Fault::kNone, Fault::kNone}), Fault::kNone);
  assert_int_equal(first_of({Fault::kNone, Fault::kBusOff, Fault::kStrokeMissing}), Fault::kBusOff);
}

/// The next mode as the parts of a cycle make it.
ModeDecision decided(const CommonValid& valid, Fault fault, bool centred, bool stop_requested,
                     const Cycle& cycle = {}) {
  return decide_mode({}, cycle, valid, fault, centred, stop_requested);
}

TEST(each_part_of_the_request_has_its_source) {
  const ModeRequest nothing = decided({}, Fault::kNone, false, false).request;
  assert_int_equal(nothing.fault, Fault::kNone);
  assert_false(nothing.enable || nothing.automatic || nothing.has_task || nothing.centred ||
               nothing.stop);
  CommonValid valid;
  valid.enable = true;
  assert_true(decided(valid, Fault::kNone, false, false).request.enable);
  valid = {};
  valid.automatic = true;
  assert_true(decided(valid, Fault::kNone, false, false).request.automatic);
  for (const Task task : {Task::kDig, Task::kGrade}) {
    valid = {};
    valid.task = task;
    assert_true(decided(valid, Fault::kNone, false, false).request.has_task);
  }
  assert_true(decided({}, Fault::kNone, true, false).request.centred);
  assert_false(decided({}, Fault::kNone, true, false).request.stop);
  assert_true(decided({}, Fault::kNone, false, true).request.stop);
  // The cycle's own fault before the inputs', before what stands in the way beside them.
  Cycle late;
  late.fault = Fault::kCycleStalled;
  valid.fault = Fault::kStrokeMissing;
  assert_int_equal(decided(valid, Fault::kBusOff, false, false, late).request.fault,
                   Fault::kCycleStalled);
  assert_int_equal(decided(valid, Fault::kBusOff, false, false).request.fault,
                   Fault::kStrokeMissing);
  assert_int_equal(decided({}, Fault::kBusOff, false, false).request.fault, Fault::kBusOff);
}

TEST(a_refusal_of_the_gate_stops) {
  ModeDecision active{{}, {EcuMode::kActive, Fault::kNone}};
  take_refusal(Fault::kNone, active);
  assert_true(active.active());
  take_refusal(Fault::kCommandNotFinite, active);
  assert_false(active.active());
  assert_int_equal(active.mode.mode, EcuMode::kFault);
  assert_int_equal(active.mode.fault, Fault::kCommandNotFinite);
}

/// Any fault by which the spools do not obey, latched or there now, in any mode.
TEST(a_spool_that_does_not_obey_cuts_the_pilot) {
  for (const EcuMode mode : kModes) {
    for (int code = 0; code < kFaultCount; ++code) {
      const auto fault = static_cast<Fault>(code);
      const bool unknown = mode == EcuMode::kFault && fault == Fault::kSpoolMissing;
      assert_int_equal(pilot({}, {mode, Fault::kNone}, only(fault), false, 0.01).cut,
                       cuts_pilot(fault) || unknown);
      assert_int_equal(pilot({}, {mode, fault}, {}, false, 0.01).cut, cuts_pilot(fault));
    }
  }
}

/// It lasts after the fault has gone where the machine was stopped by it, or by something else at
/// the same time; a stuck spool's wherever it was seen.
TEST(the_cut_is_kept_after_its_cause) {
  const auto kept = [](EcuMode mode, Fault latched, const FaultSet& faults) {
    return pilot({}, {mode, latched}, faults, false, 0.01).state.kept_cut;
  };
  assert_true(kept(EcuMode::kFault, Fault::kUncommandedMotion, {}));
  assert_true(kept(EcuMode::kFault, Fault::kBusOff, only(Fault::kValveNotFollowing)));
  assert_false(kept(EcuMode::kFault, Fault::kBusOff, only(Fault::kStrokeMissing)));
  assert_true(kept(EcuMode::kReady, Fault::kNone, only(Fault::kSpoolStuck)));
  assert_true(kept(EcuMode::kSilent, Fault::kBusOff, only(Fault::kSpoolStuck)));
  // The echo of a valve that is only just being enabled by hand is no disobedience.
  assert_false(kept(EcuMode::kSilent, Fault::kValveNotFollowing, only(Fault::kValveNotFollowing)));
}

/// Nothing but arming again gives the pressure back.
TEST(only_arming_ends_the_cut) {
  for (const EcuMode mode : kModes) {
    const PilotResult result = pilot({true, true}, {mode, Fault::kNone}, {}, false, 0.01);
    assert_int_equal(result.cut, !in_motion(mode));
    assert_int_equal(result.state.kept_cut, !in_motion(mode));
  }
  assert_false(pilot({}, {EcuMode::kReady, Fault::kNone}, {}, false, 0.01).state.kept_cut);
}

PilotState after(double seconds, Fault latched, const FaultSet& faults, PilotState state = {}) {
  for (int n = 0; n < std::lround(seconds / 0.01); ++n) {
    state = pilot(state, {EcuMode::kFault, latched}, faults, false, 0.01).state;
  }
  return state;
}

/// A machine that a fault has stopped loses its pilot pressure once its drives stand, whatever the
/// fault; at once where its spools are not known, or a drive moves.
TEST(a_stopped_machine_loses_its_pilot) {
  assert_false(after(0.9, Fault::kBusOff, {}).at_rest);
  assert_true(after(1.1, Fault::kBusOff, {}).at_rest);
  const ModeState stopped = {EcuMode::kFault, Fault::kBusOff};
  assert_false(pilot({}, stopped, {}, false, kDrivesStop_s).state.at_rest);
  assert_true(after(0.01, Fault::kSpoolMissing, only(Fault::kSpoolMissing)).at_rest);
  for (const EcuMode mode : {EcuMode::kSilent, EcuMode::kReady, EcuMode::kFault}) {
    const FaultSet moves = only(Fault::kUncommandedMotion);
    assert_true(pilot({}, {mode, Fault::kNone}, moves, false, 0.01).state.at_rest);
  }
}

/// It is no keep-clear: manual mode with enable released ends it, and so does arming.
TEST(such_a_cut_strands_nobody) {
  const PilotState cut = after(2.0, Fault::kBusOff, {});
  for (const EcuMode mode : {EcuMode::kSilent, EcuMode::kReady, EcuMode::kFault}) {
    assert_true(pilot(cut, {mode, Fault::kNone}, {}, false, 0.01).cut);
  }
  assert_false(pilot(cut, {EcuMode::kReady, Fault::kNone}, {}, true, 0.01).cut);
  assert_false(pilot(cut, {EcuMode::kArmed, Fault::kNone}, {}, false, 0.01).cut);
  // That of a drive which moved at rest neither; that of one which did not obey is.
  const FaultSet moves = only(Fault::kUncommandedMotion);
  const PilotState at_rest = after(0.1, Fault::kBusOff, moves, after(0.5, Fault::kBusOff, {}));
  assert_false(pilot(at_rest, {EcuMode::kReady, Fault::kNone}, {}, true, 0.01).cut);
  const PilotState disobeyed = after(0.1, Fault::kBusOff, moves);
  assert_true(pilot(disobeyed, {EcuMode::kReady, Fault::kNone}, {}, true, 0.01).cut);
}

/// What an earlier process asked for is not known until this one has armed or asked itself.
TEST(the_pilot_is_known_from_arming_or_a_cut) {
  for (const EcuMode mode : kModes) {
    assert_int_equal(pilot({}, {mode, Fault::kNone}, {}, false, 0.01).state.known, in_motion(mode));
    assert_true(pilot({false, true}, {mode, Fault::kNone}, {}, false, 0.01).state.known);
    assert_true(pilot({}, {mode, Fault::kNone}, only(Fault::kSpoolStuck), false, 0.01).state.known);
  }
}

/// In manual mode, with enable released; not while the operator's frames are missing.
TEST(the_operator_has_it_by_hand) {
  const auto cut = [](bool automatic, bool enable, const FaultSet& faults) {
    CycleMemory memory;
    memory.pilot.at_rest = true;
    CommonValid valid;
    valid.automatic = automatic;
    valid.faults = faults;
    ModeRequest request;
    request.enable = enable;
    MachineOutputs outputs;
    MachineStatus status;
    end_cycle({request, {EcuMode::kReady, Fault::kNone}, 0.01}, valid, memory, outputs, status);
    return outputs.pilot_cut;
  };
  assert_false(cut(false, false, {}));
  assert_true(cut(false, true, {}));
  assert_true(cut(true, false, {}));
  assert_true(cut(false, false, only(Fault::kOperatorMissing)));
}

/// What the operator reads at the end of a cycle.
MachineStatus describe(const ModeState& mode, const ModeRequest& request,
                       const CommonValid& valid) {
  CycleMemory memory;
  MachineOutputs outputs;
  MachineStatus status;
  end_cycle({request, mode}, valid, memory, outputs, status);
  assert_int_equal(memory.mode.mode, mode.mode);
  assert_int_equal(outputs.pilot_known, memory.pilot.known);
  assert_int_equal(outputs.pilot_cut, memory.pilot.kept_cut || cuts_pilot(status.faults));
  return status;
}

/// Whatever it had become: stopped, and the pilot pressure is gone until the operator arms again.
TEST(memory_that_was_not_intact_stops, CycleMemory memory) {
  memory.mode = {EcuMode::kActive, Fault::kNone, true};
  assert_int_equal(begin_cycle(memory, true, 0).fault, Fault::kNone);
  assert_int_equal(memory.mode.mode, EcuMode::kActive);
  assert_false(memory.pilot.kept_cut || memory.pilot.known);
  const Cycle cycle = begin_cycle(memory, false, 10 * kMillisecondUs);
  assert_int_equal(cycle.fault, Fault::kMemoryCorrupt);
  assert_int_equal(cycle.last_mode, EcuMode::kFault);
  assert_true(memory.pilot.kept_cut && memory.pilot.known);
  const ModeDecision decision = decide_mode(memory, cycle, {}, Fault::kNone, true, false);
  assert_int_equal(decision.mode.mode, EcuMode::kFault);
  assert_int_equal(decision.mode.fault, Fault::kMemoryCorrupt);
}

TEST(what_stopped_it_is_named_before_what_slows, CommonValid valid) {
  valid.faults = only(Fault::kPressureMissing);
  valid.degraded = only(Fault::kPressureMissing);
  const MachineStatus slow = describe({EcuMode::kActive, Fault::kNone}, {}, valid);
  assert_int_equal(slow.mode, EcuMode::kActive);
  assert_int_equal(slow.fault, Fault::kPressureMissing);
  assert_int_equal(slow.why_not_armed, 0);
  const MachineStatus stopped = describe({EcuMode::kFault, Fault::kBusOff}, {}, valid);
  assert_int_equal(stopped.fault, Fault::kBusOff);
  assert_true(stopped.faults.has(Fault::kBusOff) && stopped.faults.has(Fault::kPressureMissing));
  assert_int_equal(describe({}, {}, {}).fault, Fault::kNone);
  assert_true(describe({}, {}, {}).faults.empty());
}

/// The request's fault is there now and blocks; the latched one was, and only says so.
TEST(what_blocks_is_what_is_there, ModeRequest request) {
  request.automatic = true;
  request.fault = Fault::kCycleStalled;
  const MachineStatus status = describe({EcuMode::kFault, Fault::kBusOff}, request, {});
  const auto blocks = [&status](ArmBlock block) {
    return (status.why_not_armed & (1U << static_cast<unsigned>(block))) != 0U;
  };
  assert_true(status.faults.has(Fault::kCycleStalled) && status.faults.has(Fault::kBusOff));
  assert_true(blocks(ArmBlock::kCycle) && blocks(ArmBlock::kFaultLatched));
  assert_false(blocks(ArmBlock::kBus));
}

TEST(a_command_stands_for_the_cycles_until_the_next) {
  for (const double one_s : {0.0, 0.0005, 0.01, 0.0149, 0.0551, 1.0, -1.0}) {
    assert_int_equal(cycles_in(one_s), 1);
  }
  assert_int_equal(cycles_in(0.0151), 2);
  assert_int_equal(cycles_in(0.03), 3);
  assert_int_equal(cycles_in(0.05), kMostCyclesLate);
}

/// A controller that is called after so much time.
struct Clock {
  TimeState state;
  TimeUs now_us = -3 * kSecondUs;  // Any instant.
  TimeWatchResult seen;

  Clock() { after(0); }
  Fault after(TimeUs elapsed_us) {
    now_us += elapsed_us;
    seen = watch_time(state, now_us);
    state = seen.state;
    return seen.fault;
  }
};

/// Whatever the clock says: there is nothing that it could be late after.
TEST(the_first_cycle_is_well) {
  for (const TimeUs now_us : {TimeUs{0}, 1000 * kSecondUs, -1000 * kSecondUs}) {
    const TimeWatchResult seen = watch_time({}, now_us);
    assert_int_equal(seen.fault, Fault::kNone);
    assert_near(seen.elapsed_s, 0.0, 0.0);
    assert_near(seen.period_s, 0.0, 0.0);
    assert_int_equal(seen.state.last_us, now_us);
  }
}

TEST(time_is_counted_from_the_last_cycle, Clock clock) {
  assert_int_equal(clock.after(10 * kMillisecondUs), Fault::kNone);
  assert_near(clock.seen.elapsed_s, 0.010, 1e-15);
  assert_near(clock.seen.period_s, 0.010, 1e-15);
  assert_int_equal(clock.after(7 * kMillisecondUs), Fault::kNone);
  assert_near(clock.seen.elapsed_s, 0.007, 1e-15);
}

/// What may change by so much a second gets no more than two cycles; a clock that ran back, none.
TEST(no_cycle_is_a_large_step, Clock clock) {
  static_cast<void>(clock.after(40 * kMillisecondUs));
  assert_near(clock.seen.elapsed_s, 0.040, 1e-15);
  assert_near(clock.seen.period_s, 0.020, 1e-15);
  static_cast<void>(clock.after(10 * kSecondUs));
  assert_near(clock.seen.elapsed_s, 0.050, 1e-15);
  assert_near(clock.seen.period_s, 0.020, 1e-15);
  assert_int_equal(clock.after(-kSecondUs), Fault::kNone);
  assert_near(clock.seen.elapsed_s, 0.0, 0.0);
  assert_near(clock.seen.period_s, 0.0, 0.0);
}

TEST(the_second_late_one_in_a_row_is_an_overrun) {
  constexpr TimeUs kLate = 15 * kMillisecondUs + 1;
  Clock clock;
  for (int round = 0; round < 3; ++round) {
    assert_int_equal(clock.after(kLate), Fault::kNone);
    assert_int_equal(clock.after(kLate - 1), Fault::kNone);
  }
  assert_int_equal(clock.after(kLate), Fault::kNone);
  repeat(5, [&] { assert_int_equal(clock.after(kLate), Fault::kCycleOverrun); });
  assert_int_equal(clock.after(10 * kMillisecondUs), Fault::kNone);
  assert_int_equal(clock.after(kLate), Fault::kNone);
}

/// Late ones with others between them, until they are more than a bucket of 60 ms holds.
int late_ones_until_overrun(TimeUs late_us, TimeUs between_us) {
  Clock clock;
  for (int late = 1; late <= 1000; ++late) {
    if (clock.after(late_us) == Fault::kCycleOverrun) {
      return late;
    }
    for (TimeUs passed_us = 0; passed_us < between_us; passed_us += 10 * kMillisecondUs) {
      assert_int_equal(clock.after(10 * kMillisecondUs), Fault::kNone);
    }
  }
  return 0;
}

TEST(late_ones_fill_a_bucket) {
  constexpr TimeUs kMs = kMillisecondUs;
  assert_int_equal(late_ones_until_overrun(40 * kMs, 40 * kMs), 3);
  // 40 - 0; 40 - 1 - 5 + 40 = 74.
  assert_int_equal(late_ones_until_overrun(50 * kMs, 10 * kMs), 2);
  // Each 10 ms late, 3 ms lost a round: 10, 17, .. 66 is the ninth.
  assert_int_equal(late_ones_until_overrun(20 * kMs, 10 * kMs), 9);
  // As much is lost as comes in: 10 ms late every 100 ms.
  assert_int_equal(late_ones_until_overrun(20 * kMs, 80 * kMs), 0);
  // 15 ms after the last one is not late.
  assert_int_equal(late_ones_until_overrun(15 * kMs, 10 * kMs), 0);
}

/// It holds 60 ms and no more, runs empty by a tenth of the time, and never below 0.
TEST(the_bucket_runs_empty, TimeState state) {
  state.has_stepped = true;
  state.late_us = 20 * kMillisecondUs;
  constexpr TimeUs kElapsed = 50 * kMillisecondUs;
  state.last_us = -kElapsed;
  // 20 - 5 + 40 is 55; 25 - 5 + 40 is 60, and one more is too much.
  assert_int_equal(watch_time(state, 0).fault, Fault::kNone);
  assert_int_equal(watch_time(state, 0).state.late_us, 55 * kMillisecondUs);
  state.late_us = 25 * kMillisecondUs;
  assert_int_equal(watch_time(state, 0).fault, Fault::kNone);
  state.late_us += 1;
  assert_int_equal(watch_time(state, 0).fault, Fault::kCycleOverrun);
  assert_int_equal(watch_time(state, 10 * kSecondUs).state.late_us, 40 * kMillisecondUs);
  state.late_us = 30 * kMillisecondUs;
  assert_int_equal(watch_time(state, -kElapsed + 10 * kMillisecondUs).state.late_us,
                   29 * kMillisecondUs);
  assert_int_equal(watch_time(state, -kElapsed - kSecondUs).state.late_us, 30 * kMillisecondUs);
}

TEST(a_long_gap_is_a_stall, Clock clock) {
  assert_int_equal(clock.after(50 * kMillisecondUs), Fault::kNone);
  static_cast<void>(clock.after(10 * kMillisecondUs));
  assert_int_equal(clock.after(50 * kMillisecondUs + 1), Fault::kCycleStalled);
  // It counts as late as well, and is the graver of the two.
  assert_int_equal(clock.after(20 * kMillisecondUs), Fault::kCycleOverrun);
  assert_int_equal(clock.after(60 * kMillisecondUs), Fault::kCycleStalled);
}
