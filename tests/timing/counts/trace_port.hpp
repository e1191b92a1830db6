// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A port that does what a trace says.

#include <algorithm>

#include "hal/can_port.hpp"
#include "tests/timing/counts/trace.hpp"

namespace graben::timing {

// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor): final, and CanPort deletes nothing.
class TracePort final : public CanPort {
 public:
  /// Of the caller, who keeps it until the cycle is over.
  void begin(const TraceCycle& cycle) {
    cycle_ = &cycle;
    states_ = opens_ = sent_ = taken_ = 0;
  }

  [[nodiscard]] bool open() override {
    const int at = opens_++;
    return at < cycle_->opens && cycle_->opened[static_cast<unsigned>(at)];
  }
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override {
    const int count = std::min(capacity, cycle_->frames - taken_);
    std::copy_n(cycle_->frame.begin() + taken_, count, frames);
    taken_ += count;
    return count;
  }
  [[nodiscard]] bool send(const CanFrame& frame) override {
    last_ = frame;
    return ((cycle_->refused >> static_cast<unsigned>(sent_++)) & 1U) == 0U;
  }
  [[nodiscard]] CanPortState state() const override {
    const int at = std::min(states_++, cycle_->states - 1);
    return at < 0 ? CanPortState::kClosed : cycle_->state[static_cast<unsigned>(at)];
  }

 private:
  const TraceCycle* cycle_ = nullptr;
  CanFrame last_;
  mutable int states_ = 0;
  int opens_ = 0;
  int sent_ = 0;
  int taken_ = 0;
};

}  // namespace graben::timing
