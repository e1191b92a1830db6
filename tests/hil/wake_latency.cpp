// SPDX-License-Identifier: Apache-2.0
// How late a SCHED_FIFO thread that sleeps to absolute times is woken: wake_latency SECONDS
// [PERIOD_US]. One line out; the clock is the one of the machine it runs on. Status 1 where
// priorities are refused.

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kNsPerS + now.tv_nsec;
}

std::int64_t sleep_until(std::int64_t wanted_ns) {
  const timespec wanted{wanted_ns / kNsPerS, wanted_ns % kNsPerS};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wanted, nullptr) == EINTR) {
  }
  return now_ns();
}

}  // namespace

int main(int argc, char** argv) {
  const std::int64_t seconds = argc > 1 ? std::atoll(argv[1]) : 0;
  const std::int64_t period_ns = (argc > 2 ? std::atoll(argv[2]) : 10'000) * 1000;
  if (seconds <= 0 || period_ns <= 0) {
    std::fputs("wake_latency SECONDS [PERIOD_US]\n", stderr);
    return 2;
  }
  const sched_param priority{80};
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0 ||
      sched_setscheduler(0, SCHED_FIFO, &priority) != 0) {
    std::perror("wake_latency: real-time priority");
    return 1;
  }

  std::vector<std::int64_t> late_ns(static_cast<std::size_t>(seconds * kNsPerS / period_ns));
  std::int64_t overruns = 0;
  std::int64_t wanted_ns = now_ns() + period_ns;
  for (std::int64_t& late : late_ns) {
    late = sleep_until(wanted_ns) - wanted_ns;
    wanted_ns += period_ns;
    // Missed wake-ups are skipped, not made up for in a burst, as the controller's scheduler does.
    while (late > 0 && now_ns() >= wanted_ns) {
      wanted_ns += period_ns;
      ++overruns;
    }
  }

  std::sort(late_ns.begin(), late_ns.end());
  const auto at_us = [&](double share) {
    const auto last = static_cast<double>(late_ns.size() - 1);
    return static_cast<double>(late_ns[static_cast<std::size_t>(share * last)]) * 1e-3;
  };
  std::printf("wakes=%zu overruns=%lld median_us=%.1f p999_us=%.1f max_us=%.1f\n", late_ns.size(),
              static_cast<long long>(overruns), at_us(0.5), at_us(0.999), at_us(1.0));
  return 0;
}
