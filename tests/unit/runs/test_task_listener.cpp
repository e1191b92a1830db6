// SPDX-License-Identifier: Apache-2.0
/// What a task's listener makes of the frames that pass by.

#include "app/runs/task_listener.hpp"

#include <array>

#include "platform/loopback/loopback_bus.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using dbc::RawState;
using dbc::excavator::TaskStatus;
using runs::TaskListener;
using Kind = TaskStatus::StepKind;

/// What a number that is not available has as its value.
constexpr std::uint8_t kNumber = 0;

/// A controller, and the machine's port with its listener.
struct Rig {
  Rig() {
    assert_true(controller.open());
    assert_true(listener.open());
  }

  void say(const CanFrame& frame) { assert_true(controller.send(frame)); }
  void say(std::uint32_t number, std::uint32_t step, Kind kind) {
    TaskStatus status;
    status.task_number = {number, RawState::kValid};
    status.step = {step, RawState::kValid};
    status.step_kind = {kind, RawState::kValid};
    say(frame_of(status));
  }
  static CanFrame frame_of(const TaskStatus& status) {
    CanFrame frame;
    frame.id = TaskStatus::kId;
    frame.length = TaskStatus::kLength;
    frame.data = status.encode();
    return frame;
  }
  /// What the machine takes from its port at this time.
  int take(TimeUs now_us) {
    bus.set_time(now_us);
    listener.begin_cycle(now_us);
    return listener.receive(taken.data(), static_cast<int>(taken.size()));
  }

  LoopbackBus bus;
  LoopbackPort& controller = bus.attach();
  LoopbackPort& machine = bus.attach();
  TaskListener listener{machine, kNumber};
  std::array<CanFrame, 8> taken;
};

TEST(silent_it_is_at_nothing) {
  Rig rig;
  assert_int_equal(rig.take(0), 0);
  assert_false(rig.listener.step().has_value());
  assert_false(rig.listener.is_done());
}

TEST(a_step_is_heard_and_passes_through) {
  Rig rig;
  rig.say(kNumber, 3, Kind::kLift);
  assert_int_equal(rig.take(0), 1);
  assert_int_equal(rig.taken[0].id, TaskStatus::kId);
  assert_int_equal(rig.listener.step().value_or(-1), 3);
  assert_false(rig.listener.is_done());
  CanFrame other;
  other.id = 0x0CFF3082;
  other.length = 8;
  rig.say(other);
  assert_int_equal(rig.take(kMillisecondUs), 1);
  assert_int_equal(rig.taken[0].id, other.id);
  assert_int_equal(rig.listener.step().value_or(-1), 3);
  assert_true(rig.listener.send(other));
  assert_int_equal(rig.controller.receive(rig.taken.data(), 1), 1);
  assert_true(rig.listener.state() == CanPortState::kActive);
}

TEST(the_way_to_a_step_is_none) {
  Rig rig;
  for (const Kind kind : {Kind::kNone, Kind::kApproach, Kind::kDone}) {
    rig.say(kNumber, 0, kind);
    static_cast<void>(rig.take(0));
    assert_false(rig.listener.step().has_value());
    assert_true(rig.listener.is_done() == (kind == Kind::kDone));
  }
}

TEST(another_task_is_not_ours) {
  Rig rig;
  rig.say(kNumber + 1, 0, Kind::kDig);
  static_cast<void>(rig.take(0));
  assert_false(rig.listener.step().has_value());
  rig.say(kNumber + 1, 0, Kind::kDone);
  static_cast<void>(rig.take(0));
  assert_false(rig.listener.is_done());
}

TEST(what_is_not_said_is_not_heard) {
  Rig rig;
  TaskStatus status;
  status.step_kind = {Kind::kDig, RawState::kValid};
  rig.say(Rig::frame_of(status));  // no number: none runs
  static_cast<void>(rig.take(0));
  assert_false(rig.listener.step().has_value());
  status.task_number = {kNumber, RawState::kValid};
  status.step.state = RawState::kError;
  rig.say(Rig::frame_of(status));
  static_cast<void>(rig.take(0));
  assert_false(rig.listener.step().has_value());
  status.step = {1, RawState::kValid};
  status.step_kind.state = RawState::kNotAvailable;
  rig.say(Rig::frame_of(status));
  static_cast<void>(rig.take(0));
  assert_false(rig.listener.step().has_value());
}

TEST(a_frame_of_another_form_is_none) {
  Rig rig;
  TaskStatus status;
  status.task_number = {kNumber, RawState::kValid};
  status.step_kind = {Kind::kDig, RawState::kValid};
  CanFrame frame = Rig::frame_of(status);
  frame.length = 7;
  rig.say(frame);
  static_cast<void>(rig.take(0));
  assert_false(rig.listener.step().has_value());
  frame = Rig::frame_of(status);
  frame.id += 0x100;
  rig.say(frame);
  static_cast<void>(rig.take(0));
  assert_false(rig.listener.step().has_value());
}

TEST(what_was_said_fades) {
  Rig rig;
  rig.say(kNumber, 1, Kind::kDump);
  static_cast<void>(rig.take(kSecondUs));
  static_cast<void>(rig.take(kSecondUs + TaskListener::kHeldFor_us - 1));
  assert_true(rig.listener.step().has_value());
  static_cast<void>(rig.take(kSecondUs + TaskListener::kHeldFor_us));
  assert_false(rig.listener.step().has_value());
}
