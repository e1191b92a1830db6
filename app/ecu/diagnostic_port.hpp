// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The controller's port with a workshop's tool on the same bus: what is asked of us is heard
/// beside the node, and what it sends as DM1 is held until the cycle's faults are known.

#include "hal/can_port.hpp"
#include "hal/j1939/diagnostics.hpp"

namespace graben::ecu {

class DiagnosticPort : public CanPort {
 public:
  /// Both outlive it.
  DiagnosticPort(CanPort& port, j1939::Diagnostics& diagnostics)
      : port_(port), diagnostics_(diagnostics) {}

  [[nodiscard]] bool open() override { return port_.open(); }
  [[nodiscard]] CanPortState state() const override { return port_.state(); }
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override {
    const int count = port_.receive(frames, capacity);
    for (int i = 0; i < count; ++i) {
      diagnostics_.hear(frames[i], now_us_);
    }
    return count;
  }
  [[nodiscard]] bool send(const CanFrame& frame) override {
    return diagnostics_.holds(frame) || port_.send(frame);
  }

  /// Before a cycle.
  void begin(TimeUs now_us) { now_us_ = now_us; }
  /// After it; returns the records that are to be forgotten. A frame that the bus does not take is
  /// lost, as any other.
  [[nodiscard]] FaultSet finish(const j1939::DiagnosticState& state) {
    const j1939::DiagnosticWork work = diagnostics_.step(state, now_us_);
    for (std::size_t i = 0; i < work.count; ++i) {
      dropped_ += port_.send(work.frame[i]) ? 0U : 1U;
    }
    return work.cleared;
  }
  /// Of these frames, those that the bus did not take.
  [[nodiscard]] std::uint32_t dropped() const { return dropped_; }

 private:
  CanPort& port_;
  j1939::Diagnostics& diagnostics_;
  TimeUs now_us_ = 0;
  std::uint32_t dropped_ = 0;
};

}  // namespace graben::ecu
