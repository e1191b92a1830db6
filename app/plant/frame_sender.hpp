#pragma once
/// Messages of the DBC to frames on a port, with counter and CRC where the DBC asks for them.

#include <cstdint>
#include <map>
#include <set>

#include "can_dbc/codec.hpp"
#include "hal/can_port.hpp"
#include "hal/e2e.hpp"

namespace graben::plant {

/// A simulated node's way out. A silenced message is not sent and its counter stands still, as if
/// its sender had stopped.
class FrameSender {
 public:
  explicit FrameSender(CanPort& port) : port_(port) {}

  void set_silent(std::uint32_t id, bool silent) {
    if (silent) {
      silent_.insert(id);
    } else {
      silent_.erase(id);
    }
  }

  template <class Message>
  void send(const Message& message, TimeUs now) {
    if (silent_.count(Message::kId) != 0) {
      return;
    }
    CanFrame frame;
    frame.id = Message::kId;
    frame.length = Message::kLength;
    frame.data = message.encode();
    frame.stamp_us = now;
    if (Message::kProtected) {
      std::uint8_t& counter = counter_[Message::kId];
      e2e_protect(frame.data, Message::kDataId, counter);
      counter = e2e_next_counter(counter);
    }
    if (!port_.send(frame)) {
      ++dropped_;
    }
  }

  /// Frames that the port refused; they are not sent again.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  CanPort& port_;
  std::set<std::uint32_t> silent_;
  std::map<std::uint32_t, std::uint8_t> counter_;
  std::uint64_t dropped_ = 0;
};

}  // namespace graben::plant
