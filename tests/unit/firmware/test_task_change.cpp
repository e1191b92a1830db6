// SPDX-License-Identifier: Apache-2.0
// A change of task passes standstill.

#include "firmware/safety/task_change.hpp"

#include <array>
#include <cmath>

#include "firmware/safety/tuning.hpp"
#include "tests/unit/cmocka_cpp.hpp"

constexpr double kPeriod_s = 0.015625;  // Binary, so that times add up to the bit.
constexpr int kCycles = 13;             // The first that is 0.2 s and more.
constexpr TaskChoice kNothing;
constexpr TaskChoice kDigging{Task::kDig, -1};
constexpr TaskChoice kFirst{Task::kProgram, 0};
constexpr TaskChoice kSecond{Task::kProgram, 1};

struct Machine {
  TaskChangeState state;
  bool in_motion = true;
  bool at_rest = true;
  std::array<double, 2> travel_m{};

  TaskChoice step(const TaskChoice& asked, double period_s = kPeriod_s) {
    return task_after_change(state, asked, in_motion, at_rest, travel_m, period_s);
  }
  /// Cycles until `asked` is followed.
  int cycles_until(const TaskChoice& asked) {
    for (int n = 1; n < 1000; ++n) {
      const TaskChoice followed = step(asked);
      if (followed == asked) {
        return n;
      }
      assert_true(followed == kNothing);
    }
    return 0;
  }
};

TEST(choices_are_told_apart) {
  assert_true(kFirst == kFirst);
  assert_false(kFirst == kSecond);
  assert_false(kDigging == TaskChoice({Task::kGrade, -1}));
}

/// Arming needs a task at rest, and what was armed begins at once.
TEST(the_first_task_begins_at_once, Machine machine) {
  machine.at_rest = false;
  assert_true(machine.step(kNothing) == kNothing);
  assert_true(machine.step(kDigging) == kDigging);
  for (int n = 0; n < 100; ++n) {
    machine.travel_m[0] += 0.01;
    assert_true(machine.step(kDigging) == kDigging);
  }
}

TEST(outside_motion_everything_is_let_through, Machine machine) {
  machine.step(kDigging);
  machine.in_motion = false;
  for (const TaskChoice& asked : {kFirst, kNothing, kSecond}) {
    assert_true(machine.step(asked) == asked);
  }
  machine.in_motion = true;
  assert_true(machine.step(kFirst) == kFirst);
}

TEST(another_task_waits_for_standstill) {
  for (const TaskChoice& next : {kSecond, kDigging, kNothing}) {
    Machine machine;
    machine.step(kFirst);
    // Still from the cycle after the change on.
    const int waited = machine.cycles_until(next);
    assert_int_equal(waited, next == kNothing ? 1 : kCycles + 1);
  }
}

/// Back to the same task counts as a change as well: it was let go in between.
TEST(the_same_task_again_waits_too, Machine machine) {
  machine.step(kFirst);
  assert_true(machine.step(kNothing) == kNothing);
  assert_int_equal(machine.cycles_until(kFirst), kCycles + 1);
  // Followed again, the next change is one.
  assert_int_equal(machine.cycles_until(kSecond), kCycles + 1);
}

TEST(none_for_long_enough_has_waited_already, Machine machine) {
  machine.step(kFirst);
  repeat(kCycles + 1, [&] { machine.step(kNothing); });
  assert_true(machine.step(kFirst) == kFirst);
}

TEST(what_moves_is_waited_for) {
  for (const unsigned drive : {0U, 1U}) {
    Machine machine;
    machine.step(kFirst);
    for (int n = 0; n < 50; ++n) {
      machine.travel_m[drive] += 0.01001;
      assert_true(machine.step(kSecond) == kNothing);
    }
    assert_int_equal(machine.cycles_until(kSecond), kCycles);
  }
  // Within a sensor's noise it stands; where it has been since it came to rest counts, no creeping.
  Machine noisy;
  noisy.step(kFirst);
  noisy.step(kSecond);
  noisy.travel_m[1] = kStandstill_m;
  assert_int_equal(noisy.cycles_until(kSecond), kCycles);
}

TEST(spools_that_are_open_are_waited_for, Machine machine) {
  machine.step(kFirst);
  machine.at_rest = false;
  repeat(50, [&] { assert_true(machine.step(kSecond) == kNothing); });
  machine.at_rest = true;
  assert_int_equal(machine.cycles_until(kSecond), kCycles);
}

TEST(standstill_is_over_after_its_time_and_no_sooner) {
  for (const double still_s : {kStandstill_s, std::nextafter(kStandstill_s, 0.0)}) {
    Machine machine;
    machine.step(kFirst);
    machine.step(kSecond);
    assert_int_equal(machine.step(kSecond, still_s) == kSecond, still_s == kStandstill_s);
  }
}

TEST(as_many_drives_as_a_machine_can_have_are_waited_for, TaskChangeState state) {
  std::array<double, kMostDrives> travel_m{};
  const auto step = [&](const TaskChoice& asked) {
    return task_after_change(state, asked, true, true, travel_m, kStandstill_s);
  };
  static_cast<void>(step(kFirst));
  assert_true(step(kSecond) == kNothing);
  travel_m.back() += 1.0;
  assert_true(step(kSecond) == kNothing);
  assert_true(step(kSecond) == kSecond);
}

/// What is asked for by turns begins never.
TEST(a_task_that_toggles_stays_at_rest, Machine machine) {
  machine.step(kFirst);
  machine.step(kNothing);
  for (int n = 0; n < 200; ++n) {
    assert_true(machine.step(n % 2 == 0 ? kFirst : kSecond) == kNothing);
  }
}
