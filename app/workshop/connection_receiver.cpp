// SPDX-License-Identifier: Apache-2.0
#include "app/workshop/connection_receiver.hpp"

#include <algorithm>

#include "hal/j1939/ids.hpp"

namespace graben::workshop {
namespace {

// Kinds of TP.CM (J1939-21, 5.10.3).
constexpr std::uint8_t kRequestToSend = 16;
constexpr std::uint8_t kClearToSend = 17;
constexpr std::uint8_t kEndOfMessage = 19;
constexpr std::uint8_t kAbort = 255;
constexpr std::uint8_t kNoResources = 2;

constexpr TimeUs kLateUs = 1250 * kMillisecondUs;  // T2: from a clear to send to its packets.

}  // namespace

CanFrame ConnectionReceiver::control(TimeUs now) const {
  CanFrame frame;
  frame.id = j1939::id_of(j1939::kTransportPriority, j1939::kConnectionPgn, sender_, own_);
  frame.length = 8;
  frame.stamp_us = now;
  frame.data = {to_say_,
                0xFF,
                0xFF,
                0xFF,
                0xFF,
                static_cast<std::uint8_t>(said_pgn_),
                static_cast<std::uint8_t>(said_pgn_ >> 8U),
                static_cast<std::uint8_t>(said_pgn_ >> 16U)};
  if (to_say_ == kClearToSend) {
    frame.data[1] = message_.packets();
    frame.data[2] = 1;
  } else if (to_say_ == kEndOfMessage) {
    frame.data[1] = static_cast<std::uint8_t>(message_.size);
    frame.data[2] = static_cast<std::uint8_t>(message_.size >> 8U);
    frame.data[3] = message_.packets();
  } else {
    frame.data[1] = kNoResources;
  }
  return frame;
}

void ConnectionReceiver::begin(const CanFrame& frame, TimeUs now) {
  const auto size = static_cast<std::uint16_t>(frame.data[1] | frame.data[2] << 8U);
  message_ = {};
  message_.pgn = pgn_;
  message_.size = size;
  const bool fits =
      size > frame.data.size() && size <= j1939::kMostBytes && frame.data[3] == message_.packets();
  next_ = fits ? 1 : 0;
  say(fits ? kClearToSend : kAbort, pgn_);
  heard_us_ = now;
}

bool ConnectionReceiver::hear(const CanFrame& frame, TimeUs now) {
  const j1939::Address from = j1939::address_of(frame.id);
  if (from.sender != sender_ || from.receiver != own_ || frame.length != frame.data.size()) {
    return false;
  }
  if (from.pgn == j1939::kConnectionPgn) {
    const std::uint32_t pgn = frame.data[5] | static_cast<std::uint32_t>(frame.data[6]) << 8U |
                              static_cast<std::uint32_t>(frame.data[7]) << 16U;
    if (pgn == pgn_ && frame.data[0] == kRequestToSend) {
      begin(frame, now);
    } else if (pgn == pgn_ && frame.data[0] == kAbort) {
      next_ = 0;
    } else if (frame.data[0] == kRequestToSend) {
      say(kAbort, pgn);
    }
    return false;
  }
  if (from.pgn != j1939::kDataTransferPgn || next_ == 0) {
    return false;
  }
  if (frame.data[0] != next_ || now - heard_us_ > kLateUs) {
    next_ = 0;
    say(kAbort, pgn_);
    return false;
  }
  heard_us_ = now;
  const std::size_t first = (next_ - 1U) * j1939::kPacketBytes;
  for (std::size_t i = 0; i < j1939::kPacketBytes && first + i < message_.size; ++i) {
    message_.bytes[first + i] = frame.data[1 + i];
  }
  if (next_ < message_.packets()) {
    ++next_;
    return false;
  }
  next_ = 0;
  say(kEndOfMessage, pgn_);
  return true;
}

std::optional<CanFrame> ConnectionReceiver::due(TimeUs now) {
  if (to_say_ == 0) {
    return std::nullopt;
  }
  const CanFrame frame = control(now);
  to_say_ = 0;
  return frame;
}

}  // namespace graben::workshop
