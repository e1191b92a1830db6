// SPDX-License-Identifier: Apache-2.0
// A drive that its oil pushes against its open spool.

#include "firmware/drives/direction_watch.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/two_sides.hpp"

using namespace graben::test;

constexpr double kEdge = 0.2;
constexpr double kStep_m = 1.0 / 1024.0;
constexpr double kPeriod_s = 0.01;

/// Equal sides.
struct Bench {
  DriveRow row;
  ValidDrive seen;
  DirectionState state;

  Bench() {
    row.extend_area_m2 = 0.25;
    row.retract_area_m2 = 0.25;
    const double opens[] = {0.0, 1.0};
    const double duty[] = {kEdge, 1.0};
    assert_int_equal(row.answer.extend.spool_to_duty.fill(opens, duty, 2),
                     MonotoneTable::Fill::kOk);
    row.answer.retract = row.answer.extend;
    row.watch.wrong_m = 3.5 * kStep_m;
    seen.stroke_m = 0.5;
    seen.load_known = true;
    seen.stroke_is_new = true;
    open(0.5);
    push(-3e6);
  }

  void open(double spool_ratio) { seen.spool_ratio = spool_ratio; }
  void push(double difference_pa) {
    seen.cap_pressure_pa = 10e6 + difference_pa;
    seen.rod_pressure_pa = 10e6;
  }
  FaultSet move(double by_m) {
    seen.stroke_m += by_m;
    return watch_direction({&row, 1}, {&seen, 1}, kPeriod_s, {&state, 1});
  }
  /// True: stopped by the last of `count` steps, by none before it.
  bool stops_after(int count, double by_m) {
    bool stopped = false;
    for (int n = 0; n < count; ++n) {
      assert_false(stopped);
      const FaultSet faults = move(by_m);
      stopped = faults.has(Fault::kWrongDirection);
      assert_true(stopped || faults.empty());
    }
    return stopped;
  }
};

TEST(oil_that_pushes_against_the_spool_stops, Bench bench) {
  bench.move(0.0);
  bench.move(0.0);
  assert_true(bench.stops_after(4, -kStep_m));
}

TEST(the_other_way_is_as_wrong, Bench bench) {
  bench.open(-0.5);
  bench.push(3e6);
  bench.move(0.0);
  bench.move(0.0);
  assert_true(bench.stops_after(4, kStep_m));
}

TEST(what_goes_with_the_spool_makes_up_for_it, Bench bench) {
  bench.move(0.0);
  bench.move(0.0);
  assert_false(bench.stops_after(3, -kStep_m));
  assert_false(bench.stops_after(2, kStep_m));
  assert_false(bench.stops_after(2, -kStep_m));
  assert_true(bench.stops_after(1, -kStep_m));
}

/// A drive that shakes has gone with its spool before it swings back; up to four bounds count.
TEST(what_it_went_before_is_set_off, Bench bench) {
  bench.move(0.0);
  assert_false(bench.stops_after(7, kStep_m));
  assert_true(bench.stops_after(11, -kStep_m));
  Bench farther;
  farther.move(0.0);
  assert_false(farther.stops_after(50, kStep_m));
  assert_true(farther.stops_after(18, -kStep_m));
}

TEST(a_load_that_pushes_back_is_no_fault, Bench bench) {
  bench.push(3e6);
  bench.move(0.0);
  bench.move(0.0);
  assert_false(bench.stops_after(50, -kStep_m));
}

TEST(pressures_within_their_zeros_push_nowhere, Bench bench) {
  bench.push(-1.2e6);
  bench.move(0.0);
  bench.move(0.0);
  assert_false(bench.stops_after(50, -kStep_m));
  bench.push(-1.3e6);
  assert_true(bench.stops_after(4, -kStep_m));
}

TEST(a_drive_that_coasts_is_let_go_on_until_it_turns, Bench bench) {
  assert_false(bench.stops_after(50, -kStep_m));
  assert_false(bench.stops_after(1, kStep_m));
  assert_true(bench.stops_after(5, -kStep_m));
}

TEST(a_spool_within_its_dead_band_leads_nowhere, Bench bench) {
  for (const double spool_ratio : {0.0, 0.1, -0.1, kEdge, -kEdge}) {
    bench.open(spool_ratio);
    for (const double push_pa : {-3e6, 3e6}) {
      bench.push(push_pa);
      bench.move(0.0);
      assert_false(bench.stops_after(20, -kStep_m));
      bench.move(0.0);
      assert_false(bench.stops_after(20, kStep_m));
    }
  }
  bench.push(-3e6);
  bench.open(kEdge + 0.031);
  bench.move(0.0);
  bench.move(0.0);
  assert_true(bench.stops_after(4, -kStep_m));
}

/// Closed in between, to its edge, it begins anew.
TEST(a_spool_that_closes_begins_anew) {
  for (const double closed : {0.1, kEdge}) {
    Bench bench;
    bench.move(0.0);
    bench.move(0.0);
    assert_false(bench.stops_after(3, -kStep_m));
    bench.open(closed);
    bench.move(0.0);
    bench.open(0.5);
    bench.move(0.0);
    bench.move(0.0);
    assert_false(bench.stops_after(3, -kStep_m));
  }
}

/// Where a dead band ends is known within 3 % of the travel, a motor's too.
TEST(a_spool_near_its_edge_may_be_closed, Bench bench) {
  bench.open(kEdge + 0.029);
  bench.move(0.0);
  bench.move(0.0);
  assert_false(bench.stops_after(20, -kStep_m));
  Bench motor;
  motor.row.control.has_end_stops = false;
  motor.open(kEdge + 0.029);
  motor.move(0.0);
  motor.move(0.0);
  assert_false(motor.stops_after(4, -kStep_m));
  motor.open(kEdge + 0.031);
  motor.move(0.0);
  motor.move(0.0);
  assert_true(motor.stops_after(4, -kStep_m));
}

TEST(another_side_begins_anew, Bench bench) {
  bench.move(0.0);
  bench.move(0.0);
  assert_false(bench.stops_after(3, -kStep_m));
  bench.open(-0.5);
  assert_false(bench.stops_after(3, -kStep_m));
  bench.open(0.5);
  assert_false(bench.stops_after(50, -kStep_m));
}

TEST(a_stroke_that_did_not_come_says_nothing, Bench bench) {
  bench.move(0.0);
  bench.move(0.0);
  bench.seen.stroke_is_new = false;
  assert_false(bench.stops_after(50, -kStep_m));
}

TEST(without_its_pressures_a_drive_is_not_checked, Bench bench) {
  bench.move(0.0);
  bench.move(0.0);
  assert_false(bench.stops_after(3, -kStep_m));
  bench.seen.load_known = false;
  assert_false(bench.stops_after(1, -kStep_m));
  bench.seen.load_known = true;
  assert_false(bench.stops_after(50, -kStep_m));
}

TEST(at_its_bound_it_is_sound, Bench bench) {
  bench.row.watch.wrong_m = 4.0 * kStep_m;
  bench.move(0.0);
  bench.move(0.0);
  assert_true(bench.stops_after(5, -kStep_m));
}

void leave_oil(double cap_m, double rod_m, Bench& bench) {
  bench.row.control.has_end_stops = true;
  bench.row.least_travel_m = bench.seen.stroke_m - (cap_m - 0.15);
  bench.row.most_travel_m = bench.seen.stroke_m + (rod_m - 0.15);
}

/// 0.5 m of soft oil that lets off by 4.2 MPa has moved its drive by 3.5 mm; a fifth of what it let
/// off is forgotten by then. The other side holds more of it.
TEST(oil_that_lets_off_has_moved_it) {
  for (const double way : {1.0, -1.0}) {
    for (const double let_off_pa : {4e6, 6e6}) {
      Bench bench;
      bench.row.watch.wrong_m = 0.5 * kStep_m;
      bench.open(0.5 * way);
      leave_oil(way > 0.0 ? 2.0 : 0.5, way > 0.0 ? 0.5 : 2.0, bench);
      double& pushes_pa = way > 0.0 ? bench.seen.rod_pressure_pa : bench.seen.cap_pressure_pa;
      double& other_pa = way > 0.0 ? bench.seen.cap_pressure_pa : bench.seen.rod_pressure_pa;
      pushes_pa = 20e6;
      other_pa = 10e6;
      bench.move(0.0);
      bench.move(0.0);
      pushes_pa -= let_off_pa;
      repeat(12, [&] { bench.move(0.0); });
      assert_true(bench.stops_after(4, -way * kStep_m) == (let_off_pa < 5e6));
    }
  }
}

TEST(what_it_let_off_long_ago_is_forgotten, Bench bench) {
  leave_oil(0.5, 0.5, bench);
  bench.seen.rod_pressure_pa = 30e6;
  bench.move(0.0);
  bench.seen.rod_pressure_pa = 20e6;
  repeat(300, [&] { bench.move(0.0); });
  assert_true(bench.stops_after(4, -kStep_m));
}

TEST(a_side_that_presses_harder_lets_nothing_off, Bench bench) {
  leave_oil(0.5, 0.5, bench);
  bench.move(0.0);
  bench.move(0.0);
  bench.seen.rod_pressure_pa = 20e6;
  assert_true(bench.stops_after(4, -kStep_m));
}

TEST(a_motor_hangs_on_no_spring, Bench bench) {
  bench.row.control.has_end_stops = false;
  bench.seen.rod_pressure_pa = 30e6;
  bench.move(0.0);
  bench.seen.rod_pressure_pa = 20e6;
  bench.move(0.0);
  assert_true(bench.stops_after(4, -kStep_m));
}

TEST(only_its_drives_are_watched) {
  const Bench bench;
  const DriveRow rows[] = {bench.row, bench.row};
  const ValidDrive seen[] = {bench.seen, bench.seen};
  DirectionState states[2];
  static_cast<void>(watch_direction({rows, 1}, {seen, 1}, 0.01, {states, 1}));
  assert_int_equal(states[0].side, 1);
  assert_int_equal(states[1].side, 0);
}

TEST(a_drive_without_a_bound_is_not_checked, Bench bench) {
  bench.row.watch.wrong_m = 0.0;
  bench.move(0.0);
  assert_false(bench.stops_after(50, -kStep_m));
}

/// Open for certain is another travel on each side.
TEST(each_side_has_its_own_dead_band) {
  for (const double way : {1.0, -1.0}) {
    Bench bench;
    bench.row.answer = two_sides();
    bench.push(-3e6 * way);
    for (const bool opens : {false, true}) {
      const double edge = (way > 0.0 ? 0.4 : 0.25) + 0.03;
      bench.open(way * (opens ? edge + 0.001 : edge - 0.001));
      bench.move(0.0);
      bench.move(0.0);
      assert_true(bench.stops_after(4, -way * kStep_m) == opens);
    }
  }
}
