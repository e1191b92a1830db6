// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A transmitter's table from functions that make messages.

#include <cstdint>

#include "hal/link/message_transmitter.hpp"
#include "hal/link/signal_rows.hpp"

namespace graben {

constexpr dbc::Physical physical(double value) { return {value, dbc::RawState::kValid}; }
constexpr dbc::Count count(std::uint32_t value) { return {value, dbc::RawState::kValid}; }

template <class Bus, class Own>
constexpr dbc::Coded<Bus> coded(Own own_code) {
  return {static_cast<Bus>(own_code), dbc::RawState::kValid};
}

/// A message that is sent: how, and what fills it in.
template <class From, class Sent, Sent (*make)(const From&, const EcuDiagnosis&)>
struct SendRow {
  using Outputs = From;
  using Message = Sent;
  static constexpr auto kMake = make;
  SendRule rule;
};

template <class Rows, class Row>
dbc::Payload encode(const typename Row::Outputs& outputs, const EcuDiagnosis& diagnosis) {
  return Rows::encode(Row::kMake(outputs, diagnosis));
}

/// `make` fills in the message, which only a machine with `part` sends.
template <class Outputs, class Message, Message (*make)(const Outputs&, const EcuDiagnosis&)>
constexpr SendRow<Outputs, Message, make> send_row(TimeUs phase_us, BusPart part = nullptr) {
  return {send_rule<Message>(phase_us, part)};
}

/// Encodes a trouble code.
using EncodeTrouble = dbc::Payload (*)(const Dm1Content&);

/// The table of a bus on which `rows` are sent, beside its DM1.
template <class First, class... Others>
constexpr auto send_table(std::uint32_t dm1_id, EncodeTrouble dm1, const First& first,
                          const Others&... others) {
  using Rows = SignalRows<dbc::MessageList<typename First::Message, typename Others::Message...>>;
  return SendTable<typename First::Outputs, 1 + sizeof...(Others)>{
      {first.rule, others.rule...}, {&encode<Rows, First>, &encode<Rows, Others>...}, dm1_id, dm1};
}

}  // namespace graben
