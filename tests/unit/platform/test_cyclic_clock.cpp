// SPDX-License-Identifier: Apache-2.0
// The grid of deadlines, the clock that keeps it, the histogram it fills.

#include "platform/linux/cyclic_clock.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "tests/unit/cmocka_cpp.hpp"

constexpr std::int64_t kPeriodNs = 10'000'000;

void expect_deadline(std::int64_t now_ns, std::int64_t at_ns, std::uint64_t skipped) {
  // Where the grid lies does not matter.
  for (const std::int64_t last_ns : {std::int64_t{0}, std::int64_t{123'456'789'012'345}}) {
    const Deadline next = next_deadline(last_ns, last_ns + now_ns, kPeriodNs);
    assert_int_equal(next.at_ns, last_ns + at_ns);
    assert_int_equal(next.skipped, skipped);
  }
}

TEST(in_time_the_next_one_is_due) {
  expect_deadline(0, kPeriodNs, 0);
  expect_deadline(1, kPeriodNs, 0);
  expect_deadline(kPeriodNs - 1, kPeriodNs, 0);
  expect_deadline(kPeriodNs, kPeriodNs, 0);
}

TEST(an_overrun_skips_whole_periods) {
  expect_deadline(kPeriodNs + 1, 2 * kPeriodNs, 1);
  expect_deadline(2 * kPeriodNs - 1, 2 * kPeriodNs, 1);
  expect_deadline(2 * kPeriodNs, 2 * kPeriodNs, 1);
  expect_deadline(2 * kPeriodNs + 1, 3 * kPeriodNs, 2);
  expect_deadline(1000 * kPeriodNs, 1000 * kPeriodNs, 999);
  expect_deadline(360'000 * kPeriodNs + 7, 360'001 * kPeriodNs, 360'000);
}

TEST(a_clock_that_is_early_waits_for_the_next) { expect_deadline(-5, kPeriodNs, 0); }

TEST(a_bin_a_microsecond_below_a_millisecond) {
  Histogram histogram;
  for (const std::int64_t ns : {-3, 0, 1000, 1999, 999'999, 1'000'000, 20, 2'000'000'000}) {
    histogram.add(ns);
  }
  assert_int_equal(histogram.count(), 8);
  assert_int_equal(histogram.bin(0), 3);
  assert_int_equal(histogram.bin(1), 2);
  assert_int_equal(histogram.bin(2), 0);
  assert_int_equal(histogram.bin(999), 1);
  assert_int_equal(histogram.overflows(), 2);
  assert_int_equal(histogram.overflow_at(0), 5);
  assert_int_equal(histogram.overflow_at(1), 7);
  assert_int_equal(histogram.min_ns(), 0);
  assert_int_equal(histogram.max_ns(), 2'000'000'000);
}

TEST(minimum_mean_and_maximum) {
  Histogram histogram;
  assert_int_equal(histogram.min_ns(), 0);
  assert_int_equal(histogram.max_ns(), 0);
  assert_int_equal(histogram.mean_ns(), 0);
  histogram.add(20);
  assert_int_equal(histogram.min_ns(), 20);
  histogram.add(10);
  histogram.add(61);
  assert_int_equal(histogram.min_ns(), 10);
  assert_int_equal(histogram.max_ns(), 61);
  assert_int_equal(histogram.mean_ns(), 30);
}

std::string printed(const std::vector<const Histogram*>& columns) {
  char text[65536] = {};
  std::FILE* const to = fmemopen(text, sizeof text, "w");
  assert_non_null(to);
  print_histograms(to, columns);
  std::fclose(to);
  return text;
}

/// Every row from `begin` to before `end`, all counts 0.
std::string empty_rows(int begin, int end) {
  std::string rows;
  for (int us = begin; us < end; ++us) {
    char row[32];
    std::snprintf(row, sizeof row, "%06d 000000\t000000\n", us);
    rows += row;
  }
  return rows;
}

TEST(two_of_them_print_as_two_threads_of_cyclictest) {
  Histogram latency;
  for (const std::int64_t ns : {7'000, 7'999, 12'500}) {
    latency.add(ns);
  }
  Histogram cycle;
  for (const std::int64_t ns : {12'000, 3'500'000, 999'000}) {
    cycle.add(ns);
  }
  assert_string_equal(printed({&latency, &cycle}).c_str(),
                      ("# Histogram\n" + empty_rows(0, 7) + "000007 000002\t000000\n" +
                       empty_rows(8, 12) + "000012 000001\t000001\n" + empty_rows(13, 999) +
                       "000999 000000\t000001\n"
                       "# Total: 000000003 000000002\n"
                       "# Min Latencies: 00007 00012\n"
                       "# Avg Latencies: 00009 01503\n"
                       "# Max Latencies: 00012 03500\n"
                       "# Histogram Overflows: 00000 00001\n"
                       "# Histogram Overflow at cycle number:\n"
                       "# Thread 0:\n"
                       "# Thread 1: 00001\n")
                          .c_str());
}

TEST(the_first_overflows_are_named_and_the_others_counted) {
  Histogram histogram;
  repeat(Histogram::kNotedOverflows + 3, [&] { histogram.add(5'000'000); });
  const std::string text = printed({&histogram});
  assert_non_null(std::strstr(text.c_str(), "# Histogram Overflows: 00067\n"));
  assert_non_null(std::strstr(text.c_str(), "# Thread 0: 00000 00001 00002 "));
  assert_non_null(std::strstr(text.c_str(), " 00062 00063 # 00003 others\n"));
}

/// A test may share its processor with anything: bounds below are sharp, those above are not there.
TEST(cycles_begin_on_the_grid) {
  constexpr TimeUs kPeriodUs = 2000;
  CyclicClock clock(kPeriodUs);
  const TimeUs before_us = monotonic_now_us();
  const CyclicClock::Cycle first = clock.wait();
  assert_int_equal(first.last_us, 0);
  assert_int_equal(first.skipped, 0);
  assert_true(first.now_us >= before_us + kPeriodUs);
  std::uint64_t periods = 0;
  CyclicClock::Cycle cycle;
  for (int i = 0; i < 20; ++i) {
    cycle = clock.wait();
    periods += 1 + cycle.skipped;
    assert_true(cycle.late_us >= 0);
    // Deadlines do not drift with the wake-ups' latency.
    const TimeUs deadlines_us = (cycle.now_us - cycle.late_us) - (first.now_us - first.late_us);
    assert_in_range(deadlines_us, static_cast<TimeUs>(periods) * kPeriodUs - 1,
                    static_cast<TimeUs>(periods) * kPeriodUs + 1);
  }
  assert_int_equal(clock.skipped(), periods - 20);
  assert_int_equal(clock.wake_up_latency().count(), 21);
  assert_int_equal(clock.cycle_time().count(), 20);
}

TEST(a_cycle_that_overruns_is_told_and_not_made_up_for) {
  constexpr TimeUs kPeriodUs = 4000;
  CyclicClock clock(kPeriodUs);
  const CyclicClock::Cycle first = clock.wait();
  usleep(2 * kPeriodUs + kPeriodUs / 2);
  const CyclicClock::Cycle second = clock.wait();
  assert_true(second.skipped >= 2);
  assert_true(second.last_us >= 2 * kPeriodUs + kPeriodUs / 2);
  const auto periods = static_cast<TimeUs>(second.skipped) + 1;
  assert_in_range((second.now_us - second.late_us) - (first.now_us - first.late_us),
                  periods * kPeriodUs - 1, periods * kPeriodUs + 1);
  assert_int_equal(clock.overruns(), 1);
  assert_int_equal(clock.skipped(), second.skipped);
  assert_true(clock.cycle_time().max_ns() >= 2 * kPeriodUs * 1000);
}

volatile std::sig_atomic_t g_signals = 0;

TEST(a_signal_does_not_end_the_sleep) {
  struct sigaction action {};
  action.sa_handler = [](int) { g_signals = g_signals + 1; };
  sigaction(SIGALRM, &action, nullptr);
  itimerval every{};
  every.it_value.tv_usec = 3000;
  every.it_interval.tv_usec = 3000;
  setitimer(ITIMER_REAL, &every, nullptr);
  CyclicClock clock(20'000);
  const TimeUs before_us = monotonic_now_us();
  const CyclicClock::Cycle cycle = clock.wait();
  const itimerval off{};
  setitimer(ITIMER_REAL, &off, nullptr);
  assert_true(g_signals > 0);
  assert_true(cycle.now_us >= before_us + 20'000);
  assert_true(cycle.late_us >= 0);
}
