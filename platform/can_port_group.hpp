// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Several buses as one: what any of them brings is received with that bus's number, what is sent
/// goes to the bus that it is for, or to all.

#include <array>
#include <cstddef>

#include "hal/can_port.hpp"

namespace graben {

/// Up to kMost ports, which the caller owns. A machine with its sensors on one bus and its valves
/// on another needs no table of which is where. A message must come on one of them only: two copies
/// of one stream, a moment apart, look like two senders.
// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor): final, and CanPort deletes nothing.
class CanPortGroup final : public CanPort {
 public:
  static constexpr std::size_t kMost = 4;

  /// False, and nothing changed, if there is no room.
  bool add(CanPort& port) {
    if (count_ == kMost) {
      return false;
    }
    ports_[count_++] = &port;
    return true;
  }

  /// True if every port opened.
  [[nodiscard]] bool open() override {
    bool all = count_ > 0;
    for (std::size_t i = 0; i < count_; ++i) {
      all = ports_[i]->open() && all;
    }
    return all;
  }

  /// Begins with another port each time, so that a flood on one does not starve the others.
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override {
    int taken = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t bus = (first_ + i) % count_;
      const int came = ports_[bus]->receive(frames + taken, capacity - taken);
      for (int n = taken; n < taken + came; ++n) {
        frames[n].bus = static_cast<std::uint8_t>(bus);
      }
      taken += came;
    }
    first_ = count_ > 0 ? (first_ + 1) % count_ : 0;
    return taken;
  }

  /// True if every port that it is for took it; false if there is none.
  [[nodiscard]] bool send(const CanFrame& frame) override {
    if (frame.bus != kAnyBus) {
      return frame.bus < count_ && ports_[frame.bus]->send(frame);
    }
    bool all = count_ > 0;
    for (std::size_t i = 0; i < count_; ++i) {
      all = ports_[i]->send(frame) && all;
    }
    return all;
  }

  /// The worst of all: any bus that is lost stops the machine. kClosed without ports.
  [[nodiscard]] CanPortState state() const override {
    CanPortState worst = count_ > 0 ? CanPortState::kActive : CanPortState::kClosed;
    for (std::size_t i = 0; i < count_; ++i) {
      const CanPortState state = ports_[i]->state();
      if (badness(state) > badness(worst)) {
        worst = state;
      }
    }
    return worst;
  }

 private:
  static int badness(CanPortState state) {
    switch (state) {
      case CanPortState::kActive:
        return 0;
      case CanPortState::kErrorPassive:
        return 1;
      case CanPortState::kBusOff:
        return 2;
      case CanPortState::kDown:
        return 3;
      case CanPortState::kClosed:
        break;
    }
    return 4;
  }

  std::array<CanPort*, kMost> ports_{};
  std::size_t count_ = 0;
  std::size_t first_ = 0;
};

}  // namespace graben
