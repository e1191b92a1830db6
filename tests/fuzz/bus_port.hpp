// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A CAN port in memory that misbehaves as it is told and keeps what went through it.

#include <deque>
#include <map>
#include <vector>

#include "hal/can_port.hpp"

namespace graben::test {

/// What becomes of a frame between the controller and the bus; `last` is the one before it of the
/// same message, as the controller gave it. A canary links one that spoils it.
[[nodiscard]] CanFrame on_its_way(const CanFrame& frame, const CanFrame& last);

struct SentFrame {
  CanFrame frame;
  bool taken = false;  ///< The bus took it.
};

class ScriptedPort final : public CanPort {
 public:
  /// As many as a socket's buffer holds; what comes then is lost.
  static constexpr std::size_t kCapacity = 512;

  [[nodiscard]] bool open() override {
    pending_.clear();
    if (opens) {
      shown = CanPortState::kActive;
    }
    return opens;
  }
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override {
    if (next_shown != CanPortState::kActive) {
      shown = next_shown;
      next_shown = CanPortState::kActive;
    }
    int count = 0;
    for (; count < capacity && !pending_.empty(); ++count) {
      frames[count] = pending_.front();
      received.push_back(pending_.front());
      pending_.pop_front();
    }
    return count;
  }
  [[nodiscard]] bool send(const CanFrame& frame) override {
    const bool taken = !refuses_all && refuses == 0;
    refuses -= refuses > 0 ? 1 : 0;
    CanFrame& last = last_.try_emplace(frame.id, frame).first->second;
    sent.push_back({on_its_way(frame, last), taken});
    last = frame;
    return taken;
  }
  [[nodiscard]] CanPortState state() const override { return shown; }

  void put(const CanFrame& frame) {
    if (pending_.size() < kCapacity) {
      pending_.push_back(frame);
    }
  }

  /// Nothing more is in its way; it is for the controller to open it again, and what is queued
  /// stays.
  void mend() {
    next_shown = CanPortState::kActive;
    opens = true;
    refuses_all = false;
    refuses = 0;
  }

  CanPortState shown = CanPortState::kActive;
  CanPortState next_shown = CanPortState::kActive;  ///< Seen while receiving next; kActive: none.
  bool opens = true;
  bool refuses_all = false;
  int refuses = 0;  ///< So many frames are not taken.
  /// Since whoever looks has emptied them.
  std::vector<CanFrame> received;
  std::vector<SentFrame> sent;

 private:
  std::deque<CanFrame> pending_;
  std::map<std::uint32_t, CanFrame> last_;
};

}  // namespace graben::test
