// SPDX-License-Identifier: Apache-2.0
// Periods, protection, and what is commanded when the outputs cannot be trusted: the dozer.

#include "can_dbc/generated/dozer_dbc.hpp"
#include "tests/unit/hal/bus_sender.hpp"

using namespace graben::test;
namespace bus = dbc::dozer;
using dbc::RawState;
using DozerSender = Sender<DozerTransmitter>;

TEST(periods) {
  for (const TimeUs jitter_us : {0, 4000}) {
    const auto tally =
        sent_in_10_s<DozerTransmitter, bus::SpoolCommand, bus::PumpDisplacementCommand,
                     bus::MotorDisplacementCommand, bus::EcuStatus, bus::EcuMotion, bus::EcuGrade,
                     bus::EcuHealth, bus::EcuIdentity, bus::EcuChecks, bus::DM1>(jitter_us);
    const std::array<int, 10> expected = {1000, 1000, 1000, 500, 500, 500, 100, 10, 10, 10};
    assert_true(std::equal(expected.begin(), expected.end(), tally.begin()));
    assert_in_range(tally.back(), 5, 6);
  }
}

TEST(protection) {
  check_protection<DozerTransmitter, bus::SpoolCommand>();
  check_protection<DozerTransmitter, bus::PumpDisplacementCommand>();
  check_protection<DozerTransmitter, bus::MotorDisplacementCommand>();
}

TEST(pilot_cut) { check_pilot_cut<DozerTransmitter, bus::SpoolCommand>(); }

// All that is commanded, as it is on the bus.
struct Commanded {
  bool enable;
  double blade;
  std::array<double, 2> pump;
  std::array<double, 2> motor;
};

double valid(const dbc::Physical& sent) {
  assert_int_equal(sent.state, RawState::kValid);
  return sent.value;
}

Commanded commanded(const DozerSender& sender) {
  const auto spool = sender.sent<bus::SpoolCommand>();
  const auto pumps = sender.sent<bus::PumpDisplacementCommand>();
  const auto motors = sender.sent<bus::MotorDisplacementCommand>();
  assert_int_equal(spool.enable.state, RawState::kValid);
  return {spool.enable.value == bus::SpoolCommand::Enable::kOn,
          valid(spool.blade_duty_ratio),
          {valid(pumps.left_pump_ratio), valid(pumps.right_pump_ratio)},
          {valid(motors.left_motor_ratio), valid(motors.right_motor_ratio)}};
}

void assert_commands(const DozerSender& sender, const Commanded& expected) {
  const Commanded sent = commanded(sender);
  assert_int_equal(sent.enable, expected.enable);
  assert_near(sent.blade, expected.blade, 1e-12);
  for (std::size_t track = 0; track < 2; ++track) {
    assert_near(sent.pump[track], expected.pump[track], 1e-12);
    assert_near(sent.motor[track], expected.motor[track], 1e-12);
  }
}

constexpr Commanded kNeutral{false, 0.0, {0.0, 0.0}, {1.0, 1.0}};

void move(DozerOutputs& outputs) {
  outputs.enable = true;
  outputs.blade_duty_ratio = -0.25;
  outputs.pump_ratio = {0.5, -0.75};
  outputs.motor_ratio = {0.35, 0.8};
}

TEST(commands, DozerSender sender) {
  sender.call(kStartUs);
  assert_commands(sender, kNeutral);

  move(sender.outputs);
  sender.call(kStartUs + 10'000);
  assert_commands(sender, {true, -0.25, {0.5, -0.75}, {0.35, 0.8}});

  sender.outputs.blade_duty_ratio = 1.5;
  sender.outputs.pump_ratio = {1.2, -1e300};
  sender.outputs.motor_ratio = {-0.1, 7.0};
  sender.call(kStartUs + 20'000);
  assert_commands(sender, {true, 1.0, {1.0, -1.0}, {0.0, 1.0}});

  move(sender.outputs);
  sender.outputs.enable = false;
  sender.call(kStartUs + 30'000);
  assert_commands(sender, kNeutral);
}

TEST(a_number_that_is_not_finite_stops_all) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (int which = 0; which < 5; ++which) {
      DozerSender sender;
      move(sender.outputs);
      DozerOutputs& out = sender.outputs;
      double* const numbers[] = {&out.blade_duty_ratio, &out.pump_ratio[kLeft],
                                 &out.pump_ratio[kRight], &out.motor_ratio[kLeft],
                                 &out.motor_ratio[kRight]};
      *numbers[which] = bad;
      sender.call(kStartUs);
      assert_commands(sender, kNeutral);
    }
  }
}

// The brake is as it is asked for, whatever else is.
TEST(brake) {
  for (const bool enable : {false, true}) {
    for (const bool wanted : {false, true}) {
      for (const double pump_ratio : {0.5, kNan}) {
        DozerSender sender;
        move(sender.outputs);
        sender.outputs.enable = enable;
        sender.outputs.brake = wanted;
        sender.outputs.pump_ratio[kLeft] = pump_ratio;
        sender.call(kStartUs);
        const auto message = sender.sent<bus::PumpDisplacementCommand>();
        assert_int_equal(message.brake.state, RawState::kValid);
        assert_int_equal(message.brake.value == bus::PumpDisplacementCommand::Brake::kOn, wanted);
      }
    }
  }
}

TEST(motion_and_grade, DozerSender sender) {
  DozerStatus& out = sender.outputs.status;
  out.limit = {LimitKind::kTransmissionFlow, 1};
  out.wanted_speed_mps = 1.25;
  out.speed_limit_mps = 2.5;
  out.wanted_blade_mps = -0.125;
  out.required_flow_m3ps = 1.1e-3;
  out.available_flow_m3ps = 1.41e-3;
  out.grade_error_m = -0.0125;
  sender.call(kStartUs);
  const auto status = sender.sent<bus::EcuStatus>();
  assert_int_equal(status.limit_kind.value, bus::EcuStatus::LimitKind::kTransmissionFlow);
  assert_int_equal(status.limit_index.value, 1);
  sender.call(kStartUs + 10'000);
  const auto motion = sender.sent<bus::EcuMotion>();
  assert_near(motion.wanted_speed_mps.value, 1.25, 1e-12);
  assert_near(motion.speed_limit_mps.value, 2.5, 1e-12);
  assert_near(motion.wanted_blade_velocity_mps.value, -0.125, 1e-12);
  const auto grade = sender.sent<bus::EcuGrade>();
  assert_near(grade.required_flow_m3ps.value, 1.1e-3, 1e-12);
  assert_near(grade.available_flow_m3ps.value, 1.41e-3, 1e-12);
  assert_near(grade.grade_error_m.value, -0.0125, 1e-12);

  out.limit = {LimitKind::kAhead, 0};
  out.speed_limit_mps = 100.0;
  out.grade_error_m = kNan;
  sender.call(kStartUs + 20'000);
  assert_int_equal(sender.sent<bus::EcuStatus>().limit_kind.value,
                   bus::EcuStatus::LimitKind::kAhead);
  sender.call(kStartUs + 30'000);
  assert_near(sender.sent<bus::EcuMotion>().speed_limit_mps.value, 6.4, 1e-12);
  assert_int_equal(sender.sent<bus::EcuGrade>().grade_error_m.state, RawState::kError);
}
