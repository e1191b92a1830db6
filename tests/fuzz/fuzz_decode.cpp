// SPDX-License-Identifier: Apache-2.0
/// Every message of either DBC on any payload: what is decoded is a number and says the same once
/// it is encoded and decoded again.

#include <fmt/format.h>

#include <cmath>
#include <type_traits>

#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace graben::test {
namespace {

using dbc::RawState;

/// Name of a signal that comes back as another; a value out of range is sent as 'error', or as the
/// start value where there is no 'error'.
template <class Message>
const char* changed_signal(const dbc::Payload& payload) {
  const Message first = Message::decode(payload);
  const dbc::Payload sent = first.encode();
  const char* wrong = nullptr;
  Message::visit(first, [&](const dbc::Field& field, const auto& signal) {
    const std::uint32_t raw = dbc::extract(payload, field.start_bit, field.width);
    const std::uint32_t back = dbc::extract(sent, field.start_bit, field.width);
    auto again = signal;
    dbc::from_raw(field, back, again);
    bool good = true;
    if (signal.state == RawState::kValid) {
      good = back == raw && again.state == RawState::kValid && again.value == signal.value;
    } else if (signal.state == RawState::kOutOfRange) {
      good = back == dbc::refused_raw(field) && again.state != RawState::kOutOfRange;
    } else {
      good = again.state == signal.state;
    }
    if constexpr (std::is_floating_point_v<std::decay_t<decltype(signal.value)>>) {
      good = good && std::isfinite(signal.value);
    }
    wrong = good ? wrong : field.name;
  });
  // What belongs to no signal is 1.
  const bool stable = Message::decode(sent).encode() == sent;
  return wrong == nullptr && !stable ? Message::kName : wrong;
}

template <class... Messages>
const char* changed_signal(dbc::MessageList<Messages...>, const dbc::Payload& payload) {
  const char* wrong = nullptr;
  ((wrong = wrong == nullptr ? changed_signal<Messages>(payload) : wrong), ...);
  return wrong;
}

}  // namespace

std::string check_bytes(const std::uint8_t* data, std::size_t size) {
  const auto payload = raw_from_bytes<dbc::Payload>(data, size);
  const char* of_excavator = changed_signal(dbc::excavator::AllMessages{}, payload);
  const char* wrong =
      of_excavator != nullptr ? of_excavator : changed_signal(dbc::dozer::AllMessages{}, payload);
  return wrong == nullptr ? "" : fmt::format("{} does not come back", wrong);
}

bool inputs_are_numbers() { return false; }

std::vector<Bytes> seed_inputs() {
  return {Bytes(8, 0x00), Bytes(8, 0xFF), Bytes{0xFF, 0xFF, 0x00, 0x7D, 0xFE, 0xFE, 0xFF, 0xFA}};
}

}  // namespace graben::test
