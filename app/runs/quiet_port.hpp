// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The way of a simulated machine's frames to its bus, for cycles that were late.

#include "hal/can_port.hpp"

namespace graben::runs {

/// A port, whose owner keeps it, that can be told to lose what is sent. A process that the
/// scheduler left out for some cycles lives them all the same, and nobody hears it: a sender whose
/// counters stood still meanwhile looks like one whose frames wait in a queue
/// (hal/link/message_clock.hpp), and all of them at once would be a burst of old frames.
// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor): final, and CanPort deletes nothing.
class QuietPort final : public CanPort {
 public:
  explicit QuietPort(CanPort& port) : port_(port) {}

  void set_quiet(bool quiet) { quiet_ = quiet; }

  [[nodiscard]] bool open() override { return port_.open(); }
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override {
    return port_.receive(frames, capacity);
  }
  [[nodiscard]] bool send(const CanFrame& frame) override { return quiet_ || port_.send(frame); }
  [[nodiscard]] CanPortState state() const override { return port_.state(); }

 private:
  CanPort& port_;
  bool quiet_ = false;
};

}  // namespace graben::runs
