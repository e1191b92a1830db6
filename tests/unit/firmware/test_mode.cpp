// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/mode.hpp"

#include <initializer_list>
#include "tests/unit/cmocka_cpp.hpp"

ModeRequest asks(bool enable, Task task = Task::kDig, bool automatic = true) {
  ModeRequest request;
  request.enable = enable;
  request.automatic = automatic;
  request.has_task = task != Task::kNone;
  return request;
}

ModeRequest broken(Fault fault) {
  ModeRequest request;
  request.fault = fault;
  return request;
}

EcuMode after(EcuMode mode, const ModeRequest& request) {
  return next_mode({mode, Fault::kNone}, request).mode;
}

TEST(motion_needs_every_step, ModeState state) {
  assert_int_equal(state.mode, EcuMode::kSilent);
  state = next_mode(state, asks(false));
  assert_int_equal(state.mode, EcuMode::kReady);
  state = next_mode(state, asks(false, Task::kNone));
  state = next_mode(state, asks(true, Task::kNone));
  assert_int_equal(state.mode, EcuMode::kArmed);
  state = next_mode(state, asks(true));
  assert_int_equal(state.mode, EcuMode::kActive);
}

/// The mode after these cycles, one after the other, from Ready.
EcuMode after_all(std::initializer_list<ModeRequest> cycles) {
  ModeState state{EcuMode::kReady, Fault::kNone};
  for (const ModeRequest& valid : cycles) {
    state = next_mode(state, valid);
  }
  return state.mode;
}

TEST(a_held_deadman_or_a_waiting_task_does_not_arm) {
  const ModeRequest released = asks(false, Task::kNone);
  const ModeRequest held_in_manual = asks(true, Task::kNone, false);
  const ModeRequest enabled = asks(true, Task::kNone);
  const ModeRequest with_task = asks(true, Task::kDig);
  assert_int_equal(after_all({released, enabled}), EcuMode::kArmed);
  assert_int_equal(after_all({held_in_manual, enabled}), EcuMode::kReady);
  assert_int_equal(after_all({held_in_manual, with_task, with_task}), EcuMode::kReady);
  assert_int_equal(after_all({asks(false, Task::kNone, false), enabled}), EcuMode::kReady);
  assert_int_equal(after_all({released, with_task}), EcuMode::kReady);
  assert_int_equal(after_all({released, with_task, enabled}), EcuMode::kReady);
  assert_int_equal(after_all({released, with_task, released, enabled}), EcuMode::kArmed);
}

TEST(enable_given_from_the_start_does_not_arm) {
  assert_int_equal(after(EcuMode::kSilent, asks(true)), EcuMode::kSilent);
}

TEST(released_enable_or_manual_ends_motion_at_once) {
  assert_int_equal(after(EcuMode::kActive, asks(false)), EcuMode::kReady);
  assert_int_equal(after(EcuMode::kArmed, asks(false)), EcuMode::kReady);
  assert_int_equal(after(EcuMode::kActive, asks(true, Task::kDig, false)), EcuMode::kReady);
  assert_int_equal(after(EcuMode::kActive, asks(true, Task::kNone)), EcuMode::kArmed);
  assert_int_equal(after(EcuMode::kReady, asks(true, Task::kDig, false)), EcuMode::kReady);
}

TEST(a_fault_latches_until_enable_is_released) {
  ModeState state = next_mode({EcuMode::kActive, Fault::kNone}, broken(Fault::kStrokeMissing));
  assert_int_equal(state.mode, EcuMode::kFault);
  assert_int_equal(state.fault, Fault::kStrokeMissing);
  state = next_mode(state, broken(Fault::kPressureMissing));
  assert_int_equal(state.fault, Fault::kStrokeMissing);
  state = next_mode(state, asks(true));
  assert_int_equal(state.mode, EcuMode::kFault);
  state = next_mode(state, asks(false));
  assert_int_equal(state.mode, EcuMode::kReady);
  assert_int_equal(state.fault, Fault::kNone);
}

TEST(faults_of_the_cycle_count_too) {
  const ModeState state = next_mode({EcuMode::kActive, Fault::kNone}, broken(Fault::kSolverFailed));
  assert_int_equal(state.mode, EcuMode::kFault);
  assert_int_equal(state.fault, Fault::kSolverFailed);
}

TEST(without_enable_a_fault_only_silences) {
  const ModeState state =
      next_mode({EcuMode::kReady, Fault::kNone}, broken(Fault::kPressureMissing));
  assert_int_equal(state.mode, EcuMode::kSilent);
  assert_int_equal(state.fault, Fault::kPressureMissing);
}

/// From every mode, whatever else is there, and nothing leads out of it.
TEST(told_to_end_is_the_end) {
  for (const EcuMode mode : {EcuMode::kSilent, EcuMode::kReady, EcuMode::kArmed, EcuMode::kActive,
                             EcuMode::kStopping, EcuMode::kFault}) {
    ModeRequest end = asks(true);
    end.stop = true;
    assert_int_equal(after(mode, end), EcuMode::kStopping);
    end.fault = Fault::kBusOff;
    const ModeState broken_end = next_mode({mode, Fault::kStrokeMissing}, end);
    assert_int_equal(broken_end.mode, EcuMode::kStopping);
    assert_int_equal(broken_end.fault, Fault::kBusOff);
    assert_false(broken_end.may_arm);
  }
  ModeState state{EcuMode::kStopping, Fault::kNone, true};
  for (const ModeRequest& request : {asks(false, Task::kNone), asks(true, Task::kNone), asks(true),
                                     broken(Fault::kStrokeMissing)}) {
    state = next_mode(state, request);
    assert_int_equal(state.mode, EcuMode::kStopping);
    assert_int_equal(state.fault, request.fault);
  }
}

/// Somebody has a hand on the levers; in motion the spools are anywhere, of course.
TEST(spools_off_their_middle_do_not_arm) {
  ModeRequest by_hand = asks(true, Task::kNone);
  by_hand.centred = false;
  ModeState ready = next_mode({EcuMode::kReady, Fault::kNone}, asks(false, Task::kNone));
  assert_int_equal(next_mode(ready, by_hand).mode, EcuMode::kReady);
  assert_int_equal(next_mode(ready, asks(true, Task::kNone)).mode, EcuMode::kArmed);
  ModeRequest moving = asks(true);
  moving.centred = false;
  assert_int_equal(after(EcuMode::kArmed, moving), EcuMode::kActive);
  assert_int_equal(after(EcuMode::kActive, moving), EcuMode::kActive);
}

TEST(only_armed_and_active_are_motion) {
  for (const EcuMode mode : {EcuMode::kSilent, EcuMode::kReady, EcuMode::kArmed, EcuMode::kActive,
                             EcuMode::kStopping, EcuMode::kFault}) {
    assert_int_equal(in_motion(mode), mode == EcuMode::kArmed || mode == EcuMode::kActive);
  }
}

unsigned bits(std::initializer_list<ArmBlock> blocks) {
  unsigned all = 0;
  for (const ArmBlock block : blocks) {
    all |= 1U << static_cast<unsigned>(block);
  }
  return all;
}

unsigned why(EcuMode mode, const ModeRequest& request, const FaultSet& faults = {}) {
  return why_not_armed({mode, Fault::kNone}, request, faults);
}

/// What is asked of the operator, each by itself.
TEST(each_condition_has_its_bit) {
  const ModeRequest ready = asks(false, Task::kNone);
  const unsigned enable = bits({ArmBlock::kEnableNotFresh});
  assert_int_equal(why(EcuMode::kReady, ready), enable);
  assert_int_equal(why(EcuMode::kSilent, ready), enable);
  assert_int_equal(why(EcuMode::kReady, asks(false, Task::kNone, false)),
                   enable | bits({ArmBlock::kManual}));
  // Nobody says which mode it is.
  FaultSet unheard;
  unheard.add(Fault::kOperatorMissing);
  assert_int_equal(why(EcuMode::kReady, asks(false, Task::kNone, false), unheard),
                   enable | bits({ArmBlock::kOperator}));
  assert_int_equal(why(EcuMode::kReady, asks(false, Task::kDig)),
                   enable | bits({ArmBlock::kTaskNotAtRest}));
  ModeRequest by_hand = ready;
  by_hand.centred = false;
  assert_int_equal(why(EcuMode::kReady, by_hand), enable | bits({ArmBlock::kNotCentred}));
  assert_int_equal(why(EcuMode::kFault, ready), enable | bits({ArmBlock::kFaultLatched}));
  assert_int_equal(why(EcuMode::kStopping, ready), enable | bits({ArmBlock::kStopping}));
}

/// Each fault, by itself, shows what it takes away; all of them, all of it.
TEST(each_fault_has_its_bit) {
  struct Row {
    Fault fault;
    ArmBlock block;
  };
  const Row rows[] = {{Fault::kStrokeMissing, ArmBlock::kStroke},
                      {Fault::kPressureMissing, ArmBlock::kPressure},
                      {Fault::kSwashMissing, ArmBlock::kSwash},
                      {Fault::kEngineSpeedMissing, ArmBlock::kEngineSpeed},
                      {Fault::kOperatorMissing, ArmBlock::kOperator},
                      {Fault::kSpoolMissing, ArmBlock::kSpool},
                      {Fault::kIdentityMismatch, ArmBlock::kIdentity},
                      {Fault::kBusPassive, ArmBlock::kBus},
                      {Fault::kMessageMasquerade, ArmBlock::kMessages},
                      {Fault::kPoseUnreachable, ArmBlock::kUnreachable},
                      {Fault::kCycleStalled, ArmBlock::kCycle}};
  const ModeRequest ready = asks(false, Task::kNone);
  FaultSet all;
  unsigned all_bits = bits({ArmBlock::kEnableNotFresh});
  for (const Row& row : rows) {
    FaultSet one;
    one.add(row.fault);
    assert_int_equal(why(EcuMode::kSilent, ready, one),
                     bits({ArmBlock::kEnableNotFresh, row.block}));
    all.add(one);
    all_bits |= bits({row.block});
  }
  assert_int_equal(why(EcuMode::kSilent, ready, all), all_bits);
}

TEST(in_motion_nothing_is_in_the_way, FaultSet slowing) {
  slowing.add(Fault::kPressureMissing);
  ModeRequest moving = asks(true);
  moving.centred = false;
  assert_int_equal(why(EcuMode::kArmed, moving, slowing), 0);
  assert_int_equal(why(EcuMode::kActive, moving, slowing), 0);
}
