// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A receiver's table from the types of its messages.

#include "firmware/signals/signal.hpp"
#include "hal/link/message_receiver.hpp"

namespace graben {

constexpr Validity validity_of(dbc::RawState state) {
  switch (state) {
    case dbc::RawState::kValid:
      return Validity::kValid;
    case dbc::RawState::kError:
      return Validity::kError;
    case dbc::RawState::kNotAvailable:
      return Validity::kNotAvailable;
    case dbc::RawState::kOutOfRange:
      break;
  }
  return Validity::kOutOfRange;
}

/// The codec gives 0 for what is not valid, so that nobody goes on with the last good value.
template <class T, class Raw>
void put(Signal<T>& signal, const Raw& raw, TimeUs now) {
  signal.validity = validity_of(raw.state);
  signal.value = static_cast<T>(raw.value);
  signal.stamp_us = now;
}

/// True if every value is one that its signal may have.
template <class Message>
bool in_range(const Message& message) {
  bool all = true;
  Message::visit(message, [&all](const dbc::Field&, const auto& signal) {
    all = all && signal.state != dbc::RawState::kOutOfRange;
  });
  return all;
}

/// Decodes and stores a payload; false, and nothing stored, if a value is out of range.
/// `Store::is_ours` says whether this kind of machine can be meant by what is in range;
/// `Store::store` puts the signals into their places, `Store::part` says what part of a machine a
/// message belongs to.
template <class Inputs, class Store, class Message>
bool decode(const dbc::Payload& payload, TimeUs now, Received<Inputs>& to) {
  const Message message = Message::decode(payload);
  const bool usable = in_range(message) && Store::is_ours(message);
  if (usable) {
    Store::store(message, now, to);
  }
  return usable;
}

/// The table of a bus of which `Own` and `Common` are received.
template <class Inputs, class Store, class... Own, class... Common, std::size_t all_count>
constexpr auto receive_table(dbc::MessageList<Own...>, dbc::MessageList<Common...>,
                             const std::array<dbc::MessageInfo, all_count>& all,
                             std::uint8_t dbc_version) {
  return ReceiveTable<Inputs, sizeof...(Own) + sizeof...(Common)>{
      {message_rule<Own>(Store::part(Own{}))..., message_rule<Common>(Store::part(Common{}))...},
      {&decode<Inputs, Store, Own>..., &decode<Inputs, Store, Common>...},
      all.data(),
      all_count,
      dbc_version};
}

}  // namespace graben
