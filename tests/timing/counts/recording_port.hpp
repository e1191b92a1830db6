// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Between a controller and its port: notes what passes, as a trace needs it.

#include "hal/can_port.hpp"
#include "tests/timing/counts/trace.hpp"

namespace graben::timing {

// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor): final, and CanPort deletes nothing.
class RecordingPort final : public CanPort {
 public:
  explicit RecordingPort(CanPort& port) : port_(port) {}

  /// Of the cycle that has just been; the next one begins empty.
  [[nodiscard]] TraceCycle take() {
    const TraceCycle taken = cycle_;
    cycle_ = {};
    sent_ = 0;
    return taken;
  }

  [[nodiscard]] bool open() override {
    const bool opened = port_.open();
    if (cycle_.opens < TraceCycle::kMostAnswers) {
      cycle_.opened[static_cast<unsigned>(cycle_.opens++)] = opened;
    }
    return opened;
  }
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override {
    const int count = port_.receive(frames, capacity);
    for (int i = 0; i < count && cycle_.frames < TraceCycle::kMostFrames; ++i) {
      cycle_.frame[static_cast<unsigned>(cycle_.frames++)] = frames[i];
    }
    return count;
  }
  [[nodiscard]] bool send(const CanFrame& frame) override {
    const bool taken = port_.send(frame);
    cycle_.refused |= taken ? 0U : 1U << static_cast<unsigned>(sent_);
    ++sent_;
    return taken;
  }
  [[nodiscard]] CanPortState state() const override {
    const CanPortState state = port_.state();
    if (cycle_.states < TraceCycle::kMostAnswers) {
      cycle_.state[static_cast<unsigned>(cycle_.states++)] = state;
    }
    return state;
  }

 private:
  CanPort& port_;
  mutable TraceCycle cycle_;
  int sent_ = 0;
};

}  // namespace graben::timing
