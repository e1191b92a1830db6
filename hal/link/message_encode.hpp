// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A transmitter's table from functions that make messages.

#include <cstdint>

#include "hal/link/message_transmitter.hpp"

namespace graben {

constexpr dbc::Physical physical(double value) { return {value, dbc::RawState::kValid}; }
constexpr dbc::Count count(std::uint32_t value) { return {value, dbc::RawState::kValid}; }

template <class Bus, class Own>
constexpr dbc::Coded<Bus> coded(Own own_code) {
  return {static_cast<Bus>(own_code), dbc::RawState::kValid};
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

/// Encodes a trouble code.
using EncodeTrouble = dbc::Payload (*)(const Dm1Content&);

/// The table of a bus on which `rows` are sent, beside its DM1.
template <class Outputs, class... Rows>
constexpr auto send_table(std::uint32_t dm1_id, EncodeTrouble dm1, const SendRow<Outputs>& first,
                          const Rows&... rows) {
  return SendTable<Outputs, 1 + sizeof...(Rows)>{
      {first.rule, rows.rule...}, {first.encode, rows.encode...}, dm1_id, dm1};
}

}  // namespace graben
