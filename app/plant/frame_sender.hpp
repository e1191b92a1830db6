// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Messages of the DBC to frames on a port, with counter and CRC where the DBC asks for them.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>

#include "app/plant/node_faults.hpp"
#include "can_dbc/codec.hpp"
#include "hal/can_port.hpp"
#include "hal/link/e2e.hpp"

namespace graben::plant {

/// A simulated node's way out, and where its frames are spoilt.
class FrameSender {
 public:
  /// `messages` are the DBC's: an array that outlives the sender.
  template <class Messages>
  FrameSender(CanPort& port, const Messages& messages)
      : port_(port), messages_(messages.data()), message_count_(messages.size()) {}

  /// A frame of another bus than the DBC's, as it is.
  void send_frame(CanFrame frame, const FrameFaults& faults, TimeUs now) {
    frame.stamp_us = now;
    if (faults.silent.count(frame.id) == 0) {
      put_in_time(frame, faults, now);
    }
  }

  /// The same of a message that several nodes send, each under its source address.
  template <class Message>
  void send_from(std::uint8_t address, const Message& message, const FrameFaults& faults,
                 TimeUs now) {
    static_assert(!Message::kProtected);
    CanFrame frame;
    frame.id = (Message::kId & ~std::uint32_t{0xFF}) | address;
    frame.length = Message::kLength;
    frame.data = message.encode();
    frame.stamp_us = now;
    if (faults.silent.count(frame.id) == 0) {
      put_in_time(frame, faults, now);
    }
  }

  template <class Message>
  void send(const Message& message, const FrameFaults& faults, TimeUs now) {
    if (faults.silent.count(Message::kId) != 0) {
      return;
    }
    CanFrame frame;
    frame.id = Message::kId;
    frame.length = Message::kLength;
    frame.data = message.encode();
    frame.stamp_us = now;
    if (Message::kProtected) {
      std::uint8_t& counter = counter_[Message::kId];
      e2e_protect(frame.data, data_id(Message::kId, Message::kDataId, faults), counter);
      if (faults.frozen_counter.count(Message::kId) == 0) {
        counter = e2e_next_counter(counter);
      }
    }
    put_in_time(frame, faults, now);
  }

  /// Sends what has been delayed for long enough; to be called every cycle.
  void send_late(const FrameFaults& faults, TimeUs now) {
    if (faults.delay_us <= 0) {
      late_.clear();
    }
    while (!late_.empty() && late_.front().first <= now) {
      put(late_.front().second);
      late_.pop_front();
    }
  }

  /// Frames that the port refused; they are not sent again.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  void put_in_time(const CanFrame& frame, const FrameFaults& faults, TimeUs now) {
    if (faults.delay_us > 0) {
      late_.push_back({now + faults.delay_us, frame});
    } else {
      put(frame);
    }
  }

  [[nodiscard]] std::uint16_t data_id(std::uint32_t id, std::uint16_t own,
                                      const FrameFaults& faults) const {
    if (!faults.swapped_data_ids) {
      return own;
    }
    const auto& [one, other] = *faults.swapped_data_ids;
    const std::uint32_t partner = id == one ? other : id == other ? one : id;
    for (std::size_t i = 0; i < message_count_; ++i) {
      if (messages_[i].id == partner) {
        return messages_[i].data_id;
      }
    }
    return own;
  }

  void put(const CanFrame& frame) {
    if (!port_.send(frame)) {
      ++dropped_;
    }
  }

  CanPort& port_;
  const dbc::MessageInfo* messages_;
  std::size_t message_count_;
  std::map<std::uint32_t, std::uint8_t> counter_;
  std::deque<std::pair<TimeUs, CanFrame>> late_;
  std::uint64_t dropped_ = 0;
};

}  // namespace graben::plant
