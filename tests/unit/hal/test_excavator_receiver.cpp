// SPDX-License-Identifier: Apache-2.0
// Good frames of the excavator's bus reach its inputs, each signal its place.

#include "tests/unit/hal/bus_frames.hpp"

using namespace graben::test;
namespace bus = dbc::excavator;
using dbc::RawState;

using ExcavatorFeed = Feed<ExcavatorReceiver>;

TEST(strokes_and_pressures, ExcavatorFeed feed) {
  const std::array<TimeUs, 3> stroke_us = {feed.send(bus::BoomStroke{{1.1, RawState::kValid}}),
                                           feed.send(bus::ArmStroke{{1.2, RawState::kValid}}),
                                           feed.send(bus::BucketStroke{{1.3, RawState::kValid}})};
  const std::array<TimeUs, 3> pressure_us = {
      feed.send(bus::BoomPressure{{11e6, RawState::kValid}, {12e6, RawState::kValid}}),
      feed.send(bus::ArmPressure{{13e6, RawState::kValid}, {14e6, RawState::kValid}}),
      feed.send(bus::BucketPressure{{15e6, RawState::kValid}, {16e6, RawState::kValid}})};
  const auto& axis = feed.receiver.inputs().axis;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    assert_signal(axis[i].stroke_m, 1.1 + 0.1 * static_cast<double>(i), stroke_us[i]);
    assert_signal(axis[i].cap_pressure_pa, 11e6 + 2e6 * static_cast<double>(i), pressure_us[i]);
    assert_signal(axis[i].rod_pressure_pa, 12e6 + 2e6 * static_cast<double>(i), pressure_us[i]);
  }
  assert_int_equal(feed.receiver.total().accepted, 6);
  assert_int_equal(feed.receiver.total().synchronising, 6 * 2);
  assert_int_equal(rejected(feed.receiver.total()), 0);
}

TEST(pumps_engine_and_valve, ExcavatorFeed feed) {
  const TimeUs pump_us =
      feed.send(bus::PumpState{{0.25, RawState::kValid}, {0.75, RawState::kValid}});
  const TimeUs engine_us =
      feed.send(bus::EEC1::decode({0xFF, 0xFF, 0xFF, 0x80, 0x3E, 0xFF, 0xFF, 0xFF}));
  bus::ValveState valve;
  valve.enabled = {bus::ValveState::Enabled::kOn, RawState::kValid};
  valve.boom_spool_ratio = {0.25, RawState::kValid};
  valve.arm_spool_ratio = {-0.5, RawState::kValid};
  valve.bucket_spool_ratio = {1.0, RawState::kValid};
  const TimeUs valve_us = feed.send(valve);

  const ExcavatorInputs& in = feed.receiver.inputs();
  assert_signal(in.swash_ratio[0], 0.25, pump_us);
  assert_signal(in.swash_ratio[1], 0.75, pump_us);
  assert_signal(in.engine_speed_radps, 2000.0 * 2.0 * 3.14159265358979323846 / 60.0, engine_us);
  assert_signal(in.axis[0].spool_ratio, 0.25, valve_us);
  assert_signal(in.axis[1].spool_ratio, -0.5, valve_us);
  assert_signal(in.axis[2].spool_ratio, 1.0, valve_us);
  assert_signal(in.valve_enabled, 1.0, valve_us);
}

TEST(swing) {
  Feed<WithAllParts<ExcavatorReceiver>> feed;
  const TimeUs motor_us = feed.send(bus::SwingState{
      {-1.25, RawState::kValid}, {11e6, RawState::kValid}, {12e6, RawState::kValid}});
  const TimeUs valve_us = feed.send(bus::SwingValveState{{-0.75, RawState::kValid}});
  const SwingInputs& in = feed.receiver.inputs().swing;
  assert_signal(in.angle_rad, -1.25, motor_us);
  assert_signal(in.left_pressure_pa, 11e6, motor_us);
  assert_signal(in.right_pressure_pa, 12e6, motor_us);
  assert_signal(in.spool_ratio, -0.75, valve_us);
  assert_int_equal(feed.receiver.foreign(), 0);
}

TEST(second_sensors) {
  Feed<WithAllParts<ExcavatorReceiver>> feed;
  const TimeUs strokes_us =
      feed.send(bus::SecondStrokes{{1.25, RawState::kValid}, {}, {0.75, RawState::kValid}});
  const TimeUs swing_us = feed.send(bus::SecondSwing{{-1.25, RawState::kValid}});
  const ExcavatorInputs& in = feed.receiver.inputs();
  assert_signal(in.second_stroke_m[0], 1.25, strokes_us);
  assert_int_equal(in.second_stroke_m[1].validity, Validity::kNotAvailable);
  assert_signal(in.second_stroke_m[2], 0.75, strokes_us);
  assert_signal(in.second_swing_rad, -1.25, swing_us);
  assert_int_equal(feed.receiver.foreign(), 0);
}

// Without a swing drive its frames, good or bad, are nobody's.
TEST(another_machines_swing_is_foreign, ExcavatorFeed feed) {
  CanFrame corrupt = frame_of(filled<bus::SwingState>(1000), 1);
  corrupt.data[3] ^= 1U;
  for (int n = 0; n < 10; ++n) {
    feed.receiver.accept(frame_of(filled<bus::SwingValveState>(1000), 0), ++feed.start_us);
    feed.receiver.accept(corrupt, ++feed.start_us);
    feed.receiver.accept(frame_of(filled<bus::SecondStrokes>(1000), 0), ++feed.start_us);
    feed.receiver.accept(frame_of(filled<bus::SecondSwing>(1000), 0), ++feed.start_us);
  }
  assert_int_equal(feed.receiver.foreign(), 40);
  assert_int_equal(rejected(feed.receiver.total()), 0);
  assert_true(feed.receiver.message_faults(feed.start_us).empty());
  const SwingInputs& in = feed.receiver.inputs().swing;
  assert_int_equal(in.angle_rad.validity, Validity::kNotReceived);
  assert_int_equal(in.spool_ratio.validity, Validity::kNotReceived);
}

template <std::size_t count>
void assert_all(const Signal<std::array<double, count>>& signal,
                const std::array<double, count>& values, TimeUs stamp_us) {
  assert_int_equal(signal.validity, Validity::kValid);
  assert_int_equal(signal.stamp_us, stamp_us);
  for (std::size_t i = 0; i < count; ++i) {
    assert_near(signal.value[i], values[i], 1e-12);
  }
}

/// A lever that the station does not have is at rest; one that is broken breaks all.
TEST(levers, ExcavatorFeed feed) {
  bus::OperatorAxes axes{{0.2, RawState::kValid},
                         {-0.4, RawState::kValid},
                         {1.0, RawState::kValid},
                         {-1.0, RawState::kValid}};
  TimeUs now = feed.send(axes);
  const auto& lever = feed.receiver.inputs().lever_ratio;
  assert_all<4>(lever, {0.2, -0.4, 1.0, -1.0}, now);
  axes.swing_ratio = {0.0, RawState::kNotAvailable};
  now += 20'000;
  feed.receiver.accept(frame_of(axes, 3), now);
  assert_all<4>(lever, {0.2, -0.4, 1.0, 0.0}, now);
  axes.arm_or_forward_ratio = {0.0, RawState::kError};
  now += 20'000;
  feed.receiver.accept(frame_of(axes, 4), now);
  assert_int_equal(lever.validity, Validity::kError);
}

TEST(duties_to_try_and_their_windows, ExcavatorFeed feed) {
  const TimeUs duty_us = feed.send(bus::CommissionDuty{
      {0.25, RawState::kValid}, {0.0, RawState::kNotAvailable}, {-1.0, RawState::kValid}});
  assert_all<3>(feed.receiver.inputs().tried_ratio, {0.25, 0.0, -1.0}, duty_us);
  bus::CommissionWindow window;
  window.drive = {bus::CommissionWindow::Drive::kArm, RawState::kValid};
  window.least_stroke_m = {0.25, RawState::kValid};
  window.most_stroke_m = {0.75, RawState::kValid};
  window.most_speed_mps = {0.5, RawState::kValid};
  TimeUs now = feed.send(window);
  const auto& windows = feed.receiver.inputs().window;
  assert_int_equal(windows[0].validity, Validity::kNotReceived);
  assert_int_equal(windows[2].validity, Validity::kNotReceived);
  assert_int_equal(windows[1].validity, Validity::kValid);
  assert_int_equal(windows[1].stamp_us, now);
  assert_near(windows[1].value.least_m, 0.25, 1e-12);
  assert_near(windows[1].value.most_m, 0.75, 1e-12);
  assert_near(windows[1].value.most_mps, 0.5, 1e-12);
  window.most_stroke_m = {0.0, RawState::kNotAvailable};
  now += 100'000;
  feed.receiver.accept(frame_of(window, 3), now);
  assert_int_equal(windows[1].validity, Validity::kNotAvailable);
}

/// Nobody knows whose window it is.
TEST(a_window_of_no_drive_is_nobodys, ExcavatorFeed feed) {
  bus::CommissionWindow window;
  window.drive = {bus::CommissionWindow::Drive::kBoom, RawState::kNotAvailable};
  static_cast<void>(feed.send(window));
  for (const auto& each : feed.receiver.inputs().window) {
    assert_true(each.validity != Validity::kValid);
  }
}

/// In another maker's frame, a percentage every 100 ms; 255 is none.
TEST(a_speed_limit_comes_in_anybodys_frame) {
  constexpr std::uint32_t kLimit = 0x18FF7DE8;
  constexpr TimeUs kTablePeriod = 10 * kMillisecondUs;
  BusTable other;
  other.message_count = 1;
  other.rule[0].id = kLimit;
  other.rule[0].length = 8;
  other.message[0].period_us = 10 * kTablePeriod;
  other.message[0].timeout_us = 35 * kTablePeriod;
  other.message[0].slow = true;
  other.message[0].count = 1;
  other.source_count = 1;
  other.source[0] = {
      {8, 8, false, false}, SourcePlace::kSpeedLimit, 0, false, 0.01, 0.0, 0.0, 1.0, 0.0, -1, 255};
  ExcavatorReceiver receiver{with_table({}, &other)};
  TimeUs now = kFirstFrameUs;
  const Signal<ExternalWord>& heard = receiver.inputs().external;
  const auto says = [&](int raw) {
    now += 10 * kTablePeriod;
    CanFrame frame;
    frame.id = kLimit;
    frame.length = 8;
    put_raw({8, 8, false, false}, raw, frame.data);
    receiver.accept(frame, now);
    receiver.finish(now);
  };
  receiver.finish(now);
  assert_int_equal(heard.validity, Validity::kNotReceived);
  const struct {
    int raw;
    ExternalLevel level;
  } cases[] = {{100, ExternalLevel::kFree}, {30, ExternalLevel::kSlow}, {0, ExternalLevel::kStop}};
  for (const auto& each : cases) {
    says(each.raw);
    assert_int_equal(heard.validity, Validity::kValid);
    assert_int_equal(heard.value.level, each.level);
    assert_near(heard.value.speed_ratio, 0.01 * each.raw, 1e-12);
    assert_false(heard.value.resumes);
    assert_int_equal(heard.stamp_us, now);
  }
  says(255);
  assert_int_equal(heard.validity, Validity::kNotAvailable);
  says(30);
  receiver.finish(now + 35 * kTablePeriod);
  assert_int_equal(heard.validity, Validity::kValid);
  receiver.finish(now + 36 * kTablePeriod);
  assert_int_equal(heard.validity, Validity::kNotAvailable);
}

TEST(one_signal_is_lost_the_other_stays) {
  ExcavatorReceiver receiver;
  const AxisInputs& boom = receiver.inputs().axis[0];
  check_lost<bus::BoomPressure>(receiver, bus::BoomPressure::kBoomCapPressure, {0xFE12, 0xFF00},
                                boom.cap_pressure_pa, boom.rod_pressure_pa);
  assert_near(boom.rod_pressure_pa.value, 2e6, 1e-6);
}

// Grade is a dozer's: the frame is refused.
TEST(another_kinds_task_is_out_of_range, ExcavatorReceiver receiver) {
  const TimeUs now = synchronise<bus::OperatorCommand>(receiver);
  receiver.accept(frame_with<bus::OperatorCommand>(bus::OperatorCommand::kTask, 2, 3), now);
  assert_int_equal(receiver.inputs().driver.task.value, bus::OperatorCommand::kTask.raw_max);
  assert_int_equal(receiver.link(bus::OperatorCommand::kId).out_of_range, 1);
}

TEST(a_touch_comes_with_its_point, ExcavatorReceiver receiver) {
  TimeUs now = synchronise<bus::TouchedPoint>(receiver);
  const auto& touch = receiver.inputs().driver.touch;
  const auto hear = [&](std::uint32_t kind, std::uint8_t counter) {
    now += bus::TouchedPoint::kCycleTimeMs * kMillisecondUs;
    receiver.accept(frame_with<bus::TouchedPoint>(bus::TouchedPoint::kKind, kind, counter), now);
  };
  hear(3, 3);
  assert_int_equal(touch.validity, Validity::kValid);
  assert_int_equal(touch.value.kind, TouchKind::kSurface);
  hear(5, 4);
  assert_int_equal(receiver.link(bus::TouchedPoint::kId).out_of_range, 1);
  hear(15, 5);
  assert_int_equal(touch.validity, Validity::kNotAvailable);
}
