// SPDX-License-Identifier: Apache-2.0
// When a simulation's cycles are due.

#include "app/scope/sim/sim_source.hpp"

#include "tests/unit/cmocka_cpp.hpp"

using graben::scope::SimPacer;
using std::chrono::milliseconds;

/// Cycles due in a second that is looked at every millisecond.
int cycles_in_a_second(double pace) {
  const SimPacer::Clock::time_point begin{};
  SimPacer pacer(begin);
  pacer.set_pace(pace, begin);
  int cycles = 0;
  for (int ms = 0; ms < 1000; ++ms) {
    cycles += pacer.due(begin + milliseconds(ms));
  }
  assert_int_equal(pacer.dropped(), 0);
  return cycles;
}

TEST(deadlines_follow_the_pace) {
  assert_int_equal(cycles_in_a_second(1.0), 100);
  assert_int_equal(cycles_in_a_second(10.0), 1000);
  assert_int_equal(cycles_in_a_second(0.1), 10);
  assert_int_equal(cycles_in_a_second(2.5), 250);
}

TEST(late_cycles_are_caught_up_a_little) {
  const SimPacer::Clock::time_point begin{};
  SimPacer pacer(begin);
  assert_int_equal(pacer.due(begin), 1);
  assert_int_equal(pacer.due(begin + milliseconds(5)), 0);
  // Deadlines are absolute: 7 ms late costs nothing afterwards.
  assert_int_equal(pacer.due(begin + milliseconds(17)), 1);
  assert_true(pacer.next() == begin + milliseconds(20));
  assert_int_equal(pacer.due(begin + milliseconds(52)), 4);
  assert_int_equal(pacer.dropped(), 0);
  // A second away: five, and the raster goes on.
  assert_int_equal(pacer.due(begin + milliseconds(1063)), SimPacer::kMostAtOnce);
  assert_int_equal(pacer.dropped(), 101 - SimPacer::kMostAtOnce);
  assert_true(pacer.next() == begin + milliseconds(1070));
}

TEST(a_faster_pace_does_not_wait_for_the_slow_one) {
  const SimPacer::Clock::time_point begin{};
  SimPacer pacer(begin);
  pacer.set_pace(0.1, begin);
  assert_int_equal(pacer.due(begin), 1);
  assert_true(pacer.next() == begin + milliseconds(100));
  pacer.set_pace(10.0, begin + milliseconds(3));
  assert_true(pacer.next() == begin + milliseconds(4));
}
