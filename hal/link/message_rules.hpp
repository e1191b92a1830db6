// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Rules of the messages of a bus: which of them a machine has, how each is received and sent.

#include <array>
#include <cstddef>
#include <cstdint>

#include "can_dbc/codec.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/e2e.hpp"

namespace graben {

/// J1939 source addresses of sensors on boom, arm, bucket and platform; 0: there is none.
using ImuAddresses = std::array<std::uint8_t, 4>;

struct BusTable;

/// Parts that not every machine of a kind has and that bring messages of their own.
struct BusParts {
  bool swing_drive = false;
  ImuAddresses imu{};
  /// The machine's end speaks our DBC, and so does its engine; without, a table says what it sends.
  bool own_machine = true;
  bool own_engine = true;
  const BusTable* table = nullptr;  ///< Another bus than ours, or one beside it; null: none.
  bool second_strokes = false;      ///< Second sensors of cylinders.
  bool second_swing = false;        ///< One of the swing.
};

/// The part that a message belongs to; null: a message of every machine of its kind.
using BusPart = bool BusParts::*;

constexpr bool has_part(const BusParts& parts, BusPart part) {
  return part == nullptr || parts.*part;
}

/// How a message that is received is known and protected.
struct MessageRule {
  std::uint32_t id = 0;  ///< Known by PGN and source address (identity_of).
  std::uint8_t length = 0;
  bool is_protected = false;
  E2eConfig e2e;
  BusPart part = nullptr;  ///< Taken only by a machine that has it.
  bool extended = true;    ///< 29 bits; else the id has 11.
};

/// One cycle more than the counter may skip: then the counter alone would refuse the frame, and it
/// is far below the 15 cycles after which it would not.
template <class Message>
constexpr MessageRule message_rule(BusPart part) {
  constexpr TimeUs kMaxSilenceUs =
      (Message::kMaxDeltaCounter + 1) * Message::kCycleTimeMs * kMillisecondUs;
  return {Message::kId, Message::kLength, Message::kProtected,
          E2eConfig{Message::kDataId, Message::kMaxDeltaCounter, kMaxSilenceUs,
                    Message::kCycleTimeMs * kMillisecondUs},
          part};
}

/// A message of a bus, whoever it is for: whose it is, and what protects it.
struct BusMessage {
  std::uint32_t id = 0;
  std::uint16_t data_id = 0;
  bool is_protected = false;
};

template <std::size_t count>
constexpr std::array<BusMessage, count> bus_messages(
    const std::array<dbc::MessageInfo, count>& infos) {
  std::array<BusMessage, count> messages{};
  for (std::size_t n = 0; n < count; ++n) {
    messages[n] = {infos[n].id, infos[n].data_id, infos[n].is_protected};
  }
  return messages;
}
/// Of a database's list `infos`, without the names in it, which no controller asks for.
template <const auto& infos>
inline constexpr auto kBusMessages = bus_messages(infos);

/// The rules of a receiver, and all messages of its bus; both have to outlive what uses them.
struct MessageRules {
  const MessageRule* rule = nullptr;
  std::size_t count = 0;
  const BusMessage* all = nullptr;
  std::size_t all_count = 0;
};

/// The controller's source address: the low byte of the id of all that it sends. A frame of its own
/// that it hears is another controller's.
inline constexpr std::uint8_t kOwnAddress = 130;

/// A node of CANopen that is to be told to start; none: id 0.
struct NodeStart {
  std::uint8_t id = 0;
  std::uint8_t bus = kAnyBus;
};

/// A node of CANopen that has told an emergency and has not taken it back; none: id 0.
struct NodeEmergency {
  std::uint8_t id = 0;
  std::uint16_t code = 0;  ///< CiA 301's error code.
};

inline constexpr TimeUs kControlPeriod_us = 10 * kMillisecondUs;

/// How a message is sent.
struct SendRule {
  std::uint32_t id = 0;
  TimeUs period_us = 0;
  TimeUs phase_us = 0;  ///< Spreads the load: no cycle sends all.
  bool is_protected = false;
  std::uint16_t data_id = 0;
  BusPart part = nullptr;  ///< Sent only by a machine that has it.
};

template <class Message>
constexpr SendRule send_rule(TimeUs phase_us, BusPart part) {
  static_assert(Message::kLength == 8);
  return {Message::kId,     Message::kCycleTimeMs * kMillisecondUs,
          phase_us,         Message::kProtected,
          Message::kDataId, part};
}

}  // namespace graben
