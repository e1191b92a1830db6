// SPDX-License-Identifier: Apache-2.0
#include "hal/j1939/transport.hpp"

#include <algorithm>

#include "hal/j1939/ids.hpp"

namespace graben::j1939 {
namespace {

constexpr std::uint8_t kRequestToSend = 16;
constexpr std::uint8_t kClearToSend = 17;
constexpr std::uint8_t kEndOfMessage = 19;
constexpr std::uint8_t kAnnounce = 32;
constexpr std::uint8_t kAbort = 255;
constexpr std::uint8_t kTimeoutReason = 3;
constexpr std::uint8_t kNoValue = 0xFF;

constexpr TimeUs kBamGapUs = 60 * kMillisecondUs;
constexpr TimeUs kBamLateUs = 750 * kMillisecondUs;          // T1
constexpr TimeUs kConnectionLateUs = 1250 * kMillisecondUs;  // T3
constexpr TimeUs kSlackUs = 5 * kMillisecondUs;              // A call may come early by that.
constexpr int kMostClears = 20;

void put_pgn(CanFrame& frame, std::uint32_t pgn) {
  frame.data[5] = static_cast<std::uint8_t>(pgn);
  frame.data[6] = static_cast<std::uint8_t>(pgn >> 8U);
  frame.data[7] = static_cast<std::uint8_t>(pgn >> 16U);
}

std::uint32_t pgn_of(const CanFrame& frame) {
  return frame.data[5] | static_cast<std::uint32_t>(frame.data[6]) << 8U |
         static_cast<std::uint32_t>(frame.data[7]) << 16U;
}

CanFrame connection_frame(std::uint8_t control, std::uint8_t receiver, std::uint8_t own,
                          const LongMessage& message, TimeUs now) {
  CanFrame frame;
  frame.id = id_of(kTransportPriority, kConnectionPgn, receiver, own);
  frame.length = 8;
  frame.stamp_us = now;
  frame.data = {control, static_cast<std::uint8_t>(message.size),
                static_cast<std::uint8_t>(message.size >> 8U), message.packets(), kNoValue};
  put_pgn(frame, message.pgn);
  return frame;
}

CanFrame packet(std::uint8_t number, std::uint8_t receiver, std::uint8_t own,
                const LongMessage& message, TimeUs now) {
  CanFrame frame;
  frame.id = id_of(kTransportPriority, kDataTransferPgn, receiver, own);
  frame.length = 8;
  frame.stamp_us = now;
  frame.data.fill(kNoValue);
  frame.data[0] = number;
  const std::size_t first = (number - 1U) * kPacketBytes;
  for (std::size_t i = 0; i < kPacketBytes && first + i < message.size; ++i) {
    frame.data[1 + i] = message.bytes[first + i];
  }
  return frame;
}

}  // namespace

void BamSender::begin(const LongMessage& message) {
  message_ = message;
  is_busy_ = true;
  next_ = 0;
}

bool BamSender::due(TimeUs now, CanFrame& out) {
  const bool has_waited = now < sent_us_ || now - sent_us_ >= kBamGapUs - kSlackUs;
  if (!is_busy_ || (next_ > 0 && !has_waited)) {
    return false;
  }
  out = next_ == 0 ? connection_frame(kAnnounce, kGlobalAddress, own_, message_, now)
                   : packet(next_, kGlobalAddress, own_, message_, now);
  sent_us_ = now;
  is_busy_ = next_ < message_.packets();
  ++next_;
  return true;
}

void ConnectionSender::begin(const LongMessage& message, std::uint8_t receiver) {
  message_ = message;
  receiver_ = receiver;
  state_ = State::kToBegin;
  clears_ = 0;
}

void ConnectionSender::hear(const CanFrame& frame, TimeUs now) {
  const Address from = address_of(frame.id);
  const bool is_ours = is_busy() && state_ != State::kToBegin && from.receiver == own_ &&
                       from.sender == receiver_ && pgn_of(frame) == message_.pgn;
  if (!is_ours) {
    return;
  }
  if (frame.data[0] == kAbort || frame.data[0] == kEndOfMessage) {
    state_ = State::kIdle;
    return;
  }
  const std::uint8_t count = frame.data[1];
  const std::uint8_t first = frame.data[2];
  // Who holds on, or asks again, without end keeps nobody else waiting.
  if (frame.data[0] != kClearToSend || ++clears_ > kMostClears) {
    return;
  }
  heard_us_ = now;
  if (count == 0) {  // It holds on.
    state_ = State::kWaiting;
  } else if (first >= 1 && first <= message_.packets()) {
    next_ = first;
    until_ = static_cast<std::uint8_t>(std::min<int>(first + count - 1, message_.packets()));
    state_ = State::kSending;
  }
}

bool ConnectionSender::due(TimeUs now, CanFrame& out) {
  switch (state_) {
    case State::kIdle:
      return false;
    case State::kToBegin:
      out = connection_frame(kRequestToSend, receiver_, own_, message_, now);
      state_ = State::kWaiting;
      heard_us_ = now;
      return true;
    case State::kSending:
      out = packet(next_, receiver_, own_, message_, now);
      heard_us_ = now;
      state_ = next_ == until_ ? State::kWaiting : State::kSending;
      ++next_;
      return true;
    case State::kWaiting:
      break;
  }
  if (now - heard_us_ < kConnectionLateUs) {
    return false;
  }
  out = connection_frame(kAbort, receiver_, own_, message_, now);
  out.data[1] = kTimeoutReason;
  out.data[2] = out.data[3] = kNoValue;
  state_ = State::kIdle;
  return true;
}

bool BamReceiver::hear(const CanFrame& frame, TimeUs now) {
  const Address from = address_of(frame.id);
  if (!frame.extended || frame.length != 8 || from.sender != sender_ ||
      from.receiver != kGlobalAddress) {
    return false;
  }
  if (from.pgn == kConnectionPgn && frame.data[0] == kAnnounce) {
    LongMessage begun;
    begun.pgn = pgn_of(frame);
    begun.size = static_cast<std::uint16_t>(frame.data[1] | frame.data[2] << 8U);
    const bool fits = begun.pgn == pgn_ && begun.size > 8 && begun.size <= kMostBytes &&
                      begun.packets() == frame.data[3];
    // Whatever it is, what was under way is over: a sender has one at a time.
    message_ = begun;
    next_ = fits ? 1 : 0;
    heard_us_ = now;
    return false;
  }
  if (from.pgn != kDataTransferPgn || next_ == 0) {
    return false;
  }
  if (frame.data[0] != next_ || now - heard_us_ > kBamLateUs) {
    next_ = 0;
    return false;
  }
  const std::size_t first = (next_ - 1U) * kPacketBytes;
  for (std::size_t i = 0; i < kPacketBytes && first + i < message_.size; ++i) {
    message_.bytes[first + i] = frame.data[1 + i];
  }
  heard_us_ = now;
  const bool is_last = next_ == message_.packets();
  next_ = is_last ? 0 : static_cast<std::uint8_t>(next_ + 1U);
  return is_last;
}

std::size_t codes_of(const LongMessage& message) { return (message.size - 2U) / 4U; }

CanFrame single_code(const LongMessage& message, std::size_t at, std::uint8_t sender, TimeUs now) {
  CanFrame frame;
  frame.id = id_of(kDiagnosticPriority, message.pgn, kGlobalAddress, sender);
  frame.length = 8;
  frame.stamp_us = now;
  frame.data.fill(kNoValue);
  frame.data[0] = message.bytes[0];
  frame.data[1] = message.bytes[1];
  for (std::size_t i = 0; i < 4; ++i) {
    frame.data[2 + i] = message.bytes[2 + 4 * at + i];
  }
  return frame;
}

}  // namespace graben::j1939
