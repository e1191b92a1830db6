// SPDX-License-Identifier: Apache-2.0
// Good frames of the dozer's bus reach its inputs, each signal its place.

#include "tests/unit/hal/bus_frames.hpp"

using namespace graben::test;
namespace bus = dbc::dozer;
using dbc::Physical;
using dbc::RawState;

using DozerFeed = Feed<DozerReceiver>;

constexpr Physical valid(double value) { return {value, RawState::kValid}; }

TEST(blade, DozerFeed feed) {
  const TimeUs stroke_us = feed.send(bus::BladeStroke{valid(0.31)});
  const TimeUs valve_us =
      feed.send(bus::ValveState{{bus::ValveState::Enabled::kOn, RawState::kValid}, valid(-0.25)});
  const DozerInputs& in = feed.receiver.inputs();
  assert_signal(in.blade_stroke_m, 0.31, stroke_us);
  assert_signal(in.blade_spool_ratio, -0.25, valve_us);
  assert_signal(in.valve_enabled, 1.0, valve_us);
}

TEST(body, DozerFeed feed) {
  const TimeUs position_us = feed.send(bus::BodyPosition{valid(-1234.5678), valid(-0.35)});
  const TimeUs pitch_us = feed.send(bus::BodyPitch{valid(-0.12), valid(0.34)});
  const TimeUs velocity_us = feed.send(bus::BodyVelocity{valid(1.6), valid(-0.2)});
  const BodyInputs& in = feed.receiver.inputs().body;
  assert_signal(in.position_m, -1234.5678, position_us);
  assert_signal(in.height_m, -0.35, position_us);
  assert_signal(in.pitch_rad, -0.12, pitch_us);
  assert_signal(in.pitch_rate_radps, 0.34, pitch_us);
  assert_signal(in.velocity_mps, 1.6, velocity_us);
  assert_signal(in.climb_mps, -0.2, velocity_us);
}

TEST(tracks, DozerFeed feed) {
  const TimeUs left_us = feed.send(bus::LeftTransmission{valid(0.5), valid(0.75), valid(20e6)});
  const TimeUs right_us = feed.send(bus::RightTransmission{valid(-0.25), valid(0.35), valid(5e6)});
  const TimeUs speed_us = feed.send(bus::TrackSpeed{valid(1.1), valid(-0.9)});
  const TimeUs engine_us =
      feed.send(bus::EEC1::decode({0xFF, 0xFF, 0xFF, 0x80, 0x3E, 0xFF, 0xFF, 0xFF}));
  const DozerInputs& in = feed.receiver.inputs();
  assert_signal(in.track[kLeft].pump_ratio, 0.5, left_us);
  assert_signal(in.track[kLeft].motor_ratio, 0.75, left_us);
  assert_signal(in.track[kRight].pump_ratio, -0.25, right_us);
  assert_signal(in.track[kRight].motor_ratio, 0.35, right_us);
  assert_signal(in.track[kLeft].speed_mps, 1.1, speed_us);
  assert_signal(in.track[kRight].speed_mps, -0.9, speed_us);
  assert_signal(in.engine_speed_radps, 2000.0 * 2.0 * 3.14159265358979323846 / 60.0, engine_us);
  assert_int_equal(feed.receiver.total().synchronising, 3 * 2);
  assert_int_equal(rejected(feed.receiver.total()), 0);
}

// 32 bits have special values too, by their top byte.
TEST(one_signal_is_lost_the_other_stays) {
  DozerReceiver receiver;
  const BodyInputs& body = receiver.inputs().body;
  check_lost<bus::BodyPosition>(receiver, bus::BodyPosition::kPosition, {0xFE123456U, 0xFF000000U},
                                body.position_m, body.height_m);
  assert_near(body.height_m.value, -15.0, 1e-9);
}

// Dig is an excavator's: the frame is refused, and the controller hears of it.
TEST(another_kinds_task_is_out_of_range, DozerReceiver receiver) {
  const TimeUs now = synchronise<test::DozerCommand>(receiver);
  assert_int_equal(receiver.inputs().driver.task.value, Task::kGrade);
  receiver.accept(frame_with<test::DozerCommand>(bus::OperatorCommand::kTask, 1, 3), now + 1);
  assert_int_equal(receiver.inputs().driver.task.value, Task::kGrade);
  assert_int_equal(receiver.inputs().driver.enable.stamp_us, now);
  assert_int_equal(receiver.link(bus::OperatorCommand::kId).out_of_range, 1);
  assert_true(receiver.take_out_of_range());
  receiver.accept(frame_with<test::DozerCommand>(bus::OperatorCommand::kTask, 0, 4), now + 20'000);
  assert_int_equal(receiver.inputs().driver.task.value, Task::kNone);
}

TEST(what_is_tried, DozerFeed feed) {
  using Drive = bus::DozerTry::Drive;
  const TimeUs tried_us =
      feed.send(bus::DozerTry{{Drive::kTracks, RawState::kValid}, valid(-0.25), valid(0.5)});
  const Signal<DozerTry>& tried = feed.receiver.inputs().tried;
  assert_int_equal(tried.validity, Validity::kValid);
  assert_int_equal(tried.stamp_us, tried_us);
  assert_int_equal(tried.value.drive, TriedDrive::kTracks);
  assert_near(tried.value.ratio, -0.25, 1e-9);
  assert_near(tried.value.motor_ratio, 0.5, 1e-9);
}

/// Where one of its values is none, nothing is asked for.
TEST(part_of_what_is_tried_is_nothing) {
  using Drive = bus::DozerTry::Drive;
  DozerFeed lacks;
  lacks.send(
      bus::DozerTry{{Drive::kTilt, RawState::kValid}, {0.0, RawState::kNotAvailable}, valid(1.0)});
  assert_int_equal(lacks.receiver.inputs().tried.validity, Validity::kNotAvailable);
  DozerFeed fails;
  fails.send(bus::DozerTry{{Drive::kTilt, RawState::kValid}, valid(0.5), {0.0, RawState::kError}});
  assert_int_equal(fails.receiver.inputs().tried.validity, Validity::kError);
}

TEST(windows) {
  using Drive = bus::DozerWindow::Drive;
  for (const Drive drive : {Drive::kBlade, Drive::kTilt, Drive::kTracks}) {
    DozerFeed feed;
    const auto& windows = feed.receiver.inputs().window;
    const auto at = static_cast<std::size_t>(drive);
    const TimeUs window_us = feed.send(
        bus::DozerWindow{{drive, RawState::kValid}, valid(-2.5), valid(3.0), valid(1.25)});
    for (std::size_t i = 0; i < windows.size(); ++i) {
      assert_int_equal(windows[i].validity, i == at ? Validity::kValid : Validity::kNotReceived);
    }
    assert_int_equal(windows[at].stamp_us, window_us);
    assert_near(windows[at].value.least_m, -2.5, 1e-9);
    assert_near(windows[at].value.most_m, 3.0, 1e-9);
    assert_near(windows[at].value.most_mps, 1.25, 1e-9);
  }
  DozerFeed lacks;
  lacks.send(bus::DozerWindow{
      {Drive::kTilt, RawState::kValid}, valid(0.0), {0.0, RawState::kNotAvailable}, valid(1.25)});
  assert_int_equal(lacks.receiver.inputs().window[1].validity, Validity::kNotAvailable);
}
