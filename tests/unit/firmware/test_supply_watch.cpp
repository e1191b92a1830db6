// SPDX-License-Identifier: Apache-2.0
// A drive that stands open to a pump that gives nothing.

#include "firmware/excavator/safety/supply_watch.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "firmware/excavator/safety/tuning.hpp"
#include "firmware/machine/drive_bank.hpp"
#include "tests/unit/cmocka_cpp.hpp"

constexpr double kPeriod_s = 0.0625;
constexpr double kEdge = 0.25;  // Duty at which the spool begins to open.

/// Asked for 0.1 m/s, wide open, standing, with nothing in the side that is fed.
struct Drive {
  DriveRow row;
  ValidDrive seen;
  SupplyState state;
  double asked_mps = 0.1;

  explicit Drive(double way = 1.0) {
    const double opening[] = {0.0, 1.0};
    const double duty[] = {kEdge, 1.0};
    assert_int_equal(row.answer.extend.spool_to_duty.fill(opening, duty, 2),
                     MonotoneTable::Fill::kOk);
    row.answer.retract = row.answer.extend;
    seen.load_known = true;
    seen.stroke_m = 0.5;
    asked_mps = way * 0.1;
    seen.spool_ratio = way * 0.75;
    (way > 0.0 ? seen.rod_pressure_pa : seen.cap_pressure_pa) = 10e6;
  }
  double& fed_pa() { return asked_mps > 0.0 ? seen.cap_pressure_pa : seen.rod_pressure_pa; }
  bool step(double period_s = kPeriod_s) {
    return watch_supply(row, seen, asked_mps, period_s, state);
  }
  bool is_seen() {
    bool gets_nothing = false;
    for (int n = 0; n < 10; ++n) {
      gets_nothing = step();
    }
    return gets_nothing;
  }
};

/// For more than 0.3 s.
TEST(one_that_stands_unfed_gets_nothing) {
  for (const double way : {1.0, -1.0}) {
    Drive drive(way);
    assert_false(drive.step(0.3));
    assert_true(drive.step(1e-9));
    assert_true(drive.step());
    // As soon as it is fed, and for as long as it was not.
    drive.fed_pa() = 10e6;
    assert_false(drive.step());
    assert_near(drive.state.starved_s, 0.3 + 1e-9, 0.07);
  }
}

TEST(a_spool_that_is_told_may_be_late, Drive drive) {
  drive.row.watch.spool_late_s = 0.5;
  assert_false(drive.step(0.8));
  assert_true(drive.step(1e-9));
}

TEST(a_spool_that_is_not_measured_has_to_arrive, Drive drive) {
  drive.row.watch.senses_spool = false;
  drive.row.watch.settle_s = 0.125;
  drive.row.answer.retract.dead_time_s = 0.375;
  const double arrives_s = spool_arrives_s(drive.row);
  assert_true(arrives_s > 0.499);
  assert_false(drive.step(kSupplyStarved_s + arrives_s));
  assert_true(drive.step(1e-9));
}

/// What it has stood is not forgotten in one cycle, and is in as many as it took.
TEST(what_it_has_stood_wears_off, Drive drive) {
  drive.step(0.25);
  drive.seen.load_known = false;
  drive.step(0.125);
  assert_near(drive.state.starved_s, 0.125, 1e-12);
  drive.step(0.5);
  assert_near(drive.state.starved_s, 0.0, 0.0);
}

TEST(each_sign_is_needed) {
  for (const double way : {1.0, -1.0}) {
    assert_true(Drive(way).is_seen());
    Drive fed(way);
    fed.fed_pa() = kSupplyNone_pa;
    assert_false(fed.is_seen());
    fed.fed_pa() = std::nextafter(kSupplyNone_pa, 0.0);
    assert_true(fed.is_seen());
    Drive closed(way);
    closed.seen.spool_ratio = way * (kEdge + kSupplyOpenBeyond);
    assert_false(closed.is_seen());
    closed.seen.spool_ratio = std::nextafter(closed.seen.spool_ratio, way);
    assert_true(closed.is_seen());
    Drive wrong(way);
    wrong.seen.spool_ratio = -way * 0.75;
    assert_false(wrong.is_seen());
    Drive unknown(way);
    unknown.seen.load_known = false;
    assert_false(unknown.is_seen());
    Drive unasked(way);
    unasked.asked_mps = way * kSupplyLeastAsked_mps;
    assert_false(unasked.is_seen());
    unasked.asked_mps = way * 0.5 * kSupplyLeastAsked_mps;
    assert_false(unasked.is_seen());
    unasked.asked_mps = std::nextafter(way * kSupplyLeastAsked_mps, way);
    assert_true(unasked.is_seen());
  }
  Drive broken;
  broken.asked_mps = std::numeric_limits<double>::quiet_NaN();
  assert_false(broken.is_seen());
}

/// Wherever it is, its first cycle says nothing of its speed.
TEST(it_begins_at_rest, Drive drive) {
  drive.seen.stroke_m = 100.0;
  drive.step(0.01);
  assert_near(drive.state.speed_mps, 0.0, 0.0);
  drive.seen.stroke_m = 100.001;
  drive.step(0.01);
  assert_near(drive.state.speed_mps, 0.1 * 0.01 / 0.11, 1e-9);
}

/// Low-passed: a tenth of what it is asked is no standing; back is.
TEST(one_that_moves_is_well) {
  for (const double way : {1.0, -1.0}) {
    for (const double share : {1.0, 0.11, 0.09, -0.5}) {
      Drive drive(way);
      bool gets_nothing = false;
      for (int n = 0; n < 200; ++n) {
        drive.seen.stroke_m += share * drive.asked_mps * 0.01;
        gets_nothing = drive.step(0.01);
      }
      assert_int_equal(gets_nothing, share < 0.1);
    }
  }
}

/// What goes with just that share of it is fed.
TEST(a_tenth_is_fed) {
  for (const double way : {1.0, -1.0}) {
    Drive drive(way);
    const double least_mps = way * kSupplyStarvedShare * 0.1;
    drive.state.begun = true;
    drive.state.speed_mps = least_mps;
    drive.seen.stroke_m = least_mps;
    assert_false(drive.step(1.0));
    drive.state.speed_mps = drive.seen.stroke_m = std::nextafter(least_mps, 0.0);
    drive.state.stroke_m = 0.0;
    assert_true(drive.step(1.0));
  }
}

TEST(a_cycle_of_no_length_changes_nothing, Drive drive) {
  drive.is_seen();
  const SupplyState before = drive.state;
  drive.seen.stroke_m = 0.7;
  for (const double period_s : {0.0, -0.1}) {
    assert_false(drive.step(period_s));
    assert_near(drive.state.stroke_m, before.stroke_m, 0.0);
    assert_near(drive.state.starved_s, before.starved_s, 0.0);
  }
}

/// Two drives of a machine, fed and asked for 0.1 m/s each, of which none moves.
struct Drives {
  Drive one{1.0};
  Drive other{-1.0};
  std::array<DriveRow, 2> row{};
  std::array<ValidDrive, 2> seen{};
  std::array<double, 2> asked_mps = {0.1, -0.1};
  std::array<double, 2> moves_mps{};
  SuppliesState state;
  bool held = false;

  Drives() {
    one.fed_pa() = other.fed_pa() = 10e6;
    row = {one.row, other.row};
    seen = {one.seen, other.seen};
  }
  bool step(double period_s = 0.01) {
    for (unsigned i = 0; i < 2; ++i) {
      seen[i].stroke_m += period_s * moves_mps[i];
    }
    return watch_supplies({row.data(), 2}, seen, asked_mps, held, period_s, state);
  }
  /// Cycles until it is seen; 0: not within 4 s.
  int cycles_until_seen() {
    for (int n = 1; n <= 400; ++n) {
      if (step()) {
        return n;
      }
    }
    return 0;
  }
};

/// 25 mm at 0.1 m/s, and 10 mm behind the low-pass.
TEST(pumps_that_feed_none_move_none, Drives drives) {
  assert_in_range(drives.cycles_until_seen(), 33, 37);
  Drives pushed;
  pushed.moves_mps = {0.0, 0.1};
  const int pushed_cycles = pushed.cycles_until_seen();
  assert_in_range(pushed_cycles, 30, 36);
  // As late as the slowest valve that is asked.
  for (unsigned late = 0; late < 2; ++late) {
    Drives slow;
    SpoolAnswers& answer = slow.row[late].answer;
    (late == 0 ? answer.extend : answer.retract).dead_time_s = 0.25;
    (late == 0 ? answer.extend : answer.retract).lag_s = 0.125;
    assert_in_range(slow.cycles_until_seen(), 68, 69);
  }
  // The bound itself is none.
  Drives bound;
  bound.state.drive[0].begun = bound.state.drive[1].begun = true;
  bound.state.unmoved_m = kSupplyUnmoved_m;
  bound.state.stood_s = 1.0;
  for (unsigned i = 0; i < 2; ++i) {
    bound.state.drive[i].stroke_m = bound.seen[i].stroke_m;
    bound.state.drive[i].asked_mps = bound.asked_mps[i];
  }
  assert_false(bound.step(0.0));
  assert_near(bound.state.unmoved_m, kSupplyUnmoved_m, 0.0);
  assert_true(bound.step(1e-9));
  // Nor are drives that are not there looked at.
  assert_false(bound.state.drive[2].begun);
  bound.state.stood_s = kSupplyStarved_s;
  assert_false(bound.step(0.0));
  assert_true(bound.step(1e-9));
}

/// Three as well as two.
TEST(all_that_are_asked_stand) {
  const Drives two;
  const std::array<DriveRow, 3> row = {two.row[0], two.row[1], two.row[0]};
  const std::array<ValidDrive, 3> seen = {two.seen[0], two.seen[1], two.seen[0]};
  const std::array<double, 3> asked_mps = {0.1, -0.1, 0.1};
  SuppliesState state;
  bool stands = false;
  for (int n = 0; n < 100; ++n) {
    stands = watch_supplies({row.data(), 3}, seen, asked_mps, false, 0.01, state);
  }
  assert_true(stands);
}

/// Asked, and at speeds that stay, for so long that standing would be seen.
Drives at_their_bounds(double asked_mps, double share) {
  Drives drives;
  drives.asked_mps = {asked_mps, -asked_mps};
  for (unsigned i = 0; i < 2; ++i) {
    const double moves_mps = i == 0 ? share * asked_mps : 0.0;
    drives.moves_mps[i] = moves_mps;
    drives.seen[i].stroke_m = 0.0;
    drives.state.drive[i] = {0.0, moves_mps, 0.0, drives.asked_mps[i], true};
  }
  drives.state.unmoved_m = drives.state.stood_s = 1.0;
  return drives;
}

TEST(their_bounds_are_well) {
  assert_true(at_their_bounds(0.1, 0.0).step(1.0));
  assert_false(at_their_bounds(0.1, kSupplyStandsShare).step(1.0));
  assert_false(at_their_bounds(kSupplyLeastAsked_mps, 0.0).step(1.0));
  assert_false(at_their_bounds(0.5 * kSupplyLeastAsked_mps, 0.0).step(1.0));
  assert_true(at_their_bounds(std::nextafter(kSupplyLeastAsked_mps, 1.0), 0.0).step(1.0));
}

TEST(one_that_goes_is_enough) {
  for (unsigned goes = 0; goes < 2; ++goes) {
    Drives drives;
    drives.moves_mps[goes] = 0.5 * drives.asked_mps[goes];
    assert_int_equal(drives.cycles_until_seen(), 0);
    // What alone is asked may have a sensor that stands.
    drives.asked_mps[goes] = drives.moves_mps[goes] = 0.0;
    assert_int_equal(drives.cycles_until_seen(), 0);
  }
}

TEST(what_is_not_asked_or_held_may_stand) {
  Drives idle;
  idle.asked_mps = {0.0039, -0.0039};
  assert_int_equal(idle.cycles_until_seen(), 0);
  idle.asked_mps = {};
  idle.moves_mps = {0.01, 0.01};
  assert_int_equal(idle.cycles_until_seen(), 0);
  Drives held;
  held.held = true;
  assert_int_equal(held.cycles_until_seen(), 0);
  assert_near(held.state.unmoved_m, 0.0, 0.0);
}

/// Two stand; the third's load is not known, but it goes, so its pump feeds it.
TEST(one_that_goes_is_fed_whatever_its_load) {
  const Drives two;
  const std::array<DriveRow, 3> row = {two.row[0], two.row[1], two.row[0]};
  std::array<ValidDrive, 3> seen = {two.seen[0], two.seen[1], two.seen[0]};
  seen[2].load_known = false;
  const std::array<double, 3> asked_mps = {0.1, -0.1, 0.1};
  for (const bool goes : {true, false}) {
    SuppliesState state;
    bool stands = false;
    for (int n = 0; n < 100; ++n) {
      seen[2].stroke_m += goes ? 0.001 : 0.0;
      stands = watch_supplies({row.data(), 3}, seen, asked_mps, false, 0.01, state);
    }
    assert_int_equal(stands, !goes);
  }
}

/// Whose load is not known may be held by it; under an open bypass it waits for its line.
TEST(what_may_stand_is_not_counted) {
  for (unsigned which = 0; which < 2; ++which) {
    Drives unknown;
    unknown.seen[which].load_known = false;
    assert_int_equal(unknown.cycles_until_seen(), 0);
    Drives waits;
    waits.row[which].spool.bypass_closes_at = {0.5, 0.5};
    assert_int_equal(waits.cycles_until_seen(), 0);
  }
}

/// Either drive, while the other one goes.
TEST(one_that_is_starved_is_enough) {
  for (unsigned starves = 0; starves < 2; ++starves) {
    Drives drives;
    drives.moves_mps[1 - starves] = drives.asked_mps[1 - starves];
    drives.seen[starves].cap_pressure_pa = drives.seen[starves].rod_pressure_pa = 0.0;
    assert_in_range(drives.cycles_until_seen(), 30, 33);
    // The other one stands too, and is not far behind.
    Drives stand;
    stand.asked_mps = {0.01, -0.01};
    stand.seen[starves].cap_pressure_pa = stand.seen[starves].rod_pressure_pa = 0.0;
    assert_in_range(stand.cycles_until_seen(), 30, 33);
  }
}
