// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/mode.hpp"

#include <initializer_list>
#include "tests/unit/cmocka_cpp.hpp"

namespace {

using namespace graben;

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

void motion_needs_every_step(void**) {
  ModeState state;
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

void a_held_deadman_or_a_waiting_task_does_not_arm(void**) {
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

void enable_given_from_the_start_does_not_arm(void**) {
  assert_int_equal(after(EcuMode::kSilent, asks(true)), EcuMode::kSilent);
}

void released_enable_or_manual_ends_motion_at_once(void**) {
  assert_int_equal(after(EcuMode::kActive, asks(false)), EcuMode::kReady);
  assert_int_equal(after(EcuMode::kArmed, asks(false)), EcuMode::kReady);
  assert_int_equal(after(EcuMode::kActive, asks(true, Task::kDig, false)), EcuMode::kReady);
  assert_int_equal(after(EcuMode::kActive, asks(true, Task::kNone)), EcuMode::kArmed);
  assert_int_equal(after(EcuMode::kReady, asks(true, Task::kDig, false)), EcuMode::kReady);
}

void a_fault_latches_until_enable_is_released(void**) {
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

void faults_of_the_cycle_count_too(void**) {
  const ModeState state = next_mode({EcuMode::kActive, Fault::kNone}, broken(Fault::kSolverFailed));
  assert_int_equal(state.mode, EcuMode::kFault);
  assert_int_equal(state.fault, Fault::kSolverFailed);
}

void without_enable_a_fault_only_silences(void**) {
  const ModeState state =
      next_mode({EcuMode::kReady, Fault::kNone}, broken(Fault::kPressureMissing));
  assert_int_equal(state.mode, EcuMode::kSilent);
  assert_int_equal(state.fault, Fault::kPressureMissing);
}

/// From every mode, whatever else is there, and nothing leads out of it.
void told_to_end_is_the_end(void**) {
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
void spools_off_their_middle_do_not_arm(void**) {
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

void only_armed_and_active_are_motion(void**) {
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
void each_condition_has_its_bit(void**) {
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
void each_fault_has_its_bit(void**) {
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

void in_motion_nothing_is_in_the_way(void**) {
  FaultSet slowing;
  slowing.add(Fault::kPressureMissing);
  ModeRequest moving = asks(true);
  moving.centred = false;
  assert_int_equal(why(EcuMode::kArmed, moving, slowing), 0);
  assert_int_equal(why(EcuMode::kActive, moving, slowing), 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(motion_needs_every_step),
      cmocka_unit_test(a_held_deadman_or_a_waiting_task_does_not_arm),
      cmocka_unit_test(enable_given_from_the_start_does_not_arm),
      cmocka_unit_test(released_enable_or_manual_ends_motion_at_once),
      cmocka_unit_test(a_fault_latches_until_enable_is_released),
      cmocka_unit_test(faults_of_the_cycle_count_too),
      cmocka_unit_test(without_enable_a_fault_only_silences),
      cmocka_unit_test(told_to_end_is_the_end),
      cmocka_unit_test(spools_off_their_middle_do_not_arm),
      cmocka_unit_test(only_armed_and_active_are_motion),
      cmocka_unit_test(each_condition_has_its_bit),
      cmocka_unit_test(each_fault_has_its_bit),
      cmocka_unit_test(in_motion_nothing_is_in_the_way),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
