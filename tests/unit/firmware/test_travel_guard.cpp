// SPDX-License-Identifier: Apache-2.0
// Tracks under the guard of commissioning: what it holds back, and what it calls a fault.

#include "firmware/dozer/safety/travel_guard.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben;

constexpr double kPeriod_s = 0.01;
constexpr double kFrom_m = -7.0;
constexpr StrokeWindow kWay = {-2.0, 3.0, 1.0};

/// A machine that goes as a test says; what may be sent is sent.
struct Tracks {
  TravelGuardState state;
  TravelAsk ask;
  DozerValid seen;
  TravelGuardResult result;

  Tracks() {
    ask.window = kWay;
    seen.position_m = kFrom_m;
    assert_int_equal(run(2.0, 0.0, 0.0), Fault::kNone);
  }
  Fault step(double pump, double speed_mps) {
    seen.position_m += speed_mps * kPeriod_s;
    seen.velocity_mps = speed_mps;
    seen.track_speed_mps = {speed_mps, speed_mps};
    ask.sent_ratio = result.pump_ratio;
    ask.wanted_ratio = pump;
    result = next_travel(ask, seen, kPeriod_s, state);
    return result.fault;
  }
  /// Ends with a fault.
  Fault run(double time_s, double pump, double speed_mps) {
    Fault fault = Fault::kNone;
    for (double at_s = 0.0; at_s < time_s && fault == Fault::kNone; at_s += kPeriod_s) {
      fault = step(pump, speed_mps);
    }
    return fault;
  }
  [[nodiscard]] double way_m() const { return seen.position_m - kFrom_m; }
};

TEST(without_a_window_nothing_moves) {
  for (const StrokeWindow& window :
       {StrokeWindow{}, StrokeWindow{-2.0, 3.0, 0.0}, StrokeWindow{-2.0, 3.0, -1.0},
        StrokeWindow{0.0, 3.0, 1.0}, StrokeWindow{1.0, 3.0, 1.0}, StrokeWindow{-2.0, -1.0, 1.0},
        StrokeWindow{-2.0, 0.0, 1.0}, StrokeWindow{-15.1, 3.0, 1.0},
        StrokeWindow{-2.0, 15.1, 1.0}}) {
    assert_false(is_travel_window(window));
    Tracks tracks;
    tracks.ask.window = window;
    for (const double pump : {0.5, -0.5}) {
      tracks.step(pump, 0.0);
      assert_near(tracks.result.pump_ratio, 0.0, 0.0);
      assert_true(tracks.result.held);
    }
  }
  assert_true(is_travel_window(kWay));
  assert_true(is_travel_window({-15.0, 15.0, 0.1}));
}

TEST(what_is_asked_for_is_sent, Tracks tracks) {
  for (const double pump : {0.5, -0.25}) {
    tracks.step(pump, 0.0);
    assert_near(tracks.result.pump_ratio, pump, 0.0);
    assert_false(tracks.result.held);
  }
  tracks.step(1.5, 0.0);
  assert_near(tracks.result.pump_ratio, 1.0, 0.0);
}

/// It is let go of where it can still be stopped before the end, to either side of where it stood.
TEST(it_is_held_before_an_end) {
  for (const int side : {1, -1}) {
    Tracks tracks;
    const double end_m = side > 0 ? kWay.most_m : -kWay.least_m;
    constexpr double kSpeed_mps = 0.5;
    while (!tracks.result.held) {
      assert_int_equal(tracks.step(0.5 * side, kSpeed_mps * side), Fault::kNone);
    }
    assert_near(side * tracks.way_m(), end_m - kSpeed_mps * kTravelStops_s, 0.006);
    assert_near(tracks.result.pump_ratio, 0.0, 0.0);
    // Until it is no longer asked for; the other way is free.
    assert_int_equal(tracks.run(0.5, 0.5 * side, 0.0), Fault::kNone);
    assert_true(tracks.result.held);
    Tracks turns = tracks;
    turns.step(-0.5 * side, 0.0);
    assert_false(turns.result.held);
    tracks.step(0.0, 0.0);
    assert_false(tracks.result.held);
    // It stands, so there is room again.
    tracks.step(0.1 * side, 0.0);
    assert_near(tracks.result.pump_ratio, 0.1 * side, 0.0);
    tracks.step(-0.5 * side, 0.0);
    assert_false(tracks.result.held);
    assert_near(tracks.result.pump_ratio, -0.5 * side, 0.0);
  }
}

TEST(outside_and_too_fast_are_faults) {
  for (const int side : {1, -1}) {
    Tracks far;
    assert_int_equal(far.run(60.0, 0.5 * side, 0.2 * side), Fault::kCommissionBound);
    const double end_m = side > 0 ? kWay.most_m : -kWay.least_m;
    assert_near(side * far.way_m(), end_m + kTravelOutside_m, 0.005);

    Tracks fast;
    assert_int_equal(fast.run(1.0, 0.5 * side, 0.98 * side), Fault::kNone);
    assert_int_equal(fast.run(0.5, 0.5 * side, 1.05 * side), Fault::kCommissionBound);
  }
}

/// One of body and tracks may slip, or its sensor be wrong.
TEST(the_faster_of_body_and_tracks_counts) {
  for (const bool body : {false, true}) {
    Tracks tracks;
    const double track_mps = body ? 0.1 : 1.2;
    tracks.seen.velocity_mps = body ? 1.2 : 0.1;
    tracks.seen.track_speed_mps = {track_mps, track_mps};
    tracks.ask.wanted_ratio = tracks.ask.sent_ratio = 0.5;
    Fault fault = Fault::kNone;
    for (int n = 0; n < 60 && fault == Fault::kNone; ++n) {
      fault = next_travel(tracks.ask, tracks.seen, kPeriod_s, tracks.state).fault;
    }
    assert_int_equal(fault, Fault::kCommissionBound);
  }
}

/// At its begin nothing is under way, nor after a break, whatever was before.
TEST(what_is_under_way_begins_with_the_task) {
  for (const bool broken : {false, true}) {
    Tracks tracks;
    if (broken) {
      tracks.run(1.0, 0.1, 0.1);
      rest_travel(false, tracks.state);
    } else {
      tracks.state = {};
    }
    tracks.result = {};
    assert_int_equal(tracks.run(0.5, 0.0, 0.2), Fault::kUncommandedMotion);
  }
}

TEST(the_wrong_way_is_a_fault) {
  for (const int side : {1, -1}) {
    Tracks tracks;
    assert_int_equal(tracks.run(3.0, 0.1 * side, -0.2 * side), Fault::kWrongDirection);
    assert_near(-side * tracks.way_m(), kTravelWrong_m, 0.012);
    // What was under way before a reversal is none.
    Tracks turned;
    assert_int_equal(turned.run(1.0, 0.1 * side, 0.2 * side), Fault::kNone);
    assert_int_equal(turned.run(0.6, -0.1 * side, 0.2 * side), Fault::kNone);
    assert_int_equal(turned.run(2.0, -0.1 * side, 0.2 * side), Fault::kWrongDirection);
  }
}

TEST(motion_that_nobody_asks_for_is_a_fault) {
  for (const int side : {1, -1}) {
    Tracks tracks;
    assert_int_equal(tracks.run(3.0, 0.0, 0.2 * side), Fault::kUncommandedMotion);
    assert_near(side * tracks.way_m(), kTravelWrong_m, 0.012);
    // It coasts for a while after it was driven.
    Tracks coasts;
    assert_int_equal(coasts.run(1.0, 0.1 * side, 0.1 * side), Fault::kNone);
    assert_int_equal(coasts.run(kTravelComesToRest_s - 0.05, 0.0, 0.1 * side), Fault::kNone);
    // Creeping is forgotten.
    Tracks creeps;
    assert_int_equal(creeps.run(30.0, 0.0, 0.01 * side), Fault::kNone);
  }
}

TEST(a_machine_that_stands_is_a_fault) {
  for (const int side : {1, -1}) {
    Tracks tracks;
    assert_int_equal(tracks.run(kTravelStands_s - 0.03, 0.3 * side, 0.0), Fault::kNone);
    assert_int_equal(tracks.run(0.2, 0.3 * side, 0.0), Fault::kStalled);
    // A small displacement may do nothing.
    Tracks little;
    assert_int_equal(little.run(20.0, 0.15 * side, 0.0), Fault::kNone);
  }
}

/// After a break it still counts from where it was tried first, unless it went elsewhere meanwhile.
TEST(the_window_stays_where_it_was) {
  for (const bool forgets : {false, true}) {
    Tracks tracks;
    tracks.run(4.0, 0.3, 0.5);
    tracks.run(1.0, 0.0, 0.0);
    rest_travel(forgets, tracks.state);
    tracks.result = {};
    tracks.run(2.0, 0.0, 0.0);
    while (!tracks.result.held) {
      assert_int_equal(tracks.step(0.3, 0.25), Fault::kNone);
    }
    const double from_m = forgets ? 2.0 : 0.0;
    assert_near(tracks.way_m(), from_m + kWay.most_m - 0.25 * kTravelStops_s, 0.02);
  }
}

/// A place that was never begun stays so at rest, whatever is forgotten.
TEST(rest_begins_nothing) {
  for (const bool forgets : {false, true}) {
    TravelGuardState state;
    rest_travel(forgets, state);
    assert_false(state.begun);
  }
}
