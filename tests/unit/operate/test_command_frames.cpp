// SPDX-License-Identifier: Apache-2.0
/// The station's frames, by what a receiver makes of them.

#include "app/operate/command_frames.hpp"

#include <vector>
#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/link/e2e.hpp"
#include "hal/link/message_rules.hpp"

#include "tests/unit/cmocka_cpp.hpp"

using dbc::RawState;
using operate::CommandFrames;
using operate::CommandPair;
using operate::Request;
using Command = dbc::excavator::OperatorCommand;
using AxesMessage = dbc::excavator::OperatorAxes;

constexpr dbc::Count kEcho = {77, RawState::kValid};

Request full_request() {
  Request request;
  request.enable = true;
  request.mode = OperatorMode::kAutomatic;
  request.task = Task::kCoordinated;
  request.speed_override_ratio = 0.3;
  request.axes = {1.0, -1.0, 0.248, -0.504};
  return request;
}

TEST(what_is_asked_is_said) {
  CommandFrames frames;
  const CommandPair pair = frames.next(full_request(), kEcho, 0);
  assert_int_equal(pair[0].id, 0x0CFF2781);
  assert_int_equal(pair[1].id, 0x0CFF2C81);
  const Command command = Command::decode(pair[0].data);
  assert_true(command.enable.value == Command::Enable::kOn);
  assert_true(command.operator_mode.value == Command::OperatorMode::kAutomatic);
  assert_true(command.task.value == Command::Task::kCoordinated);
  assert_near(command.speed_override_ratio.value, 0.3, 1e-12);
  assert_int_equal(command.echo.value, 77);
  const AxesMessage axes = AxesMessage::decode(pair[1].data);
  assert_near(axes.boom_or_up_ratio.value, 1.0, 0.0);
  assert_near(axes.arm_or_forward_ratio.value, -1.0, 0.0);
  assert_near(axes.bucket_or_attitude_ratio.value, 0.248, 1e-12);
  assert_near(axes.swing_ratio.value, -0.504, 1e-12);
  assert_true(axes.swing_ratio.state == RawState::kValid);
}

/// Held still, by an end or a key, they change by a step of the message, and never past the middle.
TEST(levers_show_that_they_are_read) {
  CommandFrames frames;
  Request request = full_request();
  request.axes = {1.0, -1.0, 0.008, 0.0};
  for (int n = 0; n < 6; ++n) {
    const bool less = n % 2 == 1;
    const AxesMessage axes = AxesMessage::decode(frames.next(request, kEcho, 0)[1].data);
    assert_near(axes.boom_or_up_ratio.value, less ? 0.992 : 1.0, 1e-12);
    assert_near(axes.arm_or_forward_ratio.value, less ? -0.992 : -1.0, 1e-12);
    assert_near(axes.bucket_or_attitude_ratio.value, less ? 0.0 : 0.008, 1e-12);
    assert_near(axes.swing_ratio.value, 0.0, 0.0);
  }
}

TEST(the_default_asks_for_nothing) {
  CommandFrames frames;
  const CommandPair pair = frames.next({}, kEcho, 0);
  const Command command = Command::decode(pair[0].data);
  assert_true(command.enable.state == RawState::kValid);
  assert_true(command.enable.value == Command::Enable::kOff);
  assert_true(command.task.value == Command::Task::kNone);
  const AxesMessage axes = AxesMessage::decode(pair[1].data);
  assert_near(axes.boom_or_up_ratio.value, 0.0, 0.0);
  assert_true(axes.boom_or_up_ratio.state == RawState::kValid);
}

/// One message's way into a receiver.
struct Receiver {
  MessageRule rule;
  E2eState state;
  int accepted = 0;

  void take(const CanFrame& frame, TimeUs now) {
    accepted += e2e_accepted(e2e_check(rule.e2e, state, frame.data, now)) ? 1 : 0;
  }
};

TEST(a_receiver_accepts_them) {
  CommandFrames frames;
  Receiver command = {message_rule<Command>(nullptr), {}};
  Receiver axes = {message_rule<AxesMessage>(nullptr), {}};
  constexpr int kFrames = 40;
  for (int i = 0; i < kFrames; ++i) {
    const TimeUs now = i * CommandFrames::kPeriod_us;
    const CommandPair pair = frames.next(full_request(), kEcho, now);
    command.take(pair[0], now);
    axes.take(pair[1], now);
  }
  // Three synchronise, and the last of them is accepted.
  assert_int_equal(command.accepted, kFrames - 2);
  assert_int_equal(axes.accepted, kFrames - 2);
}

TEST(last_words_fit_and_change_nothing) {
  CommandFrames frames;
  Receiver command = {message_rule<Command>(nullptr), {}};
  TimeUs now = 0;
  for (int i = 0; i < 5; ++i, now += CommandFrames::kPeriod_us) {
    command.take(frames.next(full_request(), kEcho, now)[0], now);
  }
  const CommandPair last = frames.last_words(now);
  assert_true(Command::decode(last[0].data).enable.value == Command::Enable::kOff);
  const CommandPair next = frames.next({}, {0, RawState::kNotAvailable}, now);
  assert_memory_equal(last[0].data.data(), next[0].data.data(), 8);
  assert_memory_equal(last[1].data.data(), next[1].data.data(), 8);
  command.take(last[0], now);
  assert_int_equal(command.accepted, 4);
}

TEST(a_touch_is_said_every_100_ms_for_a_second) {
  using Touched = dbc::excavator::TouchedPoint;
  operate::TouchFrames frames;
  std::vector<TimeUs> said_us;
  std::vector<std::uint32_t> numbers;
  const auto run = [&](TimeUs from_us, TimeUs to_us) {
    for (TimeUs now = from_us; now < to_us; now += operate::CommandFrames::kPeriod_us) {
      if (const auto frame = frames.next(now)) {
        assert_int_equal(frame->id, Touched::kId);
        const Touched message = Touched::decode(frame->data);
        assert_int_equal(message.kind.value,
                         now < 4 * kSecondUs ? Touched::Kind::kMark : Touched::Kind::kMoved);
        numbers.push_back(message.number.value);
        said_us.push_back(now);
      }
    }
  };
  run(0, kSecondUs);
  assert_true(said_us.empty());
  frames.begin(TouchKind::kMark, kSecondUs);
  run(kSecondUs, 3 * kSecondUs);
  assert_int_equal(said_us.size(), 10);
  assert_int_equal(said_us.front(), kSecondUs);
  assert_int_equal(said_us.back(), 1900 * kMillisecondUs);
  for (int i = 0; i < 251; ++i) {
    frames.begin(TouchKind::kMoved, 4 * kSecondUs);
    run(4 * kSecondUs, 4 * kSecondUs + 1);
    assert_true(numbers.back() <= 250 && numbers.back() != numbers[numbers.size() - 2]);
  }
}
