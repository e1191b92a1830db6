// Periods, protection, saturation, and what is sent when the outputs cannot be trusted.

#include "hal/excavator_transmitter.hpp"

#include <limits>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "firmware/safety/fault_table.hpp"
#include "hal/e2e.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace {

using namespace graben;
namespace bus = dbc::excavator;
using dbc::RawState;

constexpr TimeUs kStartUs = 3'000'000;
constexpr TimeUs kPeriodUs = 10'000;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A transmitter with everything that one call needs.
struct Sender {
  ExcavatorTransmitter transmitter;
  ExcavatorOutputs outputs;
  EcuDiagnosis diagnosis;
  ExcavatorTransmitter::Frames out{};
  int count = 0;

  void call(TimeUs now) { count = transmitter.frames(outputs, diagnosis, now, out); }

  template <class Message>
  const CanFrame* find() const {
    for (int i = 0; i < count; ++i) {
      if (out[static_cast<std::size_t>(i)].id == Message::kId) {
        return &out[static_cast<std::size_t>(i)];
      }
    }
    return nullptr;
  }

  template <class Message>
  Message sent() const {
    const CanFrame* frame = find<Message>();
    assert_non_null(frame);
    return Message::decode(frame->data);
  }
};

struct Tally {
  int spool = 0, status = 0, motion = 0, hydraulics = 0, identity = 0, pump = 0, health = 0,
      dm1 = 0, most_at_once = 0;
  void add(const Sender& sender) {
    spool += sender.find<bus::SpoolCommand>() != nullptr;
    status += sender.find<bus::EcuStatus>() != nullptr;
    motion += sender.find<bus::EcuMotion>() != nullptr;
    hydraulics += sender.find<bus::EcuHydraulics>() != nullptr;
    identity += sender.find<bus::EcuIdentity>() != nullptr;
    pump += sender.find<bus::PumpCommand>() != nullptr;
    health += sender.find<bus::EcuHealth>() != nullptr;
    dm1 += sender.find<bus::DM1>() != nullptr;
    most_at_once = sender.count > most_at_once ? sender.count : most_at_once;
  }
};

void periods(void**) {
  // Exact, and with a scheduler that is up to 4 ms early or late.
  for (const TimeUs jitter_us : {0, 4000}) {
    Sender sender;
    Tally tally;
    for (int cycle = 0; cycle < 1000; ++cycle) {
      const TimeUs deviation_us = cycle == 0 ? 0 : (cycle % 3 - 1) * jitter_us;
      sender.call(kStartUs + cycle * kPeriodUs + deviation_us);
      tally.add(sender);
    }
    assert_int_equal(tally.spool, 1000);
    assert_int_equal(tally.status, 500);
    assert_int_equal(tally.motion, 500);
    assert_int_equal(tally.hydraulics, 500);
    assert_int_equal(tally.identity, 10);
    assert_int_equal(tally.pump, 500);
    assert_int_equal(tally.health, 100);
    assert_int_equal(tally.dm1, 10);
    assert_in_range(tally.most_at_once, 4, 5);
  }
}

void an_overrun_does_not_burst(void**) {
  Sender sender;
  TimeUs now = kStartUs;
  sender.call(now);
  now += 500'000;
  sender.call(now);
  assert_in_range(sender.count, 1, 7);
  Tally tally;
  for (int cycle = 0; cycle < 10; ++cycle) {
    now += 10'000;
    sender.call(now);
    tally.add(sender);
  }
  assert_int_equal(tally.spool, 10);
  assert_int_equal(tally.status, 5);
}

void a_clock_that_jumps_back_does_not_silence(void**) {
  Sender sender;
  sender.call(kStartUs);
  sender.call(kStartUs - 2'000'000);
  assert_non_null(sender.find<bus::SpoolCommand>());
  sender.call(kStartUs - 1'990'000);
  assert_non_null(sender.find<bus::SpoolCommand>());
}

void frames_are_whole(void**) {
  Sender sender;
  sender.call(kStartUs);
  assert_int_equal(sender.out[0].id, bus::SpoolCommand::kId);  // the most urgent goes first
  for (int i = 0; i < sender.count; ++i) {
    const CanFrame& frame = sender.out[static_cast<std::size_t>(i)];
    assert_true(frame.extended);
    assert_false(frame.remote || frame.error || frame.fd);
    assert_int_equal(frame.length, 8);
    assert_int_equal(frame.stamp_us, kStartUs);
  }
}

// A receiver must accept every PumpCommand after its three of synchronisation.
void pump_protection(void**) {
  Sender sender;
  const E2eConfig config{bus::PumpCommand::kDataId, 1, 80'000, 20'000};
  E2eState state;
  for (int cycle = 0; cycle < 100; ++cycle) {
    const TimeUs now = kStartUs + cycle * kPeriodUs;
    sender.call(now);
    const CanFrame* frame = sender.find<bus::PumpCommand>();
    assert_int_equal(frame != nullptr, cycle % 2 == 0);
    if (frame != nullptr) {
      const E2eCheck check = e2e_check(config, state, frame->data, now);
      assert_int_equal(check, cycle < 4 ? E2eCheck::kSynchronising : E2eCheck::kOk);
    }
  }
}

// The same of SpoolCommand.
void protection(void**) {
  Sender sender;
  const E2eConfig config{bus::SpoolCommand::kDataId, 1, 40'000, 10'000};
  E2eState state;
  for (int cycle = 0; cycle < 100; ++cycle) {
    const TimeUs now = kStartUs + cycle * kPeriodUs;
    sender.call(now);
    const CanFrame* frame = sender.find<bus::SpoolCommand>();
    assert_non_null(frame);
    assert_int_equal(frame->data[1] & 0xF, cycle % 15);
    const E2eCheck check = e2e_check(config, state, frame->data, now);
    assert_int_equal(check, cycle < 2 ? E2eCheck::kSynchronising : E2eCheck::kOk);
  }
}

void assert_neutral(const Sender& sender) {
  const auto command = sender.sent<bus::SpoolCommand>();
  assert_int_equal(command.enable.state, RawState::kValid);
  assert_int_equal(command.enable.value, bus::SpoolCommand::Enable::kOff);
  for (const dbc::Physical& duty :
       {command.boom_duty_ratio, command.arm_duty_ratio, command.bucket_duty_ratio}) {
    assert_int_equal(duty.state, RawState::kValid);
    assert_near(duty.value, 0.0, 0.0);
  }
}

void duty(void**) {
  Sender sender;
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

void a_duty_that_is_not_finite_stops_all(void**) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Sender sender;
      sender.outputs.enable = true;
      sender.outputs.duty_ratio = {0.5, 0.5, 0.5};
      sender.outputs.duty_ratio[axis] = bad;
      sender.call(kStartUs);
      assert_neutral(sender);
    }
  }
}

// The cut is asked for with and without enable, and nothing else asks for it.
void pilot_cut(void**) {
  Sender unknown;
  unknown.outputs.pilot_cut = true;
  unknown.call(kStartUs);
  assert_int_equal(unknown.sent<bus::SpoolCommand>().pilot_cut.state, RawState::kNotAvailable);
  for (const bool enable : {false, true}) {
    for (const bool cut : {false, true}) {
      Sender sender;
      sender.outputs.enable = enable;
      sender.outputs.pilot_cut = cut;
      sender.outputs.pilot_known = true;
      sender.call(kStartUs);
      const auto command = sender.sent<bus::SpoolCommand>();
      assert_int_equal(command.pilot_cut.state, RawState::kValid);
      assert_int_equal(command.pilot_cut.value == bus::SpoolCommand::PilotCut::kOn, cut);
      assert_int_equal(command.enable.value == bus::SpoolCommand::Enable::kOn, enable);
    }
  }
}

// A value or, for NaN, 'not available'.
void assert_swash(const dbc::Physical& sent, double expected) {
  if (std::isnan(expected)) {
    assert_int_equal(sent.state, RawState::kNotAvailable);
    return;
  }
  assert_int_equal(sent.state, RawState::kValid);
  assert_near(sent.value, expected, 1e-9);
}

void swash(void**) {
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
    Sender sender;
    sender.outputs.enable = row.enable;
    sender.outputs.duty_ratio[1] = row.duty;
    sender.outputs.swash_ratio = row.wanted;
    sender.call(kStartUs);
    assert_swash(sender.sent<bus::PumpCommand>().pump1_swash_ratio, row.sent[0]);
    assert_swash(sender.sent<bus::PumpCommand>().pump2_swash_ratio, row.sent[1]);
  }
}

bus::EcuHealth health_of(Sender& sender) {
  for (int cycle = 0; cycle < 10; ++cycle) {
    sender.call(kStartUs + cycle * kPeriodUs);
    if (sender.find<bus::EcuHealth>() != nullptr) {
      return sender.sent<bus::EcuHealth>();
    }
  }
  fail_msg("no EcuHealth within 100 ms");
  return {};
}

void health(void**) {
  Sender well;
  well.diagnosis.process = {1, 2, 3, true};
  well.diagnosis.dropped_frames = 4;
  bus::EcuHealth message = health_of(well);
  assert_int_equal(message.why_not_armed.value, 0);
  assert_int_equal(message.allocations.value, 1);
  assert_int_equal(message.page_faults.value, 2);
  assert_int_equal(message.overruns.value, 3);
  assert_int_equal(message.dropped_frames.value, 4);
  assert_int_equal(message.real_time.value, bus::EcuHealth::RealTime::kOn);

  Sender ill;
  ill.outputs.status.why_not_armed = 0xFFFF;
  ill.diagnosis.process = {251, 1000, UINT32_MAX, false};
  ill.diagnosis.dropped_frames = 100'000;
  message = health_of(ill);
  assert_int_equal(message.why_not_armed.value, 0xFFFF);
  assert_int_equal(message.allocations.value, 250);
  assert_int_equal(message.page_faults.value, 250);
  assert_int_equal(message.overruns.value, 250);
  assert_int_equal(message.dropped_frames.value, 250);
  assert_int_equal(message.real_time.value, bus::EcuHealth::RealTime::kOff);
}

std::uint32_t spn_of(const bus::DM1& message) {
  return message.spn_high.value << 16U | message.spn_low.value;
}

void trouble_codes(void**) {
  Sender sender;
  sender.call(kStartUs);
  bus::DM1 message = sender.sent<bus::DM1>();
  assert_int_equal(spn_of(message), 0);
  assert_int_equal(message.fmi.value, 0);
  assert_int_equal(message.occurrence_count.value, 0);
  assert_int_equal(message.red_stop_lamp.value, bus::DM1::RedStopLamp::kOff);
  assert_int_equal(message.amber_warning_lamp.value, bus::DM1::AmberWarningLamp::kOff);

  sender.outputs.status.faults.add(Fault::kBusOff);  // red
  sender.call(kStartUs + kPeriodUs);
  message = sender.sent<bus::DM1>();
  assert_int_equal(spn_of(message), 520192 + 12);
  assert_int_equal(message.fmi.value, fault_row(Fault::kBusOff).fmi);
  assert_int_equal(message.occurrence_count.value, 1);
  assert_int_equal(message.red_stop_lamp.value, bus::DM1::RedStopLamp::kOn);
  assert_int_equal(message.amber_warning_lamp.value, bus::DM1::AmberWarningLamp::kOff);
  assert_int_equal(message.protect_lamp.value, bus::DM1::ProtectLamp::kOff);
  assert_int_equal(message.conversion_method.value, 0);

  sender.outputs.status.faults = {};
  sender.outputs.status.faults.add(Fault::kPressureImplausible);  // amber
  sender.call(kStartUs + 2 * kPeriodUs);
  message = sender.sent<bus::DM1>();
  assert_int_equal(message.red_stop_lamp.value, bus::DM1::RedStopLamp::kOff);
  assert_int_equal(message.amber_warning_lamp.value, bus::DM1::AmberWarningLamp::kOn);
}

void status_names_every_fault(void**) {
  for (int code = 0; code < kFaultCount; ++code) {
    Sender sender;
    sender.outputs.status.fault = static_cast<Fault>(code);
    sender.outputs.status.limit = {LimitKind::kDegraded, static_cast<std::uint8_t>(code)};
    sender.call(kStartUs);
    const auto message = sender.sent<bus::EcuStatus>();
    assert_int_equal(message.fault.state, RawState::kValid);
    assert_int_equal(message.fault.value, code);
    assert_int_equal(message.limit_kind.value, bus::EcuStatus::LimitKind::kDegraded);
    assert_int_equal(message.limit_index.value, code);
  }
}

void status(void**) {
  Sender sender;
  ExcavatorStatus& out = sender.outputs.status;
  out.mode = EcuMode::kActive;
  out.fault = Fault::kSolverFailed;
  out.limit = {LimitKind::kBackFlow, 2};
  out.lambda = 0.625;
  out.wanted_velocity_mps = {0.1, -0.2, 0.3};
  out.pump_pressure_pa = {20e6, 30e6};
  out.path_error_m = 0.05;
  sender.diagnosis = {1234, 17, 0xCAFEF00D, 0, {}};
  sender.call(kStartUs);
  const auto status_message = sender.sent<bus::EcuStatus>();
  assert_int_equal(status_message.mode.value, bus::EcuStatus::Mode::kActive);
  assert_int_equal(status_message.fault.value, bus::EcuStatus::Fault::kSolverFailed);
  assert_int_equal(status_message.limit_kind.value, bus::EcuStatus::LimitKind::kBackFlow);
  assert_int_equal(status_message.limit_index.value, 2);
  assert_near(status_message.lambda.value, 0.625, 1e-12);
  assert_int_equal(status_message.cycle_time_us.value, 1234);
  assert_int_equal(status_message.rejected_frames.value, 17);
  const auto identity = sender.sent<bus::EcuIdentity>();
  assert_int_equal(identity.profile_hash.value, 0xCAFEF00D);
  assert_int_equal(identity.dbc_version.value, bus::kDbcVersion);
  sender.call(kStartUs + 10'000);
  const auto motion = sender.sent<bus::EcuMotion>();
  assert_near(motion.boom_wanted_velocity_mps.value, 0.1, 1e-12);
  assert_near(motion.arm_wanted_velocity_mps.value, -0.2, 1e-12);
  assert_near(motion.bucket_wanted_velocity_mps.value, 0.3, 1e-12);
  const auto hydraulics = sender.sent<bus::EcuHydraulics>();
  assert_near(hydraulics.pump1_expected_pressure_pa.value, 20e6, 1e-3);
  assert_near(hydraulics.pump2_expected_pressure_pa.value, 30e6, 1e-3);
  assert_near(hydraulics.path_error_m.value, 0.05, 1e-12);
}

void status_saturates_or_says_error(void**) {
  Sender sender;
  sender.outputs.status.lambda = kNan;
  sender.outputs.status.mode = static_cast<EcuMode>(9);
  sender.diagnosis = {1'000'000, 100'000, 0, 0, {}};
  sender.call(kStartUs);
  auto message = sender.sent<bus::EcuStatus>();
  assert_int_equal(message.lambda.state, RawState::kError);
  assert_int_equal(message.mode.state, RawState::kError);
  assert_int_equal(message.cycle_time_us.value, 64255);
  assert_int_equal(message.rejected_frames.value, 250);
  sender.diagnosis = {-1, 0, 0, 0, {}};
  sender.call(kStartUs + 20'000);
  assert_int_equal(sender.sent<bus::EcuStatus>().cycle_time_us.value, 0);
  sender.diagnosis = {TimeUs{1} << 40, 0, 0, 0, {}};
  sender.call(kStartUs + 40'000);
  assert_int_equal(sender.sent<bus::EcuStatus>().cycle_time_us.value, 64255);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(periods),
      cmocka_unit_test(an_overrun_does_not_burst),
      cmocka_unit_test(a_clock_that_jumps_back_does_not_silence),
      cmocka_unit_test(frames_are_whole),
      cmocka_unit_test(protection),
      cmocka_unit_test(pump_protection),
      cmocka_unit_test(pilot_cut),
      cmocka_unit_test(swash),
      cmocka_unit_test(health),
      cmocka_unit_test(trouble_codes),
      cmocka_unit_test(status_names_every_fault),
      cmocka_unit_test(duty),
      cmocka_unit_test(a_duty_that_is_not_finite_stops_all),
      cmocka_unit_test(status),
      cmocka_unit_test(status_saturates_or_says_error),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
