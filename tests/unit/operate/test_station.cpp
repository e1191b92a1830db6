// SPDX-License-Identifier: Apache-2.0
/// What the hands ask for.

#include "app/operate/station.hpp"

#include "tests/unit/cmocka_cpp.hpp"

using operate::Hands;
using operate::Request;
using operate::Station;
using operate::Surroundings;
using operate::Trouble;

constexpr Surroundings kReady = {Trouble::kNone, EcuMode::kReady};
constexpr Surroundings kArmed = {Trouble::kNone, EcuMode::kArmed};
constexpr Surroundings kActive = {Trouble::kNone, EcuMode::kActive};

Hands held(double boom_pull_ratio = 0.0) {
  Hands hands;
  hands.deadman = true;
  hands.levers.right.away_ratio = -boom_pull_ratio;
  return hands;
}

/// A station whose deadman has been seen released.
Station released(const operate::StationOptions& options = {}) {
  Station station(options);
  static_cast<void>(station.step({}, kReady));
  return station;
}

void check_nothing(const Request& request) {
  assert_false(request.enable);
  assert_true(request.task == Task::kNone);
  assert_near(request.axes.boom_or_up_ratio, 0.0, 0.0);
}

TEST(the_task_waits_until_the_controller_is_armed) {
  Station station = released();
  Request request = station.step(held(), kReady);
  assert_true(request.enable);
  assert_true(request.task == Task::kNone);
  request = station.step(held(0.5), kArmed);
  assert_true(request.task == Task::kJog);
  assert_near(request.axes.boom_or_up_ratio, 0.5, 0.0);
  request = station.step(held(0.5), kActive);
  assert_true(request.enable && request.task == Task::kJog);
  // What has stopped arms with no task only.
  request = station.step(held(0.5), {Trouble::kNone, EcuMode::kFault});
  assert_true(request.task == Task::kNone);
}

TEST(release_is_off_in_the_same_cycle) {
  Station station = released();
  static_cast<void>(station.step(held(), kReady));
  assert_true(station.step(held(0.5), kActive).enable);
  Hands hands = held(0.5);
  hands.deadman = false;
  check_nothing(station.step(hands, kActive));
}

TEST(a_device_that_is_gone_is_off_in_the_same_cycle) {
  Station station = released();
  static_cast<void>(station.step(held(), kReady));
  Hands gone = held(0.5);
  gone.is_there = false;
  check_nothing(station.step(gone, kActive));
  assert_true(station.deadman().trouble() == Trouble::kDeviceGone);
  // Back, and still held.
  check_nothing(station.step(held(), kReady));
}

TEST(lost_events_are_off_in_the_same_cycle) {
  Station station = released();
  static_cast<void>(station.step(held(), kReady));
  Hands lost = held(0.5);
  lost.lost_events = true;
  check_nothing(station.step(lost, kActive));
  assert_true(station.deadman().trouble() == Trouble::kEventsLost);
}

TEST(silence_counts_only_while_it_is_held_and_for_long) {
  operate::StationOptions options;
  options.silent_after_us = 2 * kSecondUs;
  Station station = released(options);
  Hands quiet;
  quiet.quiet_us = 100 * kSecondUs;
  static_cast<void>(station.step(quiet, kReady));
  assert_true(station.deadman().trouble() == Trouble::kNone);
  assert_true(station.step(held(), kReady).enable);
  quiet = held(0.5);
  quiet.quiet_us = options.silent_after_us;
  assert_true(station.step(quiet, kActive).enable);
  ++quiet.quiet_us;
  check_nothing(station.step(quiet, kActive));
  assert_true(station.deadman().trouble() == Trouble::kDeviceSilent);
}

TEST(trouble_around_is_off) {
  for (const Trouble trouble :
       {Trouble::kStationLate, Trouble::kBus, Trouble::kEcuSilent, Trouble::kOtherDbc}) {
    Station station = released();
    static_cast<void>(station.step(held(), kReady));
    check_nothing(station.step(held(0.5), {trouble, EcuMode::kActive}));
    assert_true(station.deadman().trouble() == trouble);
  }
}

TEST(mode_and_task_change_at_a_press) {
  Station station = released();
  Hands press;
  press.changes_mode = true;
  assert_true(station.step({}, kReady).mode == OperatorMode::kManual);
  assert_true(station.step(press, kReady).mode == OperatorMode::kAutomatic);
  assert_true(station.step({}, kReady).mode == OperatorMode::kAutomatic);
  assert_true(station.step(press, kReady).mode == OperatorMode::kManual);
  press = {};
  press.changes_task = true;
  static_cast<void>(station.step(press, kReady));
  assert_true(station.chosen_task() == Task::kCoordinated);
  // Not while it is held, and not with the press itself.
  Hands held_press = held();
  held_press.changes_task = true;
  assert_true(station.step(held_press, kReady).enable);
  assert_true(station.chosen_task() == Task::kCoordinated);
  assert_true(station.step(held_press, kArmed).task == Task::kCoordinated);
  assert_true(station.chosen_task() == Task::kCoordinated);
  for (const Task next : {Task::kAssist, Task::kJog}) {
    static_cast<void>(station.step({}, kReady));
    static_cast<void>(station.step(press, kReady));
    assert_true(station.chosen_task() == next);
  }
}

TEST(speed_goes_by_tenths_and_stops_at_its_ends) {
  Station station = released();
  Hands faster;
  faster.speed_steps = 1;
  assert_near(station.step({}, kReady).speed_override_ratio, 0.1, 0.0);
  assert_near(station.step(faster, kReady).speed_override_ratio, 0.2, 1e-12);
  faster.speed_steps = 20;
  assert_near(station.step(faster, kReady).speed_override_ratio, 1.0, 0.0);
  faster.speed_steps = -1;
  assert_near(station.step(faster, kReady).speed_override_ratio, 0.9, 1e-12);
  faster.speed_steps = -20;
  assert_near(station.step(faster, kReady).speed_override_ratio, 0.0, 0.0);
}
