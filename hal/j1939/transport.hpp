// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Messages of more than eight bytes by the transport protocol of SAE J1939-21: to all as BAM, to
/// one receiver by a connection (RTS, CTS), and BAM received.

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"

namespace graben::j1939 {

/// Trouble codes of a message, which need 70 bytes with the lamps; the longest one is DM24.
inline constexpr std::size_t kMostCodes = 17;
inline constexpr std::size_t kMostBytes = 72;
inline constexpr std::size_t kPacketBytes = 7;

/// 9 to kMostBytes bytes of a group.
struct LongMessage {
  std::uint32_t pgn = 0;
  std::uint16_t size = 0;
  std::array<std::uint8_t, kMostBytes> bytes{};

  [[nodiscard]] std::uint8_t packets() const {
    return static_cast<std::uint8_t>((size + kPacketBytes - 1) / kPacketBytes);
  }
};

/// Announces a message to all and sends its packets 60 ms apart (50 to 200 ms are allowed).
class BamSender {
 public:
  explicit BamSender(std::uint8_t own_address) : own_(own_address) {}

  /// Only while is_busy() is false: a sender has one of them at a time.
  void begin(const LongMessage& message);
  [[nodiscard]] bool is_busy() const { return is_busy_; }
  [[nodiscard]] std::uint32_t pgn() const { return message_.pgn; }
  /// To be called every 10 ms; true if `out` is to be sent.
  [[nodiscard]] bool due(TimeUs now, CanFrame& out);

 private:
  std::uint8_t own_;
  LongMessage message_;
  bool is_busy_ = false;
  std::uint8_t next_ = 0;  ///< Packet, from 1; 0: the announcement.
  TimeUs sent_us_ = 0;
};

/// Sends a message to one receiver, which says how many packets it takes and when it has all.
class ConnectionSender {
 public:
  explicit ConnectionSender(std::uint8_t own_address) : own_(own_address) {}

  /// Only while is_busy() is false.
  void begin(const LongMessage& message, std::uint8_t receiver);
  [[nodiscard]] bool is_busy() const { return state_ != State::kIdle; }
  /// A TP.CM of 8 bytes to us. Another sender's, of another group or of packets that there are not,
  /// changes nothing.
  void hear(const CanFrame& frame, TimeUs now);
  /// To be called every 10 ms; true if `out` is to be sent. A receiver that says nothing for 1.25 s
  /// ends the connection.
  [[nodiscard]] bool due(TimeUs now, CanFrame& out);

 private:
  enum class State : std::uint8_t { kIdle, kToBegin, kWaiting, kSending };

  std::uint8_t own_;
  LongMessage message_;
  std::uint8_t receiver_ = kNobody;
  State state_ = State::kIdle;
  std::uint8_t next_ = 1;   ///< Packet to be sent next,
  std::uint8_t until_ = 0;  ///< and the last one that the receiver takes.
  int clears_ = 0;          ///< That it has sent; more than 20 are not heard.
  TimeUs heard_us_ = 0;
  static constexpr std::uint8_t kNobody = 0xFE;
};

/// Puts BAM of one group and sender together. Packets that are missing, doubled or late, and sizes
/// that do not fit, end a message: nothing of it is used.
class BamReceiver {
 public:
  BamReceiver(std::uint32_t pgn, std::uint8_t sender) : pgn_(pgn), sender_(sender) {}

  /// True if `frame` was the last one of a message, which message() then is until the next call.
  [[nodiscard]] bool hear(const CanFrame& frame, TimeUs now);
  [[nodiscard]] const LongMessage& message() const { return message_; }

 private:
  std::uint32_t pgn_;
  std::uint8_t sender_;
  LongMessage message_;
  std::uint8_t next_ = 0;  ///< Packet that has to come; 0: none is under way.
  TimeUs heard_us_ = 0;
};

/// A trouble code as a frame of DM1 that has it alone, which is how a receiver of single codes
/// reads one of many. `at` counts from 0, below codes_of().
[[nodiscard]] std::size_t codes_of(const LongMessage& message);
[[nodiscard]] CanFrame single_code(const LongMessage& message, std::size_t at, std::uint8_t sender,
                                   TimeUs now);

}  // namespace graben::j1939
