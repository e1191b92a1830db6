// SPDX-License-Identifier: Apache-2.0
// Dead bands and openings that are learnt from spool and stroke.

#include "firmware/drives/learnt/learnt_valve.hpp"

#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/learnt_bench.hpp"
#include "tests/unit/firmware/two_sides.hpp"

using namespace graben::test::learnt;

/// A speed that is off says less of an opening where the bypass closes over it as well.
TEST(a_bypass_that_closes_over_the_opening_makes_speeds_steep) {
  const auto learnt_edge = [](double bypass_closes_at) {
    Bench bench;
    bench.row.spool.bypass_closes_at = {bypass_closes_at, bypass_closes_at};
    bench.extend.edge = kEdge + 0.03;
    bench.corrected = false;
    bench.work(6.0, 1.0);
    return bench.valve.extend.edge;
  };
  assert_true(learnt_edge(0.0) > 0.01);
  assert_true(learnt_edge(0.5) < 0.6 * learnt_edge(0.0));
}

/// One that stands at 0.96 of an opening tells where its dead band ends: not beyond its spool.
TEST(a_drive_that_stands_under_a_closing_bypass_shows_its_edge) {
  const auto stood_edge = [](double bypass_closes_at, double opening) {
    Bench bench;
    bench.row.spool.bypass_closes_at = {bypass_closes_at, bypass_closes_at};
    double half_way = 0.0;
    double spool = 0.0;
    for (int n = 0; n < 300; ++n) {
      half_way += 0.4 * (opening + 0.02 - half_way);  // Late by 15 ms and again: as it is told.
      spool += 0.4 * (half_way - spool);
      ValidDrive seen;
      seen.stroke_m = bench.stroke_m;
      seen.spool_ratio = kEdge + (1.0 - kEdge) * spool;
      next_learnt(bench.row, seen, {n < 100 ? 0.0 : 0.03, opening}, LearntFrom::kPlainMotion,
                  kPeriod_s, bench.valve);
    }
    return bench.valve.extend.edge;
  };
  assert_near(stood_edge(0.25, 0.22), (0.02 + 0.04 * 0.22) / (1.0 - 0.22), 1e-3);
  assert_near(stood_edge(0.0, 0.22), 0.0, 0.0);
  assert_near(std::max(stood_edge(0.25, 0.02), stood_edge(0.25, 0.92)), 0.0, 0.0);
}

TEST(a_dead_band_is_learnt_on_its_own_side) {
  for (const double edge : {0.17, 0.23}) {
    Bench bench;
    bench.extend.edge = edge;
    Bench first = bench;
    first.corrected = false;
    assert_true(std::abs(first.off(0.05)) > 0.15);
    bench.work(20.0, 1.0);
    const double beyond = (edge - kEdge) / (1.0 - kEdge);
    assert_near(opening_beyond(bench.valve.extend, 0.3), 0.7 * beyond, 0.25 * std::abs(beyond));
    assert_near(bench.off(0.05), 0.0, 0.06);
    assert_true(is_edge_known(bench.valve.extend));
    assert_near(learnt_edge_ratio(bench.row, bench.valve, true), edge - kEdge, 0.015);
    assert_false(is_edge_known(bench.valve.retract));
    assert_near(bench.valve.retract.edge, 0.0, 0.0);
    assert_near(bench.valve.retract.bend, 0.0, 0.0);
    bench.work(8.0, -1.0);
    assert_near(bench.valve.retract.edge, 0.0, 0.004);
  }
}

/// An opening counts from the dead band's end, what is told is of the whole travel.
TEST(an_edge_is_told_in_travel, Bench bench) {
  bench.valve.extend.edge = -0.05;
  assert_near(learnt_edge_ratio(bench.row, bench.valve, true), -0.05 * (1.0 - kEdge), 1e-12);
}

TEST(told_not_to_it_learns_nothing, Bench bench) {
  bench.extend.edge = kEdge + 0.03;
  assert_true(is_learnt(bench.row));
  bench.row.control.learns = false;
  assert_false(is_learnt(bench.row));
  bench.work(20.0, 1.0, LearntFrom::kAnyMotion);
  assert_near(bench.valve.extend.edge, 0.0, 0.0);
  assert_near(bench.valve.extend.edge_variance, LearntSide().edge_variance, 0.0);
}

/// A valve that was measured: what is seen at work moves it slowly, and it gets there all the same.
TEST(a_share_of_the_pace_is_learnt) {
  const auto learnt_edge = [](double share, double seconds) {
    Bench bench;
    bench.row.control.learn_share = share;
    bench.corrected = false;
    bench.extend.edge = kEdge + 0.03;
    bench.work(seconds, 1.0);
    return bench.valve.extend.edge;
  };
  const double all = learnt_edge(1.0, 10.0);
  const double share = learnt_edge(0.1, 10.0) / all;
  assert_true(share > 0.15 && share < 0.5);
  assert_true(learnt_edge(0.1, 600.0) > 0.8 * all);
}

TEST(an_exponent_is_learnt) {
  for (const double exponent : {1.4, 1.8}) {
    Bench bench;
    bench.retract.exponent = exponent;
    Bench first = bench;
    first.corrected = false;
    assert_true(std::abs(first.off(-0.05)) > 0.15);
    bench.work(10.0, -1.0);
    assert_near(bench.off(-0.05), 0.0, 0.08);
    assert_near(bench.off(-0.15), 0.0, 0.06);
  }
}

/// It is learnt, too, where nothing is done with it.
TEST(what_is_not_used_is_learnt_as_well, Bench bench) {
  bench.corrected = false;
  bench.extend.edge = 0.23;
  bench.work(20.0, 1.0);
  assert_near(opening_beyond(bench.valve.extend, 0.3), 0.7 * 0.0375, 0.007);
}

TEST(nothing_is_learnt_of_what_is_not_the_valves_doing) {
  const LearntValve fresh;
  const auto assert_fresh = [&](const Bench& bench) {
    assert_near(bench.valve.extend.edge, fresh.extend.edge, 0.0);
    assert_near(bench.valve.extend.bend, fresh.extend.bend, 0.0);
    assert_near(bench.valve.extend.edge_variance, fresh.extend.edge_variance, 0.0);
  };
  Bench held;
  held.extend.edge = 0.23;
  held.work(4.0, 1.0, LearntFrom::kNothing);
  assert_fresh(held);
  Bench closed;
  closed.extend.edge = 0.9;
  closed.work(4.0, 1.0);
  assert_near(closed.valve.extend.edge, 0.0, 0.0);
  // The gate has not let it open yet, what is thrown is faster than any valve, a spool is closed.
  struct Odd {
    LearntAsk ask;
    double spool_ratio;
  };
  for (const Odd& odd : {Odd{{0.05, 0.01}, 0.44}, Odd{{0.01, 0.3}, 0.44}, Odd{{0.05, 0.3}, 0.1}}) {
    Bench bench;
    ValidDrive seen;
    seen.spool_ratio = odd.spool_ratio;
    for (int n = 0; n < 200; ++n) {
      seen.stroke_m += 0.05 * kPeriod_s;
      next_learnt(bench.row, seen, odd.ask, n > 0 ? LearntFrom::kPlainMotion : LearntFrom::kNothing,
                  kPeriod_s, bench.valve);
    }
    assert_near(bench.valve.extend.edge, 0.0, 0.0);
  }
  Bench shakes;
  shakes.extend.edge = 0.23;
  for (int n = 0; n < 400; ++n) {
    shakes.step(n / 5 % 2 == 0 ? 0.2 : -0.2);
  }
  assert_near(shakes.valve.extend.edge, 0.0, 0.01);
  Bench metered;
  metered.row.supply = {1e-3, 1e-3};
  metered.extend.edge = 0.23;
  metered.work(4.0, 1.0);
  assert_fresh(metered);
}

/// A slow path asks a valve that opens too soon for next to nothing, as feedback takes the rest
/// back; one that opens too late does next to nothing. Where nothing presses both are learnt from.
TEST(what_is_slow_is_learnt_from_in_the_air_alone) {
  struct Slow {
    double edge;
    double asked_mps;
    double speed_mps;
  };
  for (const Slow& slow : {Slow{kEdge - 0.04, 0.002, 0.02}, Slow{kEdge + 0.04, 0.02, 0.0015}}) {
    const auto learnt = [&](LearntFrom from) {
      Bench bench;
      const double asked_opening = std::pow(slow.asked_mps / kFull_mps, 1.0 / 1.6);
      const double opened = std::pow(slow.speed_mps / kFull_mps, 1.0 / 1.6);
      ValidDrive seen;
      seen.spool_ratio = slow.edge + (1.0 - slow.edge) * opened;
      for (int n = 0; n < 500; ++n) {
        seen.stroke_m += slow.speed_mps * kPeriod_s;
        next_learnt(bench.row, seen, {slow.asked_mps, asked_opening}, from, kPeriod_s, bench.valve);
      }
      return bench.valve.extend.edge;
    };
    assert_near(learnt(LearntFrom::kPlainMotion), 0.0, 0.0);
    // A part of it: a ratio of 8 counts at most, how it opens is learnt as well.
    const double share = learnt(LearntFrom::kAnyMotion) * (1.0 - kEdge) / (slow.edge - kEdge);
    print_message("%.2f of the edge\n", share);
    assert_true(share > 0.2 && share < 1.0);
  }
}

/// However far off a valve is, and whatever the sensors say.
TEST(what_is_believed_stays_within_bounds) {
  for (const Bench::Side real : {Bench::Side{0.02, 1.0}, Bench::Side{0.33, 2.6}}) {
    Bench bench;
    bench.extend = real;
    bench.retract = real;
    for (int n = 0; n < 20; ++n) {
      bench.work(4.0, n % 2 == 0 ? 1.0 : -1.0);
      for (const LearntSide& side : {bench.valve.extend, bench.valve.retract}) {
        assert_true(std::abs(side.edge) <= 0.07 && std::abs(side.bend) <= 0.3);
        assert_true(side.edge_variance > 0.0 && side.edge_variance <= 0.03 * 0.03);
        assert_true(side.bend_variance > 0.0 && side.bend_variance <= 0.09 * 0.09);
        assert_true(std::isfinite(side.covariance));
      }
    }
  }
}

TEST(still_and_without_time_nothing_breaks, Bench bench) {
  ValidDrive seen;
  for (const double period_s : {0.0, 0.01}) {
    for (const double spool : {0.0, kEdge, 1.0, -1.0}) {
      seen.spool_ratio = spool;
      next_learnt(bench.row, seen, {0.0, 0.0}, LearntFrom::kPlainMotion, period_s, bench.valve);
      next_learnt(bench.row, seen, {0.1, 1.0}, LearntFrom::kPlainMotion, period_s, bench.valve);
    }
  }
  assert_true(std::isfinite(bench.valve.extend.edge + bench.valve.seen.speed_mps));
}

/// Over all that is believed: more opening is more duty, and the way back meets.
TEST(duties_rise_and_turn_back) {
  const Bench bench;
  for (const double edge : {-0.07, 0.0, 0.07}) {
    for (const double bend : {-0.3, 0.0, 0.3}) {
      LearntValve valve;
      valve.extend.edge = edge;
      valve.extend.bend = bend;
      double last = 0.0;
      for (int n = 1; n <= 100; ++n) {
        const double opening = 0.01 * n;
        const double duty = learnt_duty(bench.row, valve, opening);
        assert_true(duty >= last - 1e-3 && duty <= 1.0);
        last = duty;
        const double real = opening + opening_beyond(valve.extend, opening);
        if (opening >= 0.1) {
          assert_near(opening_by_profile(valve.extend, real), opening, 0.03);
        }
      }
      assert_near(learnt_duty(bench.row, valve, -0.5), -0.6, 1e-12);
    }
  }
}

/// Little is known of openings that were not used.
TEST(the_spread_is_less_where_it_worked, Bench bench) {
  const double before = opening_spread(bench.valve.extend, 0.3);
  bench.work(8.0, 1.0);
  assert_true(opening_spread(bench.valve.extend, 0.3) < 0.4 * before);
  assert_near(opening_spread(bench.valve.retract, 0.3), before, 0.0);
  assert_near(opening_spread(bench.valve.extend, 1.0), 0.0, 1e-12);
}

/// A valve that is as its two tables say is nothing to learn, one that is not is off on its side.
TEST(what_is_learnt_is_beyond_its_sides_table, DriveRow row) {
  row.answer = test::two_sides();
  LearntValve valve;
  assert_near(learnt_duty(row, valve, 0.25), 0.5, 1e-12);
  assert_near(learnt_duty(row, valve, -0.25), -0.4375, 1e-12);
  valve.extend.edge = 0.05;
  valve.retract.edge = -0.05;
  // By its soft start, and below the table by the share outside of the dead band.
  assert_near(learnt_edge_ratio(row, valve, true), 0.05 * 0.4, 1e-12);
  assert_near(learnt_edge_ratio(row, valve, false), -0.05 * 0.75, 1e-12);
  assert_near(learnt_duty(row, valve, -0.01), -(0.25 - 0.75 * (0.0495 - 0.01)), 1e-12);
}

/// A command is compared when its side has answered it, spool by the table of its side.
TEST(each_side_has_its_own_lag, DriveRow row) {
  row.answer = test::two_sides();
  for (const double way : {1.0, -1.0}) {
    LearntValve valve;
    ValidDrive seen;
    seen.spool_ratio = way * 0.625;
    next_learnt(row, seen, {way * 0.1, way * 0.5}, LearntFrom::kPlainMotion, kPeriod_s, valve);
    const double share = way > 0.0 ? 0.01 / 0.06 : 0.01 / 0.03;
    assert_near(valve.late[0].speed_mps, way * 0.1 * share, 1e-12);
    assert_near(valve.seen.opening, way * (way > 0.0 ? 0.4375 : 0.5) * 0.01 / 0.16, 1e-12);
  }
}

constexpr double kStill_mps = 2e-4;

Bench motor() {
  Bench bench;
  bench.row.control.has_end_stops = false;
  bench.row.watch.still_mps = kStill_mps;
  return bench;
}

/// Speed of a motor that was asked for this one for so long.
double speed_after_mps(Bench& bench, double asked_mps, double seconds) {
  repeat(static_cast<int>(100.0 * seconds), [&] { bench.step(asked_mps); });
  const double from_m = bench.stroke_m;
  bench.step(asked_mps);
  return (bench.stroke_m - from_m) / kPeriod_s;
}

/// It stands under a spool that should be open, until what is felt opens it.
TEST(a_motor_that_stands_has_a_later_edge) {
  for (const double way : {1.0, -1.0}) {
    Bench bench = motor();
    (way > 0.0 ? bench.extend : bench.retract).edge = 0.25;
    const double asked_mps = way * 0.003;
    assert_near(speed_after_mps(bench, asked_mps, 0.3), 0.0, 0.0);
    assert_near(bench.valve.side(way > 0.0).edge, 0.0, 0.0);
    assert_true(way * speed_after_mps(bench, asked_mps, 3.0) > kStill_mps);
    const double edge = bench.valve.side(way > 0.0).edge;
    assert_true(edge > 0.01 && edge <= 0.07);
    assert_near(bench.valve.side(way < 0.0).edge, 0.0, 0.0);
    // Once it moves nothing more is felt.
    static_cast<void>(speed_after_mps(bench, asked_mps, 3.0));
    assert_near(bench.valve.side(way > 0.0).edge, edge, 0.0);
  }
}

/// Corrections of a motor that is to stand are no word of it, nor is a spool that is not open.
TEST(little_is_not_felt) {
  Bench bench = motor();
  bench.extend.edge = 0.25;
  static_cast<void>(speed_after_mps(bench, 4.0 * kStill_mps, 3.0));
  assert_near(bench.valve.extend.edge, 0.0, 0.0);
  ValidDrive closed;
  closed.stroke_m = bench.stroke_m;
  for (int n = 0; n < 300; ++n) {
    next_learnt(bench.row, closed, {0.05, 0.3}, LearntFrom::kPlainMotion, kPeriod_s, bench.valve);
    next_learnt(bench.row, closed, {0.0, 0.0}, LearntFrom::kPlainMotion, kPeriod_s, bench.valve);
  }
  assert_near(bench.valve.extend.edge, 0.0, 0.0);
}

/// Far too fast as it sets off, it has an earlier edge; later its load may drive it.
TEST(a_motor_that_jumps_off_has_an_earlier_edge) {
  Bench bench = motor();
  bench.extend.edge = 0.15;
  bench.step(0.0);  // It stands.
  static_cast<void>(speed_after_mps(bench, 0.0012, 0.6));
  const double edge = bench.valve.extend.edge;
  assert_true(edge < -0.005 && edge >= -0.07);
  Bench driven = motor();
  driven.extend.edge = 0.15;
  repeat(200, [&] { driven.step(0.1); });
  const double before = driven.valve.extend.edge;
  static_cast<void>(speed_after_mps(driven, 0.0012, 1.0));
  assert_near(driven.valve.extend.edge, before, 0.0);
}

/// However wrong it seems, the edge stays within its bounds.
TEST(what_is_felt_stays_within_bounds) {
  Bench bench = motor();
  bench.extend.edge = 0.9;
  static_cast<void>(speed_after_mps(bench, 0.003, 10.0));
  assert_near(bench.valve.extend.edge, 0.07, 1e-12);
}
