// SPDX-License-Identifier: Apache-2.0
// Periods, protection, and what is commanded when the outputs cannot be trusted: the excavator.

#include "can_dbc/generated/excavator_dbc.hpp"
#include "tests/unit/hal/bus_sender.hpp"

using namespace graben::test;
namespace bus = dbc::excavator;
using dbc::RawState;
using ExcavatorSender = Sender<ExcavatorTransmitter>;

struct SwingTransmitter : ExcavatorTransmitter {
  SwingTransmitter() : ExcavatorTransmitter(BusParts{true}) {}
};
using SwingSender = Sender<SwingTransmitter>;

TEST(periods) {
  for (const TimeUs jitter_us : {0, 4000}) {
    const auto tally =
        sent_in_10_s<ExcavatorTransmitter, bus::SpoolCommand, bus::PumpCommand, bus::EcuStatus,
                     bus::EcuMotion, bus::EcuHydraulics, bus::EcuHealth, bus::EcuLearntValves,
                     bus::EcuTipLoad, bus::EcuIdentity, bus::EcuChecks, bus::DM1>(jitter_us);
    const std::array<int, 11> expected = {1000, 500, 500, 500, 500, 100, 100, 100, 10, 10, 10};
    assert_true(std::equal(expected.begin(), expected.end(), tally.begin()));
    assert_in_range(tally.back(), 4, 5);
  }
}

// Beside the rest, which stays as it is; without a swing drive nothing of it.
TEST(periods_of_the_swings_frames) {
  const auto tally =
      sent_in_10_s<SwingTransmitter, bus::SpoolCommand, bus::SwingCommand, bus::PumpCommand,
                   bus::EcuMotion, bus::TaskStatus, bus::EcuIdentity>(0);
  const std::array<int, 6> expected = {1000, 1000, 500, 500, 500, 10};
  assert_true(std::equal(expected.begin(), expected.end(), tally.begin()));
  assert_in_range(tally.back(), 5, 6);
  // What the task does is told of every machine.
  const auto without = sent_in_10_s<ExcavatorTransmitter, bus::SwingCommand, bus::TaskStatus>(0);
  assert_int_equal(without[0], 0);
  assert_int_equal(without[1], 500);
  // Right behind the other spools, and TaskStatus when PumpCommand is not.
  SwingSender sender;
  sender.call(kStartUs);
  assert_int_equal(sender.out[1].id, bus::SwingCommand::kId);
  assert_null(sender.find<bus::TaskStatus>());
  sender.call(kStartUs + kPeriodUs);
  assert_non_null(sender.find<bus::TaskStatus>());
  assert_null(sender.find<bus::PumpCommand>());
}

TEST(protection) {
  check_protection<ExcavatorTransmitter, bus::SpoolCommand>();
  check_protection<ExcavatorTransmitter, bus::PumpCommand>();
  check_protection<SwingTransmitter, bus::SwingCommand>();
}

TEST(pilot_cut) { check_pilot_cut<ExcavatorTransmitter, bus::SpoolCommand>(); }

void assert_neutral(const ExcavatorSender& sender) {
  const auto command = sender.sent<bus::SpoolCommand>();
  assert_int_equal(command.enable.state, RawState::kValid);
  assert_int_equal(command.enable.value, bus::SpoolCommand::Enable::kOff);
  for (const dbc::Physical& duty :
       {command.boom_duty_ratio, command.arm_duty_ratio, command.bucket_duty_ratio}) {
    assert_int_equal(duty.state, RawState::kValid);
    assert_near(duty.value, 0.0, 0.0);
  }
}

TEST(duty, ExcavatorSender sender) {
  sender.call(kStartUs);
  assert_neutral(sender);

  sender.outputs.enable = true;
  sender.outputs.duty_ratio = {0.25, -0.5, 0.75};
  sender.call(kStartUs + 10'000);
  auto command = sender.sent<bus::SpoolCommand>();
  assert_int_equal(command.enable.value, bus::SpoolCommand::Enable::kOn);
  assert_near(command.boom_duty_ratio.value, 0.25, 1e-12);
  assert_near(command.arm_duty_ratio.value, -0.5, 1e-12);
  assert_near(command.bucket_duty_ratio.value, 0.75, 1e-12);

  sender.outputs.duty_ratio = {1.5, -1e300, 0.0};
  sender.call(kStartUs + 20'000);
  command = sender.sent<bus::SpoolCommand>();
  assert_near(command.boom_duty_ratio.value, 1.0, 0.0);
  assert_near(command.arm_duty_ratio.value, -1.0, 0.0);

  sender.outputs.enable = false;
  sender.call(kStartUs + 30'000);
  assert_neutral(sender);
}

TEST(a_duty_that_is_not_finite_stops_all) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ExcavatorSender sender;
      sender.outputs.enable = true;
      sender.outputs.duty_ratio = {0.5, 0.5, 0.5};
      sender.outputs.duty_ratio[axis] = bad;
      sender.call(kStartUs);
      assert_neutral(sender);
    }
  }
}

void assert_swing(const SwingSender& sender, bool on, double duty) {
  const auto swing = sender.sent<bus::SwingCommand>();
  assert_int_equal(swing.enable.state, RawState::kValid);
  assert_int_equal(swing.enable.value == bus::SwingCommand::Enable::kOn, on);
  assert_int_equal(sender.sent<bus::SpoolCommand>().enable.value == bus::SpoolCommand::Enable::kOn,
                   on);
  assert_int_equal(swing.swing_duty_ratio.state, RawState::kValid);
  assert_near(swing.swing_duty_ratio.value, duty, 1e-12);
}

TEST(swing_duty, SwingSender sender) {
  sender.call(kStartUs);
  assert_swing(sender, false, 0.0);
  sender.outputs.enable = true;
  sender.outputs.duty_ratio = {0.25, -0.5, 0.75, -0.375};
  sender.call(kStartUs + kPeriodUs);
  assert_swing(sender, true, -0.375);
  sender.outputs.duty_ratio[3] = -7.0;
  sender.call(kStartUs + 2 * kPeriodUs);
  assert_swing(sender, true, -1.0);
  sender.outputs.enable = false;
  sender.call(kStartUs + 3 * kPeriodUs);
  assert_swing(sender, false, 0.0);
  // One that is not finite stops all spools together.
  for (std::size_t drive = 0; drive < 4; ++drive) {
    sender.outputs.enable = true;
    sender.outputs.duty_ratio = {0.5, 0.5, 0.5, 0.5};
    sender.outputs.duty_ratio[drive] = kNan;
    sender.call(kStartUs + static_cast<TimeUs>(4 + drive) * kPeriodUs);
    assert_swing(sender, false, 0.0);
    assert_near(sender.sent<bus::SpoolCommand>().boom_duty_ratio.value, 0.0, 0.0);
  }
}

TEST(task_status, SwingSender sender) {
  ExcavatorStatus& out = sender.outputs.status;
  out.swing_wanted_radps = -0.5;
  sender.cycles(2);
  assert_int_equal(sender.sent<bus::TaskStatus>().swing_wanted_velocity_radps.state,
                   RawState::kNotAvailable);
  out.swings = true;
  out.progress = {false, 3, 2, StepKind::kDump, 0.25};
  out.progress.missed = 4;
  sender.cycles(2, kStartUs + 2 * kPeriodUs);
  auto sent = sender.sent<bus::TaskStatus>();
  assert_int_equal(sent.task_number.state, RawState::kNotAvailable);
  assert_int_equal(sent.step_kind.value, bus::TaskStatus::StepKind::kNone);
  assert_int_equal(sent.not_arrived.state, RawState::kNotAvailable);
  assert_near(sent.swing_wanted_velocity_radps.value, -0.5, 1e-12);
  out.progress.runs = true;
  sender.cycles(2, kStartUs + 4 * kPeriodUs);
  sent = sender.sent<bus::TaskStatus>();
  assert_int_equal(sent.task_number.state, RawState::kValid);
  assert_int_equal(sent.task_number.value, 3);
  assert_int_equal(sent.step.value, 2);
  assert_int_equal(sent.step_kind.value, bus::TaskStatus::StepKind::kDump);
  assert_near(sent.progress.value, 0.25, 1e-12);
  assert_int_equal(sent.not_arrived.value, 4);
  out.progress.kind = StepKind::kWait;
  sender.cycles(2, kStartUs + 6 * kPeriodUs);
  assert_int_equal(sender.sent<bus::TaskStatus>().step_kind.value,
                   bus::TaskStatus::StepKind::kWait);
}

// A value or, for NaN, 'not available'.
void assert_sent(const dbc::Physical& sent, double expected) {
  if (std::isnan(expected)) {
    assert_int_equal(sent.state, RawState::kNotAvailable);
    return;
  }
  assert_int_equal(sent.state, RawState::kValid);
  assert_near(sent.value, expected, 1e-9);
}

TEST(swash) {
  struct Case {
    bool enable;
    double duty;
    std::array<double, 2> wanted;
    std::array<double, 2> sent;
  };
  const Case cases[] = {
      {true, 0.5, {0.25, 0.75}, {0.25, 0.75}},      {false, 0.5, {0.25, 0.75}, {kNan, kNan}},
      {true, kNan, {0.25, 0.75}, {kNan, kNan}},     {true, 0.5, {kNan, 0.75}, {kNan, 0.75}},
      {true, 0.5, {0.25, kInfinity}, {0.25, kNan}}, {true, 0.5, {0.0, 0.0}, {kNan, kNan}},
      {true, 0.5, {-0.1, 0.75}, {kNan, 0.75}},      {true, 0.5, {2.0, 1e-4}, {1.2, 1e-4}},
  };
  for (const Case& row : cases) {
    ExcavatorSender sender;
    sender.outputs.enable = row.enable;
    sender.outputs.duty_ratio[1] = row.duty;
    sender.outputs.swash_ratio = row.wanted;
    sender.call(kStartUs);
    assert_sent(sender.sent<bus::PumpCommand>().pump1_swash_ratio, row.sent[0]);
    assert_sent(sender.sent<bus::PumpCommand>().pump2_swash_ratio, row.sent[1]);
  }
}

TEST(learnt_valves, ExcavatorSender sender) {
  auto& edges = sender.outputs.status.edges;
  edges[0] = {{true, 0.031}, {false, 0.02}};
  edges[1] = {{false, 0.0}, {true, -0.056}};
  edges[2] = {{true, 0.0}, {true, 0.3}};
  sender.cycles(5);
  const auto sent = sender.sent<bus::EcuLearntValves>();
  assert_near(sent.boom_extend_edge_ratio.value, 0.031, 1e-9);
  assert_int_equal(sent.boom_retract_edge_ratio.state, RawState::kNotAvailable);
  assert_int_equal(sent.arm_extend_edge_ratio.state, RawState::kNotAvailable);
  assert_near(sent.arm_retract_edge_ratio.value, -0.056, 1e-9);
  assert_near(sent.bucket_extend_edge_ratio.value, 0.0, 1e-9);
  assert_near(sent.bucket_retract_edge_ratio.value, 0.125, 1e-9);  // what the frame can say
}

TEST(tip_load) {
  for (const bool known : {false, true}) {
    ExcavatorSender sender;
    sender.outputs.status.tip_load = {known, {-31'230.0, 4'560.0}, 780.0, known, 512.5, 620.0};
    sender.cycles(7);
    const auto load = sender.sent<bus::EcuTipLoad>();
    assert_sent(load.tip_force_outwards_n, known ? -31'230.0 : kNan);
    assert_sent(load.tip_force_up_n, known ? 4'560.0 : kNan);
    assert_sent(load.tip_force_deviation_n, known ? 750.0 : kNan);
    assert_sent(load.payload_mass_kg, known ? 512.5 : kNan);
    assert_sent(load.payload_deviation_kg, known ? 250.0 : kNan);  // what the frame can say
  }
}

TEST(motion_and_hydraulics, ExcavatorSender sender) {
  ExcavatorStatus& out = sender.outputs.status;
  out.wanted_velocity_mps = {0.1, -0.2, 0.3};
  out.pump_pressure_pa = {20e6, 30e6};
  out.path_error_m = 0.05;
  out.assist = AssistState::kLetGo;
  out.site = 2;
  sender.cycles(2);
  const auto motion = sender.sent<bus::EcuMotion>();
  assert_near(motion.boom_wanted_velocity_mps.value, 0.1, 1e-12);
  assert_near(motion.arm_wanted_velocity_mps.value, -0.2, 1e-12);
  assert_near(motion.bucket_wanted_velocity_mps.value, 0.3, 1e-12);
  assert_true(motion.assist.value == bus::EcuMotion::Assist::kLetGo);
  assert_true(motion.frame.value == bus::EcuMotion::Frame::kBenchmark);
  const auto hydraulics = sender.sent<bus::EcuHydraulics>();
  assert_near(hydraulics.pump1_expected_pressure_pa.value, 20e6, 1e-3);
  assert_near(hydraulics.pump2_expected_pressure_pa.value, 30e6, 1e-3);
  assert_near(hydraulics.path_error_m.value, 0.05, 1e-12);
}

TEST(the_last_check_at_the_mark_is_told) {
  for (const auto checks : {std::uint8_t{0}, std::uint8_t{3}}) {
    ExcavatorSender sender;
    sender.outputs.status.mark = {checks > 0 ? MarkResult::kMissed : MarkResult::kNever,
                                  MarkTouch::kMoving,
                                  checks,
                                  7240.0,
                                  0.05,
                                  {0.012, -0.5, 0.03}};
    sender.cycles(9);
    const auto told = sender.sent<bus::EcuChecks>();
    assert_int_equal(told.result.value,
                     checks > 0 ? bus::EcuChecks::Result::kMissed : bus::EcuChecks::Result::kNever);
    assert_int_equal(told.touch.value, bus::EcuChecks::Touch::kMoving);
    assert_int_equal(told.checks.value, checks);
    assert_sent(told.tolerance_m, 0.05);
    assert_sent(told.age_s, checks > 0 ? 7260.0 : kNan);  // In whole minutes.
    assert_sent(told.off_outwards_m, checks > 0 ? 0.012 : kNan);
    assert_sent(told.off_across_m, checks > 0 ? -0.25 : kNan);  // what the frame can say
    assert_sent(told.off_up_m, checks > 0 ? 0.03 : kNan);
  }
}

TEST(without_a_mark_nothing_is_told_of_it, ExcavatorSender sender) {
  sender.cycles(9);
  const auto told = sender.sent<bus::EcuChecks>();
  assert_int_equal(told.result.value, bus::EcuChecks::Result::kNoMark);
  assert_sent(told.tolerance_m, kNan);
}
