// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A simulation in real time as a source of frames.

#include <chrono>
#include <cstdint>
#include <memory>

#include "app/scope/server/frame_source.hpp"
#include "app/scope/sim/sim_machine.hpp"

namespace graben::scope {

/// Deadlines are absolute. What is late is made up for by at most kMostAtOnce cycles; the rest of
/// it is dropped, and simulated time lags. The clock is the caller's.
class SimPacer {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr int kMostAtOnce = 5;

  /// A cycle is due at once.
  explicit SimPacer(Clock::time_point now) : next_(now) {}

  /// Simulated over real time, above 0; the next deadline moves with it.
  void set_pace(double pace, Clock::time_point now);
  /// How many cycles are to be done now: 0 .. kMostAtOnce.
  [[nodiscard]] int due(Clock::time_point now);
  /// The next deadline.
  [[nodiscard]] Clock::time_point next() const { return next_; }
  /// Cycles that were never made up for.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  Clock::duration period_ = std::chrono::milliseconds(10);
  Clock::time_point next_;
  std::uint64_t dropped_ = 0;
};

/// Throws std::runtime_error where the options do not fit, ProfileError for a wrong file. Frames
/// are stamped with simulated time, from 0 on.
[[nodiscard]] std::unique_ptr<FrameSource> make_sim_source(const SimOptions& options);

}  // namespace graben::scope
