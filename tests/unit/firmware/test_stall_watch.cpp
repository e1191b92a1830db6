// SPDX-License-Identifier: Apache-2.0
// A machine that does not get on.

#include "firmware/safety/stall_watch.hpp"

#include <cmath>
#include <limits>

#include "firmware/safety/tuning.hpp"
#include "tests/unit/cmocka_cpp.hpp"

constexpr double kPeriod_s = 0.015625;  // Binary: 128 of them are 2 s.
constexpr double kMost_s = 10.0;

struct Machine {
  StallState state;
  bool active = true;
  bool asked = true;

  void run(double share, int cycles) {
    repeat(cycles, [&] { next_stall(active, asked, share, kMost_s, kPeriod_s, state); });
  }
  /// What is told now: kNone, kStalling or kStalled.
  [[nodiscard]] Fault told() const {
    CommonValid valid;
    tell_stall(state, kMost_s, valid);
    assert_true(valid.degraded.empty());
    assert_int_equal(valid.faults.has(Fault::kStalled), valid.fault == Fault::kStalled);
    return valid.fault != Fault::kNone ? valid.fault : valid.warned.first();
  }
};

TEST(it_is_said_and_then_stopped, Machine machine) {
  machine.run(0.0, 128);
  assert_int_equal(machine.told(), Fault::kNone);
  machine.run(0.0, 1);
  assert_int_equal(machine.told(), Fault::kStalling);
  machine.run(0.0, 640 - 129);
  assert_int_equal(machine.told(), Fault::kStalling);
  machine.run(0.0, 1);
  assert_int_equal(machine.told(), Fault::kStalled);
}

TEST(a_twentieth_is_getting_on, Machine machine) {
  machine.run(kStallShare, 1000);
  assert_int_equal(machine.told(), Fault::kNone);
  machine.run(std::nextafter(kStallShare, 0.0), 129);
  assert_int_equal(machine.told(), Fault::kStalling);
  machine.run(std::numeric_limits<double>::quiet_NaN(), 640);
  assert_int_equal(machine.told(), Fault::kStalled);
}

/// 85 % of the time without getting on is a stall too; half of it is none.
TEST(most_of_the_time_counts, Machine mostly) {
  for (int n = 0; n < 40 * 64; ++n) {
    mostly.run(n % 20 < 17 ? 0.0 : 1.0, 1);
  }
  assert_int_equal(mostly.told(), Fault::kStalled);
  Machine half;
  for (int n = 0; n < 40 * 64; ++n) {
    half.run(n % 2 == 0 ? 0.0 : 1.0, 1);
    assert_int_equal(half.told(), Fault::kNone);
  }
}

TEST(nothing_asked_is_no_stall, Machine machine) {
  machine.run(0.0, 200);
  machine.asked = false;
  machine.run(0.0, 73);
  assert_int_equal(machine.told(), Fault::kNone);
  machine.run(0.0, 1000);
  machine.asked = true;
  machine.run(0.0, 128);
  assert_int_equal(machine.told(), Fault::kNone);  // Never below 0.
}

TEST(not_active_it_begins_newly, Machine machine) {
  machine.run(0.0, 2000);
  machine.active = false;
  machine.run(0.0, 1);
  assert_int_equal(machine.told(), Fault::kNone);
  machine.active = true;
  machine.run(0.0, 128);
  assert_int_equal(machine.told(), Fault::kNone);
}

/// However long it has stalled, a second and what was allowed is all that has to run off.
TEST(it_is_bounded, Machine machine) {
  machine.run(0.0, 100000);
  assert_near(machine.state.stalled_s, kMost_s + 1.0, 0.0);
  machine.run(1.0, 64);
  assert_int_equal(machine.told(), Fault::kStalling);
}
