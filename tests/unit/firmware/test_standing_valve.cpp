// SPDX-License-Identifier: Apache-2.0
// Dead bands of cylinders that stand in the air under a spool at its edge.

#include "firmware/drives/learnt/learnt_valve.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/two_sides.hpp"

constexpr double kPeriod_s = 0.01;
constexpr double kEdge = 0.2;
constexpr double kOpening = 0.03;

/// A cylinder that does not move, its spool so far open.
struct Standing {
  DriveRow row;
  LearntValve valve;
  double opening = kOpening;

  Standing() {
    const double opens[] = {0.0, 1.0};
    const double duty[] = {kEdge, 1.0};
    assert_int_equal(row.answer.extend.spool_to_duty.fill(opens, duty, 2),
                     MonotoneTable::Fill::kOk);
    row.answer.retract = row.answer.extend;
    row.metering.opening_exponent = 1.6;
    row.answer.extend.lag_s = 0.03;
    row.answer.retract.lag_s = 0.03;
  }
  /// The end of its dead band after so long.
  double wait(double time_s, double asked_mps, LearntFrom from = LearntFrom::kAnyMotion) {
    ValidDrive seen;
    seen.spool_ratio = kEdge + (1.0 - kEdge) * opening;
    for (double t_s = 0.0; t_s < time_s; t_s += kPeriod_s) {
      next_learnt(row, seen, {asked_mps, opening}, from, kPeriod_s, valve);
    }
    return valve.extend.edge;
  }
};

TEST(what_stands_in_the_air_moves_its_edge_to_where_its_spool_is) {
  Standing stands;
  // What is asked for comes late, and steps of a stroke come seldom.
  assert_near(stands.wait(0.3, 0.006), 0.0, 0.0);
  const double soon = stands.wait(1.0, 0.006);
  assert_true(soon > 0.008 && soon < 0.025);
  assert_near(stands.wait(9.0, 0.006), kOpening, 1e-3);
}

TEST(never_farther_than_an_edge_may_be_off) {
  Standing stands;
  stands.opening = 0.5;
  assert_near(stands.wait(20.0, 0.006), 0.07, 1e-12);
}

TEST(a_load_may_hold_what_stands) {
  Standing pressed;
  assert_near(pressed.wait(9.0, 0.006, LearntFrom::kPlainMotion), 0.0, 0.0);
}

TEST(of_what_nothing_is_asked_nothing_is_learnt) {
  Standing parked;
  assert_near(parked.wait(9.0, 0.001), 0.0, 0.0);
}
