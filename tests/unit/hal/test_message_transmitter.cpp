// SPDX-License-Identifier: Apache-2.0
// Schedule, status, health and trouble codes, which are the same on either bus.

#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "firmware/safety/fault_table.hpp"
#include "tests/unit/hal/bus_sender.hpp"

using namespace graben::test;

struct Excavator {
  using Transmitter = ExcavatorTransmitter;
  using SpoolCommand = dbc::excavator::SpoolCommand;
  using EcuStatus = dbc::excavator::EcuStatus;
  using EcuIdentity = dbc::excavator::EcuIdentity;
  using EcuHealth = dbc::excavator::EcuHealth;
  using DM1 = dbc::excavator::DM1;
  static constexpr std::uint8_t kDbcVersion = dbc::excavator::kDbcVersion;
};

struct Dozer {
  using Transmitter = DozerTransmitter;
  using SpoolCommand = dbc::dozer::SpoolCommand;
  using EcuStatus = dbc::dozer::EcuStatus;
  using EcuIdentity = dbc::dozer::EcuIdentity;
  using EcuHealth = dbc::dozer::EcuHealth;
  using DM1 = dbc::dozer::DM1;
  static constexpr std::uint8_t kDbcVersion = dbc::dozer::kDbcVersion;
};

template <class Kind>
using SenderOf = Sender<typename Kind::Transmitter>;

TEST_FOR_EACH(an_overrun_does_not_burst, Kind, Excavator, Dozer) {
  SenderOf<Kind> sender;
  TimeUs now = kStartUs;
  sender.call(now);
  now += 500'000;
  sender.call(now);
  assert_in_range(sender.count, 1, Kind::Transmitter::kPeriodicCount);
  int commands = 0;
  int statuses = 0;
  for (int cycle = 0; cycle < 10; ++cycle) {
    now += 10'000;
    sender.call(now);
    commands += sender.template find<typename Kind::SpoolCommand>() != nullptr;
    statuses += sender.template find<typename Kind::EcuStatus>() != nullptr;
  }
  assert_int_equal(commands, 10);
  assert_int_equal(statuses, 5);
}

TEST_FOR_EACH(a_clock_that_jumps_back_does_not_silence, Kind, Excavator, Dozer) {
  SenderOf<Kind> sender;
  sender.call(kStartUs);
  sender.call(kStartUs - 2'000'000);
  assert_non_null(sender.template find<typename Kind::SpoolCommand>());
  sender.call(kStartUs - 1'990'000);
  assert_non_null(sender.template find<typename Kind::SpoolCommand>());
}

TEST_FOR_EACH(frames_are_whole, Kind, Excavator, Dozer) {
  SenderOf<Kind> sender;
  sender.call(kStartUs);
  assert_int_equal(sender.out[0].id, Kind::SpoolCommand::kId);  // the most urgent goes first
  for (int i = 0; i < sender.count; ++i) {
    const CanFrame& frame = sender.out[static_cast<std::size_t>(i)];
    assert_true(frame.extended);
    assert_false(frame.remote || frame.error || frame.fd);
    assert_int_equal(frame.length, 8);
    assert_int_equal(frame.stamp_us, kStartUs);
  }
}

template <class Kind>
typename Kind::EcuHealth health_of(SenderOf<Kind>& sender) {
  for (int cycle = 0; cycle < 10; ++cycle) {
    sender.call(kStartUs + cycle * kPeriodUs);
    if (sender.template find<typename Kind::EcuHealth>() != nullptr) {
      return sender.template sent<typename Kind::EcuHealth>();
    }
  }
  fail_msg("no EcuHealth within 100 ms");
  return {};
}

TEST_FOR_EACH(health, Kind, Excavator, Dozer) {
  SenderOf<Kind> well;
  well.diagnosis.process = {1, 2, 3, true};
  well.diagnosis.dropped_frames = 4;
  auto message = health_of<Kind>(well);
  assert_int_equal(message.why_not_armed.value, 0);
  assert_int_equal(message.allocations.value, 1);
  assert_int_equal(message.page_faults.value, 2);
  assert_int_equal(message.overruns.value, 3);
  assert_int_equal(message.dropped_frames.value, 4);
  assert_int_equal(message.real_time.value, Kind::EcuHealth::RealTime::kOn);
  assert_int_equal(message.stand_in.value, Kind::EcuHealth::StandIn::kOff);

  SenderOf<Kind> ill;
  ill.outputs.status.why_not_armed = 0xFFFFFFFF;
  ill.outputs.status.stand_in = true;
  ill.diagnosis.process = {251, 1000, UINT32_MAX, false};
  ill.diagnosis.dropped_frames = 100'000;
  message = health_of<Kind>(ill);
  assert_int_equal(message.why_not_armed.value, 0xFFFFFFFF);
  assert_int_equal(message.allocations.value, 13);
  assert_int_equal(message.page_faults.value, 250);
  assert_int_equal(message.overruns.value, 250);
  assert_int_equal(message.dropped_frames.value, 250);
  assert_int_equal(message.real_time.value, Kind::EcuHealth::RealTime::kOff);
  assert_int_equal(message.stand_in.value, Kind::EcuHealth::StandIn::kOn);
}

template <class Trouble>
std::uint32_t spn_of(const Trouble& message) {
  return message.spn_high.value << 16U | message.spn_low.value;
}

TEST_FOR_EACH(trouble_codes, Kind, Excavator, Dozer) {
  SenderOf<Kind> sender;
  sender.call(kStartUs);
  auto message = sender.template sent<typename Kind::DM1>();
  assert_int_equal(spn_of(message), 0);
  assert_int_equal(message.fmi.value, 0);
  assert_int_equal(message.occurrence_count.value, 0);
  assert_int_equal(message.red_stop_lamp.value, Kind::DM1::RedStopLamp::kOff);
  assert_int_equal(message.amber_warning_lamp.value, Kind::DM1::AmberWarningLamp::kOff);

  sender.outputs.status.faults.add(Fault::kBusOff);  // red
  sender.call(kStartUs + kPeriodUs);
  message = sender.template sent<typename Kind::DM1>();
  assert_int_equal(spn_of(message), 520192 + 12);
  assert_int_equal(message.fmi.value, fault_row(Fault::kBusOff).fmi);
  assert_int_equal(message.occurrence_count.value, 1);
  assert_int_equal(message.red_stop_lamp.value, Kind::DM1::RedStopLamp::kOn);
  assert_int_equal(message.amber_warning_lamp.value, Kind::DM1::AmberWarningLamp::kOff);
  assert_int_equal(message.protect_lamp.value, Kind::DM1::ProtectLamp::kOff);
  assert_int_equal(message.conversion_method.value, 0);

  sender.outputs.status.faults = {};
  sender.outputs.status.faults.add(Fault::kPressureImplausible);  // amber
  sender.call(kStartUs + 2 * kPeriodUs);
  message = sender.template sent<typename Kind::DM1>();
  assert_int_equal(message.red_stop_lamp.value, Kind::DM1::RedStopLamp::kOff);
  assert_int_equal(message.amber_warning_lamp.value, Kind::DM1::AmberWarningLamp::kOn);
}

TEST_FOR_EACH(status_names_every_fault, Kind, Excavator, Dozer) {
  for (int code = 0; code < kFaultCount; ++code) {
    SenderOf<Kind> sender;
    sender.outputs.status.fault = static_cast<Fault>(code);
    sender.outputs.status.limit = {LimitKind::kDegraded, static_cast<std::uint8_t>(code)};
    sender.call(kStartUs);
    const auto message = sender.template sent<typename Kind::EcuStatus>();
    assert_int_equal(message.fault.state, dbc::RawState::kValid);
    assert_int_equal(message.fault.value, code);
    assert_int_equal(message.limit_kind.value, Kind::EcuStatus::LimitKind::kDegraded);
    assert_int_equal(message.limit_index.value, code);
  }
}

TEST_FOR_EACH(status, Kind, Excavator, Dozer) {
  SenderOf<Kind> sender;
  MachineStatus& out = sender.outputs.status;
  out.mode = EcuMode::kActive;
  out.fault = Fault::kSolverFailed;
  out.limit = {LimitKind::kBackFlow, 2};
  out.lambda = 0.625;
  sender.diagnosis = {1234, 17, 0xCAFEF00D, 0, 0, {}};
  sender.call(kStartUs);
  using EcuStatus = typename Kind::EcuStatus;
  const auto message = sender.template sent<EcuStatus>();
  assert_int_equal(message.mode.value, EcuStatus::Mode::kActive);
  assert_int_equal(message.fault.value, EcuStatus::Fault::kSolverFailed);
  assert_int_equal(message.limit_kind.value, EcuStatus::LimitKind::kBackFlow);
  assert_int_equal(message.limit_index.value, 2);
  assert_near(message.lambda.value, 0.625, 1e-12);
  assert_int_equal(message.cycle_time_us.value, 1234);
  assert_int_equal(message.rejected_frames.value, 17);
  const auto identity = sender.template sent<typename Kind::EcuIdentity>();
  assert_int_equal(identity.profile_hash.value, 0xCAFEF00D);
  assert_int_equal(identity.dbc_version.value, Kind::kDbcVersion);
}

TEST_FOR_EACH(status_saturates_or_says_error, Kind, Excavator, Dozer) {
  SenderOf<Kind> sender;
  sender.outputs.status.lambda = kNan;
  sender.outputs.status.mode = static_cast<EcuMode>(9);
  sender.diagnosis = {1'000'000, 100'000, 0, 0, 0, {}};
  sender.call(kStartUs);
  auto message = sender.template sent<typename Kind::EcuStatus>();
  assert_int_equal(message.lambda.state, dbc::RawState::kError);
  assert_int_equal(message.mode.state, dbc::RawState::kError);
  assert_int_equal(message.cycle_time_us.value, 64255);
  assert_int_equal(message.rejected_frames.value, 250);
  sender.diagnosis = {-1, 0, 0, 0, 0, {}};
  sender.call(kStartUs + 20'000);
  assert_int_equal(sender.template sent<typename Kind::EcuStatus>().cycle_time_us.value, 0);
  sender.diagnosis = {TimeUs{1} << 40, 0, 0, 0, 0, {}};
  sender.call(kStartUs + 40'000);
  assert_int_equal(sender.template sent<typename Kind::EcuStatus>().cycle_time_us.value, 64255);
}
