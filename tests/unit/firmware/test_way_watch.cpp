// SPDX-License-Identifier: Apache-2.0
// A drive's stroke against what was asked of it.

#include "firmware/drives/way_watch.hpp"

#include <cmath>

#include "firmware/drives/tuning.hpp"
#include "tests/unit/cmocka_cpp.hpp"

constexpr double kCycle_s = 0.01;

/// A drive that does what it is asked, and a sensor that shows it as told.
struct Asked {
  DriveRow row;
  ValidDrive seen;
  WayState state;
  double gain = 1.0;  ///< Of what it shows over what it does.
  bool held = false;
  bool is_off = false;

  Asked() {
    row.watch.way_m = 0.03;
    row.watch.fastest_mps = 0.5;
    row.watch.relief_pa = 30e6;
    seen.stroke_m = 0.5;
  }
  void go(double asked_mps) {
    seen.stroke_m += gain * asked_mps * kCycle_s;
    is_off = watch_way(row, seen, {asked_mps, held}, kCycle_s, state);
  }
  /// Way that was asked until it is seen; at most 1 m.
  double seen_after_m(double asked_mps) {
    double way_m = 0.0;
    for (is_off = false; !is_off && way_m < 1.0; way_m += std::abs(asked_mps) * kCycle_s) {
      go(asked_mps);
    }
    return way_m;
  }
};

TEST(a_drive_that_does_what_it_is_asked_is_right, Asked drive) {
  for (int n = 0; n < 4000; ++n) {
    drive.go(0.3 * std::sin(0.01 * n));
    assert_false(drive.is_off);
  }
}

/// 0.03 m over 1 - 0.2, and what creeps.
TEST(one_that_stands_is_off_by_its_bound, Asked drive) {
  drive.gain = 0.0;
  for (const double way : {1.0, -1.0}) {
    Asked stands = drive;
    assert_near(stands.seen_after_m(0.3 * way), 0.03 / (0.8 - 0.005 / 0.3), 0.005);
    Asked slow = drive;
    assert_near(slow.seen_after_m(0.03 * way), 0.03 / (0.8 - 0.005 / 0.03), 0.012);
  }
}

TEST(half_and_twice_are_seen, Asked drive) {
  for (const double gain : {0.5, 2.0}) {
    for (const double way : {1.0, -1.0}) {
      Asked lies = drive;
      lies.gain = gain;
      assert_true(lies.seen_after_m(0.3 * way) < 0.2);
    }
  }
  for (const double gain : {0.9, 1.1}) {
    Asked other = drive;
    other.gain = gain;
    assert_true(other.seen_after_m(0.3) >= 1.0);
  }
}

TEST(one_that_drifts_is_seen, Asked drive) {
  int cycles = 0;
  while (!drive.is_off && cycles < 1000) {
    drive.seen.stroke_m += 0.05 * kCycle_s;
    drive.go(0.0);
    ++cycles;
  }
  assert_in_range(cycles, 60, 80);
}

/// Its load slows what presses; throws it none.
TEST(what_presses_may_fall_short, Asked drive) {
  drive.gain = 0.0;
  drive.seen.load_known = true;
  drive.seen.cap_pressure_pa = 0.4 * drive.row.watch.relief_pa;
  Asked retracts = drive;
  Asked unknown = drive;
  Asked without = drive;
  Asked thrown = drive;
  assert_true(drive.seen_after_m(0.3) >= 1.0);
  assert_true(retracts.seen_after_m(-0.3) < 0.1);
  retracts.seen.rod_pressure_pa = retracts.seen.cap_pressure_pa;
  retracts.state = {};
  assert_true(retracts.seen_after_m(-0.3) >= 1.0);
  unknown.seen.load_known = false;
  assert_true(unknown.seen_after_m(0.3) < 0.1);
  without.row.watch.relief_pa = 0.0;
  assert_true(without.seen_after_m(0.3) < 0.1);
  thrown.gain = 2.0;
  assert_true(thrown.seen_after_m(0.3) < 0.2);
}

TEST(what_is_held_is_left_out, Asked drive) {
  drive.gain = 0.0;
  drive.held = true;
  assert_true(drive.seen_after_m(0.3) >= 1.0);
  drive.held = false;
  assert_true(drive.seen_after_m(0.3) < 0.1);
}

/// What it is off wears off with its time constant.
TEST(what_is_off_is_forgotten, Asked drive) {
  drive.go(0.0);
  drive.state.behind_m = drive.state.ahead_m = 0.02;
  drive.row.watch.fastest_mps = 0.0;
  repeat(600, [&] { drive.go(0.0); });
  assert_near(drive.state.behind_m, 0.02 * std::exp(-6.0 / kWayForget_s), 1e-4);
  assert_near(drive.state.ahead_m, drive.state.behind_m, 1e-15);
}

TEST(a_row_without_a_bound_is_not_looked_at, Asked drive) {
  drive.row.watch.way_m = 0.0;
  drive.gain = 0.0;
  assert_true(drive.seen_after_m(0.3) >= 1.0);
  assert_false(drive.state.begun);
  drive.row.watch.way_m = 0.03;
  assert_false(watch_way(drive.row, drive.seen, {0.3, false}, 0.0, drive.state));
  assert_false(drive.state.begun);
}

/// It is begun where the drive is, and lags as the drive's side does.
TEST(it_begins_where_the_drive_is, Asked drive) {
  drive.row.answer.extend.lag_s = 0.2;
  drive.gain = 0.0;
  drive.go(0.3);
  assert_near(drive.state.behind_m, 0.0, 1e-12);
  assert_near(drive.state.late_mps[0], 0.3 * 0.01 / 0.11, 1e-12);
  assert_near(drive.state.late_mps[1], 0.3 * 0.01 / 0.11 * 0.01 / 0.11, 1e-12);
  drive.state = {};
  drive.go(-0.3);
  assert_near(drive.state.late_mps[1], -0.3, 1e-12);
}
