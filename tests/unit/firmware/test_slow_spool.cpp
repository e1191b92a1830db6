// SPDX-License-Identifier: Apache-2.0
/// Spools that are slower or later than told: three words for three things.

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/watched_valve.hpp"

using namespace test::valve;

/// A spool that follows with two lags from a number of cycles on.
struct SlowSpool {
  double lag_cycles = 0.0;
  int late_cycles = 0;
  std::array<double, 64> sent{};
  double first = 0.0;
  double travel = 0.0;

  double after(double duty) {
    std::rotate(sent.begin(), sent.end() - 1, sent.end());
    sent[0] = duty;
    first += (sent[static_cast<unsigned>(late_cycles)] - first) / (1.0 + lag_cycles);
    travel += (first - travel) / (1.0 + lag_cycles);
    return travel;
  }
};

/// Opened for a second and closed again, both ways in turn; the first fault.
Fault worked(SlowSpool spool) {
  Valve valve;
  for (int n = 0; n < 1000; ++n) {
    const double duty = (n / 100) % 2 == 1 ? 0.0 : ((n / 200) % 2 == 0 ? 0.6 : -0.6);
    valve.sent.duty_ratio = {duty, 0.0, 0.0};
    valve.valid.drive[kBoom].spool_ratio = spool.after(duty);
    const FaultSet faults = valve.step();
    if (!faults.empty()) {
      return faults.first();
    }
  }
  return Fault::kNone;
}

/// What moves all the while is slow, and is known to be from its first opening on; what stands
/// first is late; what does not come, or stays open, is stuck.
TEST(slow_late_and_stuck_are_three_words) {
  for (const double lag_cycles : {2.0, 4.0, 6.0, 8.0}) {
    assert_true(worked({lag_cycles, 0}) == Fault::kNone);
  }
  assert_true(worked({2.0, 4}) == Fault::kNone);
  for (const int late_cycles : {14, 18, 24}) {
    assert_true(worked({1.0, late_cycles}) == Fault::kSpoolLate);
  }
  assert_true(worked({1.0, 60}) == Fault::kSpoolStuck);
  Valve stands;
  stands.settle(0.0);
  stands.sent.duty_ratio = {0.6, 0.0, 0.0};
  const int found = stands.cycles_until(Fault::kSpoolStuck);
  assert_true(found > kSpoolBehindCycles && found <= kSpoolBehindCycles + 20);
}

/// To be slow on its way out gives no time to one that does not close: no more than it was behind.
TEST(a_slow_spool_that_stays_open_is_stuck, Valve valve) {
  SlowSpool spool{6.0, 0};
  for (int n = 0; n < 200; ++n) {
    valve.sent.duty_ratio = {0.6, 0.0, 0.0};
    valve.valid.drive[kBoom].spool_ratio = spool.after(0.6);
    assert_true(valve.step().empty());
  }
  valve.sent.duty_ratio = {0.0, 0.0, 0.0};
  const int found = valve.cycles_until(Fault::kSpoolStuck);
  assert_true(found >= cycles_to_find(kStarts, 0.6) && found <= 60);
}

/// Beyond neutral, on the side that nobody asked for, it has no more time than any other.
TEST(on_the_wrong_side_it_is_stuck_at_once, Valve valve) {
  valve.settle(0.5);
  valve.valid.drive[kBoom].spool_ratio = -0.3;
  assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), kSpoolWrongCycles);
}

/// Open at once, and home with another lag: the first fault.
Fault closed(double home_cycles) {
  Valve valve;
  SlowSpool spool;
  for (int n = 0; n < 400; ++n) {
    const double duty = n % 200 < 100 ? 0.8 : 0.0;
    spool.lag_cycles = duty > 0.0 ? 0.0 : home_cycles;
    valve.sent.duty_ratio = {duty, 0.0, 0.0};
    valve.valid.drive[kBoom].spool_ratio = spool.after(duty);
    const FaultSet faults = valve.step();
    if (!faults.empty()) {
      return faults.first();
    }
  }
  return Fault::kNone;
}

/// On its way home it may be slow, for 0.3 s beyond what is told.
TEST(a_spool_may_close_slowly) {
  for (const double home_cycles : {0.0, 5.0, 8.0}) {
    assert_true(closed(home_cycles) == Fault::kNone);
  }
  assert_true(closed(60.0) == Fault::kSpoolStuck);
}

/// Behind from a little beyond neutral it has its time, too; from farther on the other side not.
TEST(behind_begins_at_neutral) {
  for (const double at_ratio : {-0.1, -0.2}) {
    Valve valve;
    valve.settle(0.0);
    valve.sent.duty_ratio = {0.6, 0.0, 0.0};
    valve.valid.drive[kBoom].spool_ratio = at_ratio;
    const int found = valve.cycles_until(Fault::kSpoolStuck);
    assert_true((found > kSpoolBehindCycles) == (at_ratio > -kTolerance));
  }
}

/// A command that comes back to where the spool stands has taught nothing.
TEST(a_command_that_comes_back_teaches_nothing, Valve valve) {
  valve.settle(0.6);
  valve.valid.drive[kBoom].spool_ratio = 0.4;
  repeat(10, [&] { assert_true(valve.step().empty()); });
  valve.sent.duty_ratio = {0.4, 0.6, 0.6};
  repeat(10, [&] { assert_true(valve.step().empty()); });
  assert_int_equal(valve.state.spool[kBoom].behind_cycles, 0);
  assert_int_equal(valve.state.spool[kBoom].later_cycles, 0);
}
