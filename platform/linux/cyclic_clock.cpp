// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/cyclic_clock.hpp"

#include <algorithm>
#include <cerrno>
#include <ctime>

namespace graben {
namespace {

constexpr std::int64_t kNsPerUs = 1000;
constexpr std::int64_t kNsPerSecond = 1'000'000'000;

std::int64_t monotonic_now_ns() {
  timespec now{};
  static_cast<void>(clock_gettime(CLOCK_MONOTONIC, &now));
  return std::int64_t{now.tv_sec} * kNsPerSecond + now.tv_nsec;
}

void sleep_until(std::int64_t at_ns) {
  timespec at{};
  at.tv_sec = static_cast<time_t>(at_ns / kNsPerSecond);
  at.tv_nsec = static_cast<long>(at_ns % kNsPerSecond);
  // The deadline is absolute: after a signal the same call sleeps the rest.
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr) == EINTR) {
  }
}

}  // namespace

TimeUs monotonic_now_us() { return monotonic_now_ns() / kNsPerUs; }

Deadline next_deadline(std::int64_t last_ns, std::int64_t now_ns, std::int64_t period_ns) {
  const std::int64_t next_ns = last_ns + period_ns;
  if (now_ns <= next_ns) {
    return {next_ns, 0};
  }
  const std::int64_t skipped = (now_ns - next_ns + period_ns - 1) / period_ns;
  return {next_ns + skipped * period_ns, static_cast<std::uint64_t>(skipped)};
}

CyclicClock::CyclicClock(TimeUs period_us)
    : period_ns_(std::max<TimeUs>(period_us, 1) * kNsPerUs) {}

CyclicClock::Cycle CyclicClock::wait() {
  const std::int64_t done_ns = monotonic_now_ns();
  Cycle cycle;
  if (started_) {
    cycle.last_us = (done_ns - woken_ns_) / kNsPerUs;
    cycle_time_.add(done_ns - woken_ns_);
  } else {
    deadline_ns_ = done_ns;
    started_ = true;
  }
  const Deadline next = next_deadline(deadline_ns_, done_ns, period_ns_);
  deadline_ns_ = next.at_ns;
  cycle.skipped = next.skipped;
  skipped_ += next.skipped;
  overruns_ += next.skipped > 0 ? 1 : 0;

  sleep_until(deadline_ns_);
  woken_ns_ = monotonic_now_ns();
  cycle.now_us = woken_ns_ / kNsPerUs;
  cycle.late_us = (woken_ns_ - deadline_ns_) / kNsPerUs;
  latency_.add(woken_ns_ - deadline_ns_);
  return cycle;
}

}  // namespace graben
