// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A receiver's table from the types of its messages.

#include "firmware/signals/signal.hpp"
#include "hal/link/message_receiver.hpp"
#include "hal/link/signal_rows.hpp"

namespace graben {

/// The two have the same order, the other way round: a difference, and no table to look it up in.
constexpr Validity validity_of(dbc::RawState state) {
  return static_cast<Validity>(static_cast<unsigned>(Validity::kValid) -
                               static_cast<unsigned>(state));
}
static_assert(validity_of(dbc::RawState::kValid) == Validity::kValid);
static_assert(validity_of(dbc::RawState::kOutOfRange) == Validity::kOutOfRange);
static_assert(validity_of(dbc::RawState::kError) == Validity::kError);
static_assert(validity_of(dbc::RawState::kNotAvailable) == Validity::kNotAvailable);

/// The codec gives 0 for what is not valid, so that nobody goes on with the last good value.
template <class T, class Raw>
void put(Signal<T>& signal, const Raw& raw, TimeUs now) {
  signal.validity = validity_of(raw.state);
  signal.value = static_cast<T>(raw.value);
  signal.stamp_us = now;
}

/// Decodes and stores a payload; false, and nothing stored, if a value is out of range.
/// `Store::is_ours` says whether this kind of machine can be meant by what is in range;
/// `Store::store` puts the signals into their places, `Store::part` says what part of a machine a
/// message belongs to.
template <class Inputs, class Store, class Rows, class Message>
bool decode(const dbc::Payload& payload, TimeUs now, Received<Inputs>& to) {
  UnreadMessage<Message> read;
  const bool usable = Rows::decode(payload, read.message) && Store::is_ours(read.message);
  if (usable) {
    Store::store(read.message, now, to);
  }
  return usable;
}

/// The table of a bus of which `Own` and `Common` are received.
template <class Inputs, class Store, class... Own, class... Common, std::size_t all_count>
constexpr auto receive_table(dbc::MessageList<Own...>, dbc::MessageList<Common...>,
                             const std::array<BusMessage, all_count>& all,
                             std::uint8_t dbc_version) {
  using Rows = SignalRows<dbc::MessageList<Own..., Common...>>;
  return ReceiveTable<Inputs, sizeof...(Own) + sizeof...(Common)>{
      {message_rule<Own>(Store::part(Own{}))..., message_rule<Common>(Store::part(Common{}))...},
      {&decode<Inputs, Store, Rows, Own>..., &decode<Inputs, Store, Rows, Common>...},
      all.data(),
      all_count,
      dbc_version};
}

}  // namespace graben
