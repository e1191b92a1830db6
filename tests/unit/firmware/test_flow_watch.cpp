// SPDX-License-Identifier: Apache-2.0
// A sensor against the oil that its spool lets through.

#include "tests/unit/firmware/flow_fixture.hpp"

using namespace graben::test::of_flow;

/// One drive and its watch, cycle by cycle; pressures live, without moving any oil.
struct Watched {
  DriveRow row = plain();
  ValidDrive seen = at(0.6, 9e6, 5e6);
  FlowState state;
  LearntValve valve = as_profiled();
  int cycle = 0;

  FaultSet step() {
    ValidDrive now = seen;
    const double alive_pa = ++cycle % 2 == 0 ? 1.0 : 0.0;
    now.cap_pressure_pa += alive_pa;
    now.rod_pressure_pa += alive_pa;
    return step_as(now);
  }
  FaultSet step_as(const ValidDrive& now) {
    return watch_flow({&row, 1}, {&now, 1}, {&valve, 1}, kEngine_radps, kPeriod_s, {&state, 1});
  }
  /// A first pressure is a step, the second is compared.
  void begin_as(const ValidDrive& now) {
    repeat(2, [&] { static_cast<void>(step_as(now)); });
  }
  void begin() {
    repeat(2, [&] { static_cast<void>(step()); });
  }
  /// Cycles until a fault, moving at this speed; 0: none within `most`.
  int until(Fault fault, double speed_mps, int most = 400) {
    for (int n = 1; n <= most; ++n) {
      if (step().has(fault)) {
        return n;
      }
      seen.stroke_m += speed_mps * kPeriod_s;
    }
    return 0;
  }
  double least_mps() { return possible_speed(row, &valve, seen, kEngine_radps).least_mps; }
  double most_mps() { return possible_speed(row, &valve, seen, kEngine_radps).most_mps; }
};

TEST(within_its_bounds_it_is_sound) {
  for (const double spool : {0.6, -0.6}) {
    Watched low;
    low.seen.spool_ratio = spool;
    low.seen.stroke_m = 0.0;
    Watched high = low;
    for (int n = 0; n < 200; ++n) {
      assert_true(low.step().empty());
      assert_true(high.step().empty());
      low.seen.stroke_m += kPeriod_s * low.least_mps();
      high.seen.stroke_m += kPeriod_s * high.most_mps();
    }
    assert_near(low.state.ahead_m, 0.0, 1e-6);
    assert_near(high.state.behind_m, 0.0, 1e-6);
  }
}

/// The oil's least way since it stands, in whole cycles; the first begins and the second has no
/// last one yet.
TEST(a_stroke_that_stands_still_is_stuck) {
  for (const double spool : {0.3, -0.3}) {
    Watched watched;
    watched.seen.spool_ratio = spool;
    const double a_cycle_m =
        kPeriod_s * std::min(std::abs(watched.least_mps()), std::abs(watched.most_mps()));
    const int expected = static_cast<int>(std::ceil(0.003 / a_cycle_m)) + 2;
    assert_near(watched.until(Fault::kStrokeStuck, 0.0), expected, 1.0);
  }
}

/// Shaking by less than the band is standing still; by more it is not, but it falls behind.
TEST(a_stroke_that_shakes_is_not_stuck_but_wrong) {
  for (const double shake_m : {0.00025, 0.0004}) {
    Watched watched;
    int stuck = 0;
    int wrong = 0;
    for (int n = 0; n < 20 && wrong == 0; ++n) {
      watched.seen.stroke_m = 0.5 + (n % 2 == 0 ? 0.0 : shake_m);
      const FaultSet faults = watched.step();
      stuck += faults.has(Fault::kStrokeStuck) ? 1 : 0;
      wrong += faults.has(Fault::kMotionImplausible) ? 1 : 0;
    }
    assert_true((stuck > 0) == (shake_m < 0.0003));
    assert_int_equal(wrong, 1);
  }
}

/// To the last bit: what is at a bound is within it.
TEST(at_its_bound_it_is_sound) {
  constexpr double kMoved_m = 1.0 / 64.0;
  for (const bool at_bound : {true, false}) {
    Watched watched;
    watched.row.watch.off_m = (1.0 - kPeriod_s / 10.0) * kMoved_m;
    watched.row.watch.off_m *= at_bound ? 1.0 : 0.999;
    watched.seen = at(0.0, 9e6, 9e6);
    watched.begin_as(watched.seen);
    watched.seen.stroke_m += kMoved_m;
    assert_true(watched.step_as(watched.seen).empty() == at_bound);
  }
  // So is a stroke that has moved by its noise one that stands.
  Watched still;
  still.seen.stroke_m = 0.0;
  still.until(Fault::kNone, 0.0, 3);
  still.seen.stroke_m = 0.0003;
  static_cast<void>(still.step());
  assert_near(still.state.still_m, 0.0, 0.0);
}

/// What is beside the drives that there are is not looked at.
TEST(only_its_drives_are_watched, Watched watched) {
  const DriveRow rows[] = {watched.row, watched.row};
  const ValidDrive seen[] = {watched.seen, watched.seen};
  FlowState states[2];
  states[1].stroke_m = 7.0;
  assert_true(
      watch_flow({rows, 1}, {seen, 1}, {&watched.valve, 1}, kEngine_radps, kPeriod_s, {states, 1})
          .empty());
  assert_near(states[1].stroke_m, 7.0, 0.0);
  assert_near(states[1].cap_shown_pa, 0.0, 0.0);
}

TEST(what_runs_ahead_of_its_oil_is_wrong) {
  for (const double way : {1.0, -1.0}) {
    Watched watched;
    watched.seen.spool_ratio = 0.0;
    // 8 mm at 0.1 m/s, beyond nothing at all.
    assert_near(watched.until(Fault::kMotionImplausible, way * 0.1), 10.0, 1.0);
  }
}

/// Slower than what 10 s forget it never adds up.
TEST(leakage_is_forgotten, Watched watched) {
  watched.seen.spool_ratio = 0.0;
  assert_int_equal(watched.until(Fault::kMotionImplausible, -0.0007, 20000), 0);
  Watched faster;
  faster.seen.spool_ratio = 0.0;
  assert_true(faster.until(Fault::kMotionImplausible, -0.0010, 20000) > 0);
}

/// Without a new stroke nothing is compared; with the next one all of it is.
TEST(lost_frames_are_waited_for, Watched watched) {
  static_cast<void>(watched.step());
  watched.seen.stroke_is_new = false;
  repeat(100, [&] { assert_true(watched.step().empty()); });
  watched.seen.stroke_is_new = true;
  assert_true(watched.step().has(Fault::kMotionImplausible));
}

/// A side that is squeezed lets the drive give way: the draining one always, the other while that
/// is empty. 3 MPa of 0.65 m of oil are 3.25 mm at its softest.
TEST(oil_gives_way) {
  struct Case {
    double spool;
    double cap_pa;
    double rod_pa;
    double cap_change_pa;
    double rod_change_pa;
    double least_m;
    double most_m;
  };
  const double soft_m = 0.3 * 3e6 * 0.65 / 0.6e9;
  const double stiff_m = 0.3 * 3e6 * 0.65 / 2.0e9;
  const Case cases[] = {
      {0.1, 9e6, 5e6, 0.0, 3e6, stiff_m, soft_m},
      {0.1, 9e6, 5e6, 0.0, -3e6, -soft_m, -stiff_m},
      {0.1, 9e6, 5e6, 3e6, 0.0, 0.0, 0.0},
      {0.1, 9e6, 1e6, 3e6, 0.0, -soft_m, 0.0},
      {0.1, 9e6, 1e6, -3e6, 0.0, 0.0, soft_m},
      {-0.1, 5e6, 9e6, 3e6, 0.0, -soft_m, -stiff_m},
      {-0.1, 5e6, 9e6, -3e6, 0.0, stiff_m, soft_m},
      {-0.1, 5e6, 9e6, 0.0, 3e6, 0.0, 0.0},
      {-0.1, 1e6, 9e6, 0.0, 3e6, 0.0, soft_m},
      {-0.1, 1e6, 9e6, 0.0, -3e6, -soft_m, 0.0},
      // A spool in its middle counts as on its way in; 1.5 MPa are not empty.
      {0.0, 5e6, 9e6, 3e6, 0.0, -soft_m, -stiff_m},
      {0.0, 5e6, 9e6, 0.0, 3e6, 0.0, 0.0},
      {0.1, 9e6, 1.5e6, 3e6, 0.0, 0.0, 0.0},
      {-0.1, 1.5e6, 9e6, 0.0, 3e6, 0.0, 0.0},
  };
  for (const Case& each : cases) {
    Watched watched;
    ValidDrive seen = at(each.spool, each.cap_pa, each.rod_pa);
    watched.begin_as(seen);
    seen.cap_pressure_pa += each.cap_change_pa;
    seen.rod_pressure_pa += each.rod_change_pa;
    seen.stroke_is_new = false;
    static_cast<void>(watched.step_as(seen));
    assert_near(watched.state.least_m, each.least_m, 1e-9);
    assert_near(watched.state.most_m, each.most_m, 1e-9);
  }
}

/// Its sides are as large wherever it stands.
TEST(a_motors_oil_does_not_grow) {
  for (const double spool : {0.1, -0.1}) {
    Watched watched;
    watched.row.control.has_end_stops = false;
    ValidDrive seen = at(spool, 9e6, 9e6);
    watched.begin_as(seen);
    (spool > 0.0 ? seen.rod_pressure_pa : seen.cap_pressure_pa) += 3e6;
    seen.stroke_is_new = false;
    static_cast<void>(watched.step_as(seen));
    assert_near(std::max(watched.state.most_m, -watched.state.least_m), 0.3 * 3e6 * 0.15 / 0.6e9,
                1e-9);
  }
}

/// Neither pressure may stand still; an empty side's may.
TEST(dead_pressures_say_nothing) {
  for (const bool cap_lives : {false, true}) {
    for (const bool rod_lives : {false, true}) {
      Watched watched;
      bool any = false;
      for (int n = 0; n < 100; ++n) {
        ValidDrive now = at(0.3, 9e6, 5e6);
        now.cap_pressure_pa += cap_lives ? n % 2 : 0;
        now.rod_pressure_pa += rod_lives ? n % 2 : 0;
        any = any || !watched.step_as(now).empty();
      }
      assert_true(any == (cap_lives && rod_lives));
    }
  }
  Watched empty;
  for (int n = 0; n < 100; ++n) {
    static_cast<void>(empty.step_as(at(0.3, n % 2 == 0 ? 9e6 : 9e6 + 1.0, 0.2e6)));
    assert_true(empty.state.begun == (n > 0));
  }
  // Nor is one that sinks, or one below what an empty side shows, whatever it shows.
  Watched sinks;
  Watched low;
  for (int n = 0; n < 20; ++n) {
    static_cast<void>(sinks.step_as(at(0.3, 9e6 - n * 1e3, 5e6 - n * 1e3)));
    static_cast<void>(low.step_as(at(0.3, 9e6 - n * 1e3, 0.1e6)));
    assert_true(sinks.state.begun == (n > 0) && low.state.begun == (n > 0));
  }
  // Three times the same is not dead yet, the fourth is.
  Watched same;
  for (int n = 0; n < 5; ++n) {
    static_cast<void>(same.step_as(at(0.3, 9e6, 5e6)));
    assert_true(same.state.begun == (n > 0 && n < 4));
  }
}

/// At the end of its range, or after a step, a sensor says nothing of the flow.
TEST(steps_and_rails_say_nothing) {
  for (const double spool : {0.6, -0.6}) {
    Watched watched;
    const bool extends = spool > 0.0;
    watched.seen = at(spool, extends ? 9e6 : 32e6, extends ? 32e6 : 9e6);
    for (int n = 0; n < 20; ++n) {
      assert_true(watched.step().empty());
      assert_false(watched.state.begun);
    }
    // Of the fed side it does not matter.
    watched.seen = at(spool, extends ? 33e6 : 9e6, extends ? 9e6 : 33e6);
    watched.begin();
    assert_true(watched.state.begun);
  }
  // In its middle the cap side counts as the one that drains.
  Watched middle;
  middle.seen = at(0.0, 9e6, 33e6);
  middle.begin();
  assert_true(middle.state.begun);
  for (const double step_pa : {4.1e6, -4.1e6, 4.0e6}) {
    for (const bool cap : {false, true}) {
      Watched watched;
      ValidDrive seen = at(0.6, 9e6, 9e6);
      watched.begin_as(seen);
      assert_true(watched.state.begun);
      (cap ? seen.cap_pressure_pa : seen.rod_pressure_pa) += step_pa;
      static_cast<void>(watched.step_as(seen));
      assert_true(watched.state.begun == (step_pa == 4.0e6));
    }
  }
}

/// What it was off before stays where one cycle says nothing, and wears off where none does.
TEST(a_gap_forgets_only_what_it_must, Watched watched) {
  repeat(4, [&] { static_cast<void>(watched.step()); });
  const double behind_m = watched.state.behind_m;
  assert_true(behind_m > 0.0 && watched.state.extend_m > 0.0);
  watched.seen.rod_pressure_pa = 15e6;
  watched.begin();
  assert_true(watched.state.begun);
  assert_near(watched.state.behind_m, behind_m, 0.0);
  assert_near(watched.state.extend_m, 0.0, 0.0);
  watched.seen.load_known = false;
  static_cast<void>(watched.step());
  assert_near(watched.state.behind_m, 0.999 * behind_m, 1e-9);
  assert_near(watched.state.extend_m, 0.0, 0.0);
  assert_false(watched.state.begun);
  repeat(6000, [&] { static_cast<void>(watched.step()); });
  assert_near(watched.state.behind_m, 0.0, 1e-5);
}

/// A pressure that is away every eighth cycle hides no stroke that goes beyond its oil.
TEST(a_pressure_that_comes_and_goes_hides_nothing, Watched watched) {
  watched.seen.spool_ratio = 0.0;
  bool found = false;
  for (int n = 0; n < 100 && !found; ++n) {
    watched.seen.load_known = n % 8 != 0;
    found = watched.step().has(Fault::kMotionImplausible);
    watched.seen.stroke_m += 0.1 * kPeriod_s;
  }
  assert_true(found);
}

TEST(without_spool_or_load_nothing_is_checked, Watched no_spool) {
  no_spool.row.watch.senses_spool = false;
  assert_int_equal(no_spool.until(Fault::kStrokeStuck, 0.0), 0);
  Watched no_load;
  no_load.seen.load_known = false;
  assert_int_equal(no_load.until(Fault::kStrokeStuck, 0.0), 0);
  Watched no_bound;
  no_bound.row.watch.unseen_m = 0.0;
  assert_int_equal(no_bound.until(Fault::kStrokeStuck, 0.0), 0);
  // A metered inlet needs none, and its pressures are nothing.
  Watched inlet;
  inlet.row = metered_inlet();
  inlet.seen.load_known = false;
  assert_true(inlet.until(Fault::kStrokeStuck, 0.0) > 0);
}

/// The spool's frame comes every second cycle: the widest of two counts.
TEST(the_last_cycle_counts_too, Watched watched) {
  repeat(3, [&] { static_cast<void>(watched.step()); });
  const double behind_m = watched.state.behind_m;
  const double most_mps = watched.most_mps();
  watched.seen.spool_ratio = 0.0;
  watched.seen.stroke_is_new = false;
  watched.until(Fault::kNone, 0.0, 2);
  assert_near(watched.state.most_m, kPeriod_s * most_mps, 1e-6);
  assert_near(watched.state.least_m, 0.0, 1e-6);
  assert_near(watched.state.behind_m, behind_m, 0.0);
}

/// It stands where it was while its pilot pressure is there, and leads on while that is gone.
TEST(a_spool_told_by_its_pilot_comes_later) {
  for (const double way : {1.0, -1.0}) {
    Watched measured;
    measured.seen.spool_ratio = way * 0.6;
    const int at_once = measured.until(Fault::kStrokeStuck, 0.0);
    Watched told;
    told.row.watch.spool_late_s = 0.1;
    told.seen.spool_ratio = -way * 0.6;
    const double speed_mps = 0.5 * (told.least_mps() + told.most_mps());
    told.until(Fault::kStrokeStuck, speed_mps, 30);
    Watched closing = told;
    told.seen.spool_ratio = way * 0.6;
    assert_in_range(told.until(Fault::kStrokeStuck, 0.0), at_once + 10, at_once + 21);
    closing.seen.spool_ratio = 0.0;
    assert_int_equal(closing.until(Fault::kMotionImplausible, speed_mps, 10), 0);
    assert_in_range(closing.until(Fault::kMotionImplausible, speed_mps), 1, 25);
  }
  Watched exact;  // To the last bit, what was told so long ago counts.
  exact.row.watch.spool_late_s = kPeriod_s + kPeriod_s;
  exact.until(Fault::kNone, 0.0, 2);
  assert_near(exact.state.told.for_s, exact.row.watch.spool_late_s, 0.0);
}

/// What is not learnt yet is left room for.
TEST(a_valve_that_is_not_learnt_is_given_more_time, Watched known) {
  Watched fresh;
  known.seen.spool_ratio = 0.3;
  fresh.seen.spool_ratio = 0.3;
  fresh.valve = LearntValve{};
  const int sooner = known.until(Fault::kStrokeStuck, 0.0);
  const int later = fresh.until(Fault::kStrokeStuck, 0.0);
  assert_true(sooner > 0);
  assert_true(later == 0 || later > sooner);
}
