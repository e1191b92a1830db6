// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/safety/displacement_watch.hpp"

#include <algorithm>
#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"

constexpr double kTolerance = 0.125;
constexpr DisplacementLimits kLimits{kTolerance, 0.5};
/// The time to settle, in cycles: a command still counts as under way in the last.
constexpr int kUnderWay = 50;

/// One displacement and what is sent to it, cycle by cycle.
struct Displacement {
  DisplacementState state{0.0};
  DisplacementTask task = DisplacementTask::kFollow;
  double sent = 0.0;
  double measured = 0.0;
  DisplacementResult seen;

  bool disagrees(double period_s) {
    seen = watch_displacement(kLimits, state, sent, task, measured, period_s);
    return seen.disagrees;
  }
  bool runs_away() {
    static_cast<void>(disagrees(0.0));
    return seen.runs_away;
  }
  /// Cycles until it has run away, counting the one that has it; -1 if it never does.
  int cycles_until_away() {
    for (int n = 1; n <= 200; ++n) {
      if (runs_away()) {
        return n;
      }
    }
    return -1;
  }
  void settle(double ratio) {
    sent = measured = ratio;
    repeat(CommandHistory::kMostCycles, [&] { assert_false(disagrees(0.0625) || seen.runs_away); });
  }
};

Displacement settled(double ratio) {
  Displacement one;
  one.settle(ratio);
  return one;
}

/// Off by the tolerance for ever is well; by the next number it is not, either way.
TEST(disagreement_has_a_sharp_edge) {
  for (const double sign : {1.0, -1.0}) {
    Displacement one = settled(0.5);
    one.measured = 0.5 + sign * kTolerance;
    assert_false(one.disagrees(10.0));
    one.measured = std::nextafter(one.measured, sign * 9.0);
    assert_true(one.disagrees(10.0));
  }
}

/// It has the time to settle; a moment of agreement gives it as much again.
TEST(it_is_given_the_time_to_settle) {
  Displacement one = settled(0.0);
  one.sent = 0.5;
  assert_false(one.disagrees(0.25));
  assert_false(one.disagrees(0.25));
  assert_true(one.disagrees(0.0078125));
  one.measured = 0.5;
  assert_false(one.disagrees(0.25));
  one.measured = 0.0;
  assert_false(one.disagrees(0.5));
  assert_true(one.disagrees(0.0078125));
}

/// Passed by its command, it has the time once more: one that follows late is not off for good.
TEST(the_other_side_of_its_command_counts_anew) {
  Displacement one = settled(0.0);
  for (int n = 0; n < 20; ++n) {
    one.sent = n % 2 == 0 ? 0.5 : -0.5;
    assert_false(one.disagrees(0.25));
    assert_false(one.disagrees(0.25));
  }
  assert_true(one.disagrees(0.0078125));
}

/// Away from its command by more than the tolerance: three cycles, no fewer, whichever way.
TEST(one_that_leaves_its_command_runs_away) {
  for (const double at : {0.0, 0.5, -0.5}) {
    for (const double sign : {1.0, -1.0}) {
      Displacement one = settled(at);
      one.measured = at + sign * kTolerance;
      assert_int_equal(one.cycles_until_away(), -1);
      one.measured = std::nextafter(one.measured, sign * 9.0);
      assert_int_equal(one.cycles_until_away(), kRunawayCycles);
      assert_true(one.runs_away());
      one.measured = at;
      assert_false(one.runs_away());
    }
  }
}

/// At 4 of full displacement per second from 0.25: within 80 ms, long before it disagrees.
TEST(it_is_found_soon) {
  Displacement one = settled(0.25);
  int cycles = 0;
  do {
    ++cycles;
    one.measured = std::min(1.0, one.measured + 0.04);
  } while (!one.runs_away());
  assert_in_range(cycles, 4, 8);
}

/// One wrong frame, seen twice, is not enough.
TEST(it_must_be_away_in_a_row) {
  Displacement one = settled(0.0);
  for (int round = 0; round < 5; ++round) {
    one.measured = 1.0;
    for (int n = 1; n < kRunawayCycles; ++n) {
      assert_false(one.runs_away());
    }
    one.measured = 0.0;
    assert_false(one.runs_away());
  }
}

/// On its way between old commands and new ones, it is well, however late.
TEST(between_old_and_new_is_well) {
  for (const double sign : {1.0, -1.0}) {
    Displacement one = settled(-0.5 * sign);
    one.sent = 0.75 * sign;
    for (int n = 0; n < kUnderWay - 1; ++n) {
      one.measured = sign * (-0.5 + 1.25 * n / kUnderWay);
      assert_false(one.runs_away());
    }
  }
}

/// Stuck where it was sent it disagrees, but has not run away; whatever leaves it is the command.
TEST(one_that_is_stuck_does_not_run_away) {
  Displacement one = settled(0.75);
  one.sent = 0.25;
  assert_int_equal(one.cycles_until_away(), -1);
  assert_true(one.disagrees(10.0));
  // Nearer than it was, and away again: from there it counts.
  one.measured = 0.5;
  assert_false(one.runs_away());
  one.measured = 0.625;
  assert_int_equal(one.cycles_until_away(), -1);
  one.measured = std::nextafter(0.625, 1.0);
  assert_int_equal(one.cycles_until_away(), kRunawayCycles);
}

/// Within the commands of late it goes where it likes, and stays stuck wherever that was.
TEST(one_that_followed_before_it_stuck_does_not_run_away) {
  Displacement one = settled(0.25);
  one.sent = one.measured = 0.75;
  assert_false(one.runs_away());
  one.sent = 0.25;
  assert_int_equal(one.cycles_until_away(), -1);
}

/// Stuck on the other side it drives the wrong way: as soon as no command of late was there.
TEST(the_wrong_side_is_away_without_moving) {
  for (const double sign : {1.0, -1.0}) {
    Displacement one = settled(-0.5 * sign);
    one.sent = 0.0;
    assert_int_equal(one.cycles_until_away(), -1);
    one.sent = 0.25 * sign;
    assert_int_equal(one.cycles_until_away(), kRunawayCycles);
    Displacement reversed = settled(-0.5 * sign);
    reversed.sent = 0.5 * sign;
    assert_int_equal(reversed.cycles_until_away(), kUnderWay - 1 + kRunawayCycles);
  }
}

/// It goes the wrong way from the start.
TEST(the_wrong_direction_is_away) {
  Displacement one = settled(0.0);
  one.sent = 0.5;
  one.measured = -0.25;
  assert_int_equal(one.cycles_until_away(), kRunawayCycles);
}

/// After motion what stays where it was drives the machine.
TEST(one_that_does_not_return_runs_away) {
  Displacement one = settled(0.5);
  one.sent = 0.0;
  one.task = DisplacementTask::kReturn;
  assert_int_equal(one.cycles_until_away(), kUnderWay - 1 + kRunawayCycles);
  Displacement returned = settled(0.5);
  returned.sent = 0.0;
  returned.task = DisplacementTask::kReturn;
  returned.measured = kTolerance;
  assert_int_equal(returned.cycles_until_away(), -1);
}

/// Not judged, nothing is asked and nothing remembered but what was sent.
TEST(one_that_is_not_judged_begins_afresh) {
  Displacement one = settled(0.0);
  one.measured = 0.75;
  assert_false(one.disagrees(0.5) || one.runs_away());
  one.task = DisplacementTask::kNone;
  assert_false(one.disagrees(10.0));
  repeat(10, [&] { assert_false(one.runs_away()); });
  one.task = DisplacementTask::kFollow;
  // Where it is now is where it begins: it may stay away, as long as it comes to its command.
  assert_false(one.disagrees(0.5));
  assert_int_equal(one.cycles_until_away(), -1);
  one.measured = 1.0;
  assert_int_equal(one.cycles_until_away(), kRunawayCycles);
  Displacement under_way;
  under_way.task = DisplacementTask::kNone;
  under_way.sent = 0.75;
  assert_false(under_way.runs_away());
  under_way.sent = 0.0;
  under_way.measured = 0.75;
  under_way.task = DisplacementTask::kReturn;
  assert_int_equal(under_way.cycles_until_away(), kUnderWay - 1 + kRunawayCycles);
}

/// A motor's neutral is 1: from the first cycle on nothing else was commanded.
TEST(the_history_begins_at_neutral, Displacement motor) {
  motor.state = DisplacementState(1.0);
  motor.sent = motor.measured = 1.0;
  assert_false(motor.runs_away());
  motor.measured = 0.5;
  assert_int_equal(motor.cycles_until_away(), kRunawayCycles);
}
