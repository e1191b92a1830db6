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
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
