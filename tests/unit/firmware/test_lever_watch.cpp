// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/inputs/lever_watch.hpp"

#include "tests/unit/cmocka_cpp.hpp"

using Levers = std::array<double, kDriveCount>;

constexpr double kPeriod_s = 0.01;
constexpr double kAlive_s = 0.1;

/// Cycles in a row with these levers, as followed; true once it has been seen.
bool seen_in(LeverWatch& watch, const Levers& levers, int cycles, bool followed = true,
             double alive_s = kAlive_s) {
  bool seen = false;
  for (int n = 0; n < cycles; ++n) {
    seen = levers_stand_still(alive_s, followed, levers, kPeriod_s, watch) || seen;
  }
  return seen;
}

TEST(levers_that_stay_the_same_are_seen) {
  for (const Levers& levers : {Levers{0.4, 0.0, 0.0, 0.0}, Levers{0.0, 0.0, 0.0, -1.0}}) {
    LeverWatch watch;
    // The first cycle shows them, ten more are its time.
    assert_false(seen_in(watch, levers, 11));
    assert_true(seen_in(watch, levers, 2));
    assert_true(seen_in(watch, levers, 1));
  }
}

TEST(its_time_itself_is_well, LeverWatch watch) {
  const Levers levers = {0.4, 0.0, 0.0, 0.0};
  assert_false(levers_stand_still(0.125, true, levers, 0.0625, watch));
  assert_false(levers_stand_still(0.125, true, levers, 0.125, watch));
  assert_true(levers_stand_still(0.125, true, levers, 0.0625, watch));
  // Less than no time is no promise.
  assert_false(levers_stand_still(-0.125, true, {}, 0.0625, watch));
}

/// One that moves shows that all are read; frames come every second cycle.
TEST(one_that_changes_is_enough) {
  LeverWatch watch;
  Levers levers = {0.4, -1.0, 0.0, 0.0};
  for (int n = 0; n < 100; ++n) {
    levers[0] = n % 2 == 0 ? 0.4 : 0.392;
    assert_false(seen_in(watch, levers, 10));
  }
}

TEST(levers_in_their_middle_may_stand) {
  LeverWatch watch;
  assert_false(seen_in(watch, {}, 100));
  assert_false(seen_in(watch, {0.4, 0.0, 0.0, 0.0}, 9));
  assert_false(seen_in(watch, {}, 100));
  assert_false(seen_in(watch, {0.4, 0.0, 0.0, 0.0}, 9));
}

TEST(what_does_not_lead_the_machine_may_stand) {
  LeverWatch watch;
  const Levers levers = {0.4, 0.0, 0.0, 0.0};
  assert_false(seen_in(watch, levers, 100, false));
  // From then on its time begins; shown they were before.
  assert_false(seen_in(watch, levers, 9));
  assert_true(seen_in(watch, levers, 3));
}

/// Nothing is promised.
TEST(without_a_promise_nothing_is_seen) {
  LeverWatch watch;
  assert_false(seen_in(watch, {0.4, 0.0, 0.0, 0.0}, 1000, true, 0.0));
}

/// It does not count up for good.
TEST(its_time_has_a_bound) {
  LeverWatch watch;
  assert_true(seen_in(watch, {0.4, 0.0, 0.0, 0.0}, 1000));
  assert_near(watch.same_s, 2.0 * kAlive_s, 1e-9);
}
