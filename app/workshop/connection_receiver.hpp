// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The receiving end of a connection of SAE J1939-21: what an ECU has to say to one tool alone.

#include <cstdint>
#include <optional>

#include "hal/can_frame.hpp"
#include "hal/j1939/transport.hpp"

namespace graben::workshop {

/// Takes a message of one group from one sender. All its packets are asked for at once; one that is
/// missing, doubled or late, and a size that does not fit, end it: nothing of it is used. One of
/// another group, which nobody has asked for or waits for any more, is refused at once.
class ConnectionReceiver {
 public:
  ConnectionReceiver(std::uint32_t pgn, std::uint8_t sender, std::uint8_t own_address)
      : pgn_(pgn), sender_(sender), own_(own_address) {}

  /// True if `frame` was the last one of a message, which message() then is.
  [[nodiscard]] bool hear(const CanFrame& frame, TimeUs now);
  [[nodiscard]] const j1939::LongMessage& message() const { return message_; }
  /// What is to be sent because of what was heard.
  [[nodiscard]] std::optional<CanFrame> due(TimeUs now);

 private:
  void begin(const CanFrame& frame, TimeUs now);
  [[nodiscard]] CanFrame control(TimeUs now) const;
  void say(std::uint8_t kind, std::uint32_t pgn) {
    to_say_ = kind;
    said_pgn_ = pgn;
  }

  std::uint32_t pgn_;
  std::uint8_t sender_;
  std::uint8_t own_;
  j1939::LongMessage message_;
  std::uint8_t next_ = 0;  ///< Packet that has to come; 0: none is under way.
  TimeUs heard_us_ = 0;
  std::uint8_t to_say_ = 0;  ///< Kind of TP.CM that is due; 0: none.
  std::uint32_t said_pgn_ = 0;
};

}  // namespace graben::workshop
