// SPDX-License-Identifier: Apache-2.0
// From a spool's travel to its opening and back.

#include "firmware/drives/spool_opening.hpp"

#include "tests/unit/firmware/two_sides.hpp"

/// In the dead band, along the table, and a little beyond its end.
TEST(opening_and_travel_turn_into_each_other) {
  const SpoolAnswers answer = test::two_sides();
  for (const SpoolAnswer* side : {&answer.extend, &answer.retract}) {
    double last = -1.0;
    for (int n = 0; n <= 100; ++n) {
      const double opening = opening_at(*side, 0.01 * n);
      assert_true(opening > last);
      assert_near(duty_at(*side, opening), 0.01 * n, 1e-12);
      last = opening;
    }
    assert_near(last, 1.0, 1e-12);
    assert_near(opening_at(*side, side->edge()), 0.0, 0.0);
    assert_near(opening_at(*side, 0.0), -side->edge() / (1.0 - side->edge()), 1e-12);
  }
  assert_near(opening_at(answer.extend, 0.75), 0.625, 1e-12);
  assert_near(opening_at(answer.extend, 1.02), 1.03, 1e-12);
  assert_near(duty_at(answer.extend, 1.03), 1.0, 0.0);
}

TEST(straight_is_straight_to_both_sides) {
  const SpoolAnswers answer = straight_answers(0.25, 0.1, 0.05);
  assert_true(answer.same_times());
  for (const SpoolAnswer* side : {&answer.extend, &answer.retract}) {
    assert_near(side->edge(), 0.25, 0.0);
    assert_near(duty_at(*side, 0.5), 0.625, 1e-12);
    assert_near(duty_at(*side, 1.0), 1.0, 0.0);
    assert_near(side->dead_time_s, 0.1, 0.0);
    assert_near(side->lag_s, 0.05, 0.0);
  }
}

/// The steeper of two parts where both are within the range.
TEST(the_steepest_part_within_the_range_counts) {
  const SpoolAnswer side = test::two_sides().extend;
  assert_near(least_travel_per_opening(side, 0.41, 0.49), 0.4, 1e-12);
  assert_near(least_travel_per_opening(side, 0.51, 0.6), 2.0 / 3.0, 1e-12);
  assert_near(least_travel_per_opening(side, 0.49, 0.6), 0.4, 1e-12);
  assert_near(least_travel_per_opening(side, 0.1, 0.2), 0.4, 1e-12);
  assert_near(least_travel_per_opening(side, 0.98, 1.1), 2.0 / 3.0, 1e-12);
}
