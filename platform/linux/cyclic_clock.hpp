// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The controller's clock: absolute deadlines on the monotonic clock, so that nothing drifts and
/// a step of the wall clock is not felt.

#include <cstdint>

#include "firmware/core/time.hpp"
#include "platform/linux/histogram.hpp"

namespace graben {

/// CLOCK_MONOTONIC in whole microseconds: the clock that every stamp and every `now` here is on.
[[nodiscard]] TimeUs monotonic_now_us();

/// When to wake up next, and what was missed on the way there.
struct Deadline {
  std::int64_t at_ns = 0;
  std::uint64_t skipped = 0;  ///< Deadlines that had passed already and get no cycle.
};

/// The first deadline of the grid last_ns + n * period_ns, n >= 1, that is not before now_ns. Late
/// cycles are not made up for: a burst of them would take old inputs for new ones. period_ns > 0.
[[nodiscard]] Deadline next_deadline(std::int64_t last_ns, std::int64_t now_ns,
                                     std::int64_t period_ns);

/// Paces a loop that calls wait() and does one cycle after each return. Measures it as well.
class CyclicClock {
 public:
  /// What a cycle is told about its own time.
  struct Cycle {
    TimeUs now_us = 0;          ///< The wake-up; the cycle's only `now`.
    TimeUs late_us = 0;         ///< From the deadline to the wake-up.
    TimeUs last_us = 0;         ///< How long the cycle before took; 0 in the first.
    std::uint64_t skipped = 0;  ///< Periods left out since the cycle before: it overran.
  };

  explicit CyclicClock(TimeUs period_us);

  /// Sleeps until the next deadline; the first is one period after the first call. A signal does
  /// not end the sleep: what it asks for is seen after at most one period.
  [[nodiscard]] Cycle wait();

  /// From deadline to wake-up, and from wake-up to the next wait().
  [[nodiscard]] const Histogram& wake_up_latency() const { return latency_; }
  [[nodiscard]] const Histogram& cycle_time() const { return cycle_time_; }
  /// Cycles that ran past the next deadline, and the deadlines that were skipped for them.
  [[nodiscard]] std::uint64_t overruns() const { return overruns_; }
  [[nodiscard]] std::uint64_t skipped() const { return skipped_; }

 private:
  std::int64_t period_ns_;
  std::int64_t deadline_ns_ = 0;
  std::int64_t woken_ns_ = 0;
  bool started_ = false;
  std::uint64_t overruns_ = 0;
  std::uint64_t skipped_ = 0;
  Histogram latency_;
  Histogram cycle_time_;
};

}  // namespace graben
