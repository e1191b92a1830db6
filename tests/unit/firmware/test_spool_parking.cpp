// SPDX-License-Identifier: Apache-2.0
// Spools that wait at the edge of their dead band instead of following every correction.

#include "firmware/drives/spool_parking.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/two_sides.hpp"

constexpr double kPeriod_s = 0.01;
constexpr double kFast = 1.0;

DriveRow drive_row() {
  DriveRow row;
  const double opens[] = {0.0, 1.0};
  const double duty[] = {0.2, 1.0};
  assert_int_equal(row.answer.extend.spool_to_duty.fill(opens, duty, 2), MonotoneTable::Fill::kOk);
  row.answer.retract = row.answer.extend;
  return row;
}

/// Reversals a second that a correction of this size comes through with, if it changes sign in
/// every tenth of a second.
double reversals_ps(double correction_mps, double wanted_mps = 0.0) {
  constexpr int kSeconds = 30;
  ParkingState state;
  int reversals = 0;
  int side = 0;
  for (int n = 0; n < 100 * kSeconds; ++n) {
    const double way = n / 10 % 2 == 0 ? 1.0 : -1.0;
    if (!park(way * wanted_mps, way * correction_mps, kFast, kPeriod_s, state) &&
        state.side != side) {
      reversals += side != 0 ? 1 : 0;
      side = state.side;
    }
  }
  return static_cast<double>(reversals) / kSeconds;
}

TEST(corrections_that_alternate_reverse_seldom) {
  assert_true(reversals_ps(0.010) < 0.6);
  assert_true(reversals_ps(0.030) < 1.2);
  assert_true(reversals_ps(0.010) > 0.0);
}

/// What is worth it goes through, and so does what the path wants.
TEST(large_corrections_and_the_path_pass) {
  assert_true(reversals_ps(0.041) > 9.0);
  assert_true(reversals_ps(0.010, 0.005) > 9.0);
}

/// One reversal alone is not held up, and one that waits stands until its sign is back.
TEST(only_the_second_one_waits, ParkingState state) {
  assert_false(park(0.0, 0.01, kFast, kPeriod_s, state));
  assert_int_equal(state.side, 1);
  assert_true(park(0.0, -0.01, kFast, kPeriod_s, state));
  assert_true(state.parked);
  assert_int_equal(state.side, 1);
  assert_false(park(0.0, 0.002, kFast, kPeriod_s, state));
  assert_false(state.parked);
}

/// What has not reversed for long does at once.
TEST(calm_forgets, ParkingState state) {
  repeat(2000, [&] { static_cast<void>(park(0.0, 0.01, kFast, kPeriod_s, state)); });
  assert_false(park(0.0, -0.001, kFast, kPeriod_s, state));
  assert_int_equal(state.side, -1);
}

/// At a quarter of the pace a quarter of the path's speed turns a spool, and half of the
/// correction.
TEST(a_slow_path_turns_with_less) {
  for (const double pace : {1.0, 0.25}) {
    const double path_mps = 0.003 * pace;
    ParkingState waits{1, 1.0, false};
    assert_true(park(-0.99 * path_mps, -0.001, pace, kPeriod_s, waits));
    ParkingState turns{1, 1.0, false};
    assert_false(park(-1.01 * path_mps, -0.001, pace, kPeriod_s, turns));
    const double most_mps = 0.04 * (3.0 / 3.01) * (pace < 1.0 ? 0.5 : 1.0);
    ParkingState less{1, 1.0, false};
    assert_true(park(0.0, -0.999 * most_mps, pace, kPeriod_s, less));
    ParkingState more{1, 1.0, false};
    assert_false(park(0.0, -1.001 * most_mps, pace, kPeriod_s, more));
  }
}

TEST(it_waits_within_the_dead_band_that_was_learnt) {
  const DriveRow row = drive_row();
  LearntValve valve;
  assert_near(parked_duty(row, valve, 1), 0.14, 1e-12);
  assert_near(parked_duty(row, valve, -1), -0.14, 1e-12);
  valve.retract.edge = 0.05;
  assert_near(parked_duty(row, valve, -1), -0.168, 1e-12);
  valve.extend.edge = -0.07;
  assert_near(parked_duty(row, valve, 1), 0.7 * 0.144, 1e-12);
  assert_near(parked_duty(row, valve, 0), 0.0, 0.0);
}

TEST(each_side_has_its_own_edge, DriveRow row) {
  row.answer = test::two_sides();
  LearntValve valve;
  assert_near(parked_duty(row, valve, 1), 0.7 * 0.4, 1e-12);
  assert_near(parked_duty(row, valve, -1), -0.7 * 0.25, 1e-12);
  valve.extend.edge = 0.05;
  assert_near(parked_duty(row, valve, 1), 0.7 * 0.42, 1e-12);
}
