// SPDX-License-Identifier: Apache-2.0
// A message's clock against ours. What a receiver makes of it: test_stream_late.cpp.

#include "hal/link/message_clock.hpp"

#include "tests/unit/cmocka_cpp.hpp"

TEST(what_passes_and_is_not_sent_is_lag, MessageClock clock) {
  advance(clock, 10'000, 10'000);
  assert_int_equal(clock.lag_us, 0);  // never below
  advance(clock, 40'000, 10'000);
  assert_int_equal(clock.lag_us, 29'960);  // 1 per mille of what passed is forgiven
  advance(clock, 10'000, 30'000);
  assert_int_equal(clock.lag_us, 9'950);
  advance(clock, 10'000, 40'000);
  assert_int_equal(clock.lag_us, 0);
}

TEST(more_than_60_ms_is_stale) {
  assert_false(is_stale({}));
  assert_false(is_stale({60'000}));
  assert_true(is_stale({60'001}));
}

TEST(the_lag_does_not_overflow, MessageClock clock) {
  advance(clock, 2000 * kSecondUs, 0);
  assert_int_equal(clock.lag_us, 1000 * kSecondUs);
}
