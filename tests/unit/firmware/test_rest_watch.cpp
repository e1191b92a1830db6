// SPDX-License-Identifier: Apache-2.0
// Drives that nobody asks to move.

#include "firmware/drives/rest_watch.hpp"

#include <cmath>

#include "firmware/drives/tuning.hpp"
#include "tests/unit/cmocka_cpp.hpp"

constexpr double kCycle_s = 0.01;

/// A drive whose speed and spool are told, after it was last asked for a speed.
struct Resting {
  DriveRow row;
  RestState state;
  RestSeen seen;
  RestVerdict verdict = RestVerdict::kRests;
  double way_m = 0.0;   ///< Since it was last asked.
  double time_s = 0.0;  ///< The same.

  Resting() {
    row.answer.extend.dead_time_s = row.answer.retract.dead_time_s = 0.05;
    row.watch.settle_s = 0.1;
    row.watch.rest_s = 0.5;
    row.watch.sink_mps = 0.002;
    seen.stroke_m = 0.7;
  }
  void ask(double mps) {
    ask_of(rest_bounds(row), mps, state);
    way_m = 0.0;
    time_s = 0.0;
  }
  void move(double mps) {
    seen.stroke_m += mps * kCycle_s;
    way_m += std::abs(mps) * kCycle_s;
    time_s += kCycle_s;
    verdict = watch_rest(rest_bounds(row), seen, kCycle_s, state);
  }
  void move_for(double mps, double seconds) {
    repeat(static_cast<int>(std::lround(seconds / kCycle_s)), [&] { move(mps); });
  }
  /// Way until it is seen to move; at most 1 m.
  double seen_after_m(double mps) {
    while (verdict != RestVerdict::kMoves && way_m < 1.0) {
      move(mps);
    }
    return way_m;
  }
};

TEST(a_drive_that_stands_rests, Resting drive) {
  drive.ask(0.4);
  drive.move_for(0.0, 60.0);
  assert_int_equal(drive.verdict, RestVerdict::kRests);
}

TEST(one_that_goes_on_is_seen_after_50_mm, Resting drive) {
  for (const double mps : {0.003, 0.01, 0.06, 0.16, -0.01, -0.16}) {
    Resting moved = drive;
    moved.ask(0.0);
    moved.move(0.0);
    assert_near(moved.seen_after_m(mps), 0.055, 0.008);
  }
}

/// Before that it takes 0.3 s.
TEST(a_fast_one_is_seen_after_some_time, Resting drive) {
  drive.ask(0.0);
  drive.move(0.0);
  drive.seen_after_m(0.5);
  assert_near(drive.time_s, 0.32, 0.02);
}

/// Up to the speed at which drives sink, and no faster.
TEST(a_spool_in_its_middle_excuses_sinking_alone, Resting drive) {
  drive.seen.centred = true;
  Resting moved = drive;
  assert_near(moved.seen_after_m(0.01), 0.0625, 0.004);
  drive.move_for(-0.0015, 30.0);
  assert_int_equal(drive.verdict, RestVerdict::kRests);
  drive.move_for(-0.0015, 5.0);
  assert_int_equal(drive.verdict, RestVerdict::kSinks);
}

TEST(without_a_spool_sinking_is_motion, Resting drive) {
  assert_near(drive.seen_after_m(-0.0015), 0.05, 0.004);
}

/// The way of its last command during dead time and lags, and no more of it afterwards.
TEST(what_settling_explains_is_no_motion, Resting drive) {
  drive.ask(0.4);
  drive.move_for(0.4, 0.1);
  drive.move_for(0.0, 5.0);
  assert_int_equal(drive.verdict, RestVerdict::kRests);
  drive.move_for(0.1, 0.45);
  assert_int_equal(drive.verdict, RestVerdict::kRests);
  drive.move_for(0.1, 0.1);
  assert_int_equal(drive.verdict, RestVerdict::kMoves);

  Resting runs_on;
  runs_on.ask(0.4);
  assert_true(runs_on.seen_after_m(0.4) <
              0.05 + 1.3 * 0.4 * rest_bounds(runs_on.row).coast_s + 0.01);
}

/// What was asked before the last command is under way too, for some time.
TEST(less_was_asked_as_it_stops, Resting drive) {
  drive.ask(0.4);
  const double explained_m = drive.state.coast_m;
  drive.ask(0.0);
  assert_near(drive.state.coast_m, 0.98 * explained_m, 1e-12);
  repeat(300, [&] { drive.ask(0.0); });
  assert_near(drive.state.coast_m, 0.0, 1e-3);
}

/// A platform's bound may be less than the noise of a long cylinder.
TEST(a_small_bound_is_kept, Resting drive) {
  drive.row.watch.rest_m = 0.005;
  drive.ask(0.0);
  drive.move(0.0);
  assert_near(drive.seen_after_m(0.01), 0.006, 0.002);
}

TEST(a_swing_may_brake, Resting drive) {
  drive.row.watch.brakes_s = 1.0;
  drive.row.watch.rest_s = 2.5;
  drive.ask(0.3);
  drive.move_for(0.15, 1.5);
  assert_int_equal(drive.verdict, RestVerdict::kRests);
}

/// Nor of its fastest, where nobody knows what it was asked for.
TEST(at_the_start_its_fastest_is_explained, Resting drive) {
  drive.row.watch.fastest_mps = 0.4;
  Resting runs_on = drive;
  drive.move_for(0.4, 0.1);
  drive.move_for(0.0, 5.0);
  assert_int_equal(drive.verdict, RestVerdict::kRests);
  assert_near(runs_on.seen_after_m(0.4), 0.05 + 1.3 * 0.4 * rest_bounds(drive.row).coast_s, 0.01);
}

/// Once it was asked, that is what counts.
TEST(what_it_was_asked_for_is_not_its_fastest, Resting drive) {
  drive.row.watch.fastest_mps = 0.4;
  drive.ask(0.0);
  drive.move(0.0);
  assert_near(drive.seen_after_m(0.1), 0.05, 0.004);
}

/// What is asked may be anything that a division gave.
TEST(what_is_not_finite_explains_nothing, Resting drive) {
  drive.ask(std::nan(""));
  drive.move(0.0);
  assert_near(drive.seen_after_m(0.1), 0.05, 0.004);
}

/// It is at rest again once it has stood for 1 s.
TEST(what_was_seen_to_move_has_to_stand, Resting drive) {
  drive.seen_after_m(0.1);
  drive.move_for(0.0, 0.9);
  assert_int_equal(drive.verdict, RestVerdict::kMoves);
  drive.move_for(0.0, 0.6);
  assert_int_equal(drive.verdict, RestVerdict::kRests);
  drive.way_m = 0.0;
  assert_near(drive.seen_after_m(0.1), 0.05, 0.004);
}

/// Its fault neither comes nor goes.
TEST(what_creeps_on_does_not_stand, Resting drive) {
  drive.ask(0.0);
  drive.seen_after_m(0.004);
  for (int n = 0; n < 6000; ++n) {
    drive.move(0.004);
    assert_int_equal(drive.verdict, RestVerdict::kMoves);
  }
}

/// It goes on for as long as its levers explain.
TEST(what_the_operator_gives_back_may_settle, Resting drive) {
  drive.row.watch.fastest_mps = 0.4;
  drive.seen.by_hand = true;
  drive.move_for(0.2, 2.0);
  assert_int_equal(drive.verdict, RestVerdict::kMoves);
  drive.seen.by_hand = false;
  Resting runs_on = drive;
  drive.move_for(0.2, 0.4);
  assert_int_equal(drive.verdict, RestVerdict::kRests);
  runs_on.move_for(0.2, 0.1);
  assert_int_equal(runs_on.verdict, RestVerdict::kRests);
  runs_on.way_m = 0.0;
  assert_true(runs_on.seen_after_m(0.2) < 0.16);
}

/// In the operator's hands each place where it stood is one.
TEST(by_hand_it_begins_where_it_was_left, Resting drive) {
  const auto twice = [&] {
    repeat(2, [&] {
      drive.move_for(0.1, 0.4);
      drive.move_for(0.0, 1.6);
    });
  };
  drive.seen.by_hand = true;
  twice();
  assert_int_equal(drive.verdict, RestVerdict::kRests);
  drive.seen.by_hand = false;
  drive.move_for(0.1, 0.4);
  assert_int_equal(drive.verdict, RestVerdict::kRests);
  drive.move_for(0.0, 1.6);
  drive.move_for(0.1, 0.4);
  assert_int_equal(drive.verdict, RestVerdict::kMoves);
}

/// A jump that is gone within 0.3 s is none.
TEST(a_value_that_is_wrong_for_some_frames_is_no_motion, Resting drive) {
  drive.move_for(0.0, 1.0);
  drive.seen.stroke_m += 0.2;
  drive.move_for(0.0, 0.25);
  assert_int_equal(drive.verdict, RestVerdict::kRests);
  drive.seen.stroke_m -= 0.2;
  drive.move_for(0.0, 1.0);
  assert_int_equal(drive.verdict, RestVerdict::kRests);
}

/// Each bound to the last bit: what is no more than it is still allowed.
TEST(bounds_are_what_they_say) {
  RestBounds bounds;
  bounds.rest_m = 0.0625;
  bounds.rest_s = 0.5;
  RestState state;
  state.anchored = true;
  state.asked = true;
  state.moves = true;
  const auto at = [&](double stroke_m, double elapsed_s) {
    return watch_rest(bounds, {stroke_m, false, false}, elapsed_s, state);
  };
  // Noise is not away, and of 0.2 s does not begin stillness newly.
  at(0.0, 0.25);
  assert_near(state.still_s, 0.25, 0.0);
  at(kRestNear_m, 0.01);
  assert_near(state.still_s, 0.26, 1e-12);
  assert_near(state.off_s, 0.0, 0.0);
  at(kRestNear_m, 0.25);
  assert_near(state.still_s, 0.0, 0.0);
  state.still_s = kRestStands_s - 0.25;
  assert_int_equal(at(kRestNear_m, 0.25), RestVerdict::kRests);

  state = {};
  state.anchored = true;
  state.asked = true;
  state.off_s = 9.0;
  assert_int_equal(at(0.0625, 0.25), RestVerdict::kRests);
  state.off_s = 0.0;
  assert_int_equal(at(0.125, kRestMoves_s), RestVerdict::kMoves);

  state = {};
  state.anchored = true;
  state.asked = true;
  state.stopped_s = 0.25;
  state.coast_m = 0.125;
  at(0.25, 0.25);
  assert_near(state.anchor_m, 0.125, 0.0);

  state = {};
  state.anchored = true;
  state.asked = true;
  state.sunk_m = 0.0625;
  assert_int_equal(at(0.0, 0.25), RestVerdict::kRests);
  state.sunk_m = -0.125;
  assert_int_equal(at(0.0, 0.25), RestVerdict::kSinks);
}
