#pragma once
/// How a transmitter's table comes of functions that make messages, and what every kind's bus
/// carries.

#include <cstdint>

#include "firmware/signals/machine_signals.hpp"
#include "hal/link/message_transmitter.hpp"

namespace graben {

constexpr dbc::Physical physical(double value) { return {value, dbc::RawState::kValid}; }
constexpr dbc::Count count(std::uint32_t value) { return {value, dbc::RawState::kValid}; }

template <class Bus, class Own>
constexpr dbc::Coded<Bus> coded(Own own_code) {
  return {static_cast<Bus>(own_code), dbc::RawState::kValid};
}

constexpr std::uint32_t non_negative(TimeUs time_us) {
  const TimeUs low = time_us < 0 ? 0 : time_us;
  return low > UINT32_MAX ? UINT32_MAX : static_cast<std::uint32_t>(low);
}

/// Said whatever else is, Off, On or 'not available'; `outputs` are a controller's.
template <class SpoolCommand, class Outputs>
void set_pilot_cut(SpoolCommand& message, const Outputs& outputs) {
  using PilotCut = typename SpoolCommand::PilotCut;
  if (!outputs.pilot_known) {
    message.pilot_cut.state = dbc::RawState::kNotAvailable;
  } else if (outputs.pilot_cut) {
    message.pilot_cut = coded<PilotCut>(PilotCut::kOn);
  }
}

template <class EcuStatus, class Outputs>
EcuStatus ecu_status(const Outputs& outputs, const EcuDiagnosis& diagnosis) {
  const MachineStatus& status = outputs.status;
  EcuStatus message;
  message.mode = coded<typename EcuStatus::Mode>(status.mode);
  message.limit_kind = coded<typename EcuStatus::LimitKind>(status.limit.kind);
  message.limit_index = count(status.limit.index);
  message.lambda = physical(status.lambda);
  message.fault = coded<typename EcuStatus::Fault>(status.fault);
  message.cycle_time_us = count(non_negative(diagnosis.cycle_time_us));
  message.rejected_frames = count(diagnosis.rejected_frames);
  return message;
}

template <class EcuIdentity, std::uint8_t dbc_version, class Outputs>
EcuIdentity ecu_identity(const Outputs&, const EcuDiagnosis& diagnosis) {
  EcuIdentity message;
  message.profile_hash = count(diagnosis.profile_hash);
  message.dbc_version = count(dbc_version);
  return message;
}

template <class EcuHealth, class Outputs>
EcuHealth ecu_health(const Outputs& outputs, const EcuDiagnosis& diagnosis) {
  const ProcessHealth& process = diagnosis.process;
  const MachineStatus& status = outputs.status;
  EcuHealth message;
  message.why_not_armed = count(status.why_not_armed);
  message.allocations = count(process.allocations);
  message.page_faults = count(process.page_faults);
  message.overruns = count(process.overruns);
  message.dropped_frames = count(diagnosis.dropped_frames);
  message.stand_in = coded<typename EcuHealth::StandIn>(status.stand_in ? 1 : 0);
  message.real_time = coded<typename EcuHealth::RealTime>(process.real_time ? 1 : 0);
  return message;
}

static_assert(kDm1FirstSpn + kFaultCount <= 524288U);

template <class Trouble>
dbc::Payload encode_trouble(const Dm1Content& content) {
  Trouble message;
  message.amber_warning_lamp =
      coded<typename Trouble::AmberWarningLamp>(content.amber_warning ? 1 : 0);
  message.red_stop_lamp = coded<typename Trouble::RedStopLamp>(content.red_stop ? 1 : 0);
  message.spn_low = count(content.spn & 0xFFFFU);
  message.spn_high = count(content.spn >> 16U);
  message.fmi = count(content.fmi);
  message.occurrence_count = count(content.occurrences);
  return message.encode();
}

/// A message that is sent: how, and what makes its payload.
template <class Outputs>
struct SendRow {
  SendRule rule;
  typename SendTable<Outputs, 1>::Encode encode = nullptr;
};

template <class Outputs, auto make>
dbc::Payload encode(const Outputs& outputs, const EcuDiagnosis& diagnosis) {
  return make(outputs, diagnosis).encode();
}

/// `make` fills in the message, which only a machine with `part` sends.
template <class Outputs, class Message, Message (*make)(const Outputs&, const EcuDiagnosis&)>
constexpr SendRow<Outputs> send_row(TimeUs phase_us, BusPart part = nullptr) {
  return {send_rule<Message>(phase_us, part), &encode<Outputs, make>};
}

/// The table of a bus on which `rows` are sent, beside its DM1 `Trouble`.
template <class Trouble, class Outputs, class... Rows>
constexpr auto send_table(const SendRow<Outputs>& first, const Rows&... rows) {
  return SendTable<Outputs, 1 + sizeof...(Rows)>{{first.rule, rows.rule...},
                                                 {first.encode, rows.encode...},
                                                 Trouble::kId,
                                                 &encode_trouble<Trouble>};
}

}  // namespace graben
