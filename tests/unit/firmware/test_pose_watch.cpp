// SPDX-License-Identifier: Apache-2.0
// A body's pose against its own motion.

#include "firmware/dozer/safety/pose_watch.hpp"

#include <cmath>
#include <limits>

#include "tests/unit/cmocka_cpp.hpp"

constexpr double kPeriod_s = 0.01;

/// A body that drives as it says.
struct Body {
  PoseWatchState state;
  DozerValid valid;
  GroundSpeeds speeds;
  double curvature_pm = 0.0;

  explicit Body(double velocity_mps = 1.0) : Body(velocity_mps, velocity_mps) {}
  Body(double velocity_mps, double tracks_mps)
      : speeds{tracks_mps, tracks_mps, tracks_mps, tracks_mps, 0.0} {
    valid.velocity_mps = velocity_mps;
  }
  /// All coordinates go on as their rates say; up a slope of `pitch_rad`.
  void go_on() {
    valid.position_m += kPeriod_s * valid.velocity_mps;
    valid.height_m += kPeriod_s * valid.climb_mps;
    valid.pitch_rad += kPeriod_s * valid.pitch_rate_radps;
  }
  bool step() { return watch_pose(valid, speeds, curvature_pm, kPeriod_s, state); }
  /// Cycles until it is seen; 0: not within 20 s. `change` makes each cycle's inputs wrong.
  template <class Change>
  int cycles_until_seen(Change change) {
    for (int n = 1; n <= 2000; ++n) {
      go_on();
      change(valid);
      if (step()) {
        return n;
      }
    }
    return 0;
  }
  int cycles_until_seen() {
    return cycles_until_seen([](DozerValid&) {});
  }
  /// Its first cycle, and then as many as it takes.
  template <class Change>
  int begin_until_seen(Change change) {
    step();
    return cycles_until_seen(change);
  }
  int begin_until_seen() {
    step();
    return cycles_until_seen();
  }
};

/// Cycles until a residual that grows by `each` a cycle and forgets passes `most`.
int cycles_to(double each, double most, double forget_s) {
  double residual = 0.0;
  for (int n = 1; n <= 2000; ++n) {
    residual = (1.0 - kPeriod_s / forget_s) * (residual + each);
    if (residual > most) {
      return n;
    }
  }
  return 0;
}

TEST(what_fits_is_well) {
  Body body(1.0, 1.0 / std::cos(0.2));
  body.valid.climb_mps = std::tan(0.2);
  body.valid.pitch_rad = 0.2;
  assert_int_equal(body.cycles_until_seen(), 0);
}

/// Nothing is known of what was before: a machine that stands anywhere begins well.
TEST(the_first_cycle_is_well, Body body) {
  body.valid.position_m = 1000.0;
  body.valid.height_m = -30.0;
  body.valid.pitch_rad = 0.5;
  body.valid.velocity_mps = 0.0;
  assert_false(body.step());
  assert_true(body.state.has_begun);
  assert_false(body.step());
}

TEST(what_is_frozen_is_seen) {
  for (const double way : {1.0, -1.0}) {
    Body drives(way);
    assert_int_equal(drives.begin_until_seen([](DozerValid& valid) { valid.position_m = 0.0; }),
                     cycles_to(0.01, kMostAhead_m, kPoseForget_s));
    Body climbs;
    climbs.valid.pitch_rad = way * 0.2;
    climbs.valid.climb_mps = way * std::tan(0.2);
    assert_int_equal(climbs.begin_until_seen([](DozerValid& valid) { valid.height_m = 0.0; }),
                     cycles_to(0.01 * std::tan(0.2), kMostClimbed_m, kPoseForget_s));
    Body pitches;
    pitches.valid.pitch_rate_radps = way * 0.1;
    assert_int_equal(pitches.begin_until_seen([](DozerValid& valid) { valid.pitch_rad = 0.0; }),
                     cycles_to(0.001, kMostTurned_rad, kPoseForget_s));
    Body rolls;
    rolls.valid.roll_rate_radps = way * 0.1;
    assert_int_equal(rolls.begin_until_seen(), cycles_to(0.001, kMostTurned_rad, kPoseForget_s));
  }
}

/// Aslant by 0.1 rad it has to leave its track; an offset that does so is well.
TEST(a_frozen_offset_is_seen) {
  for (const double way : {1.0, -1.0}) {
    Body body;
    body.valid.course.heading_rad = way * 0.1;
    assert_int_equal(body.begin_until_seen(),
                     cycles_to(0.01 * std::sin(0.1), kMostAhead_m, kPoseForget_s));
    Body leaving;
    leaving.valid.course.heading_rad = way * 0.1;
    const double each_m = kPeriod_s * std::sin(way * 0.1);
    assert_int_equal(
        leaving.begin_until_seen([&](DozerValid& valid) { valid.course.offset_m += each_m; }), 0);
  }
}

/// Along a track that curves, as a machine that keeps to it turns.
Body along(double curvature_pm, double velocity_mps) {
  Body body(velocity_mps);
  body.curvature_pm = curvature_pm;
  body.valid.course.yaw_rate_radps = curvature_pm * velocity_mps;
  body.step();
  return body;
}

/// Forward and backward, to the left and to the right; the offset is as its heading says.
TEST(a_turn_is_well) {
  for (const double curvature_pm : {0.1, -0.1}) {
    for (const double velocity_mps : {1.0, -1.0}) {
      Body keeps = along(curvature_pm, velocity_mps);
      assert_int_equal(keeps.cycles_until_seen(), 0);
      // It swings about the track's direction.
      Body swings = along(curvature_pm, velocity_mps);
      double at_s = 0.0;
      assert_int_equal(swings.cycles_until_seen([&](DozerValid& valid) {
        at_s += kPeriod_s;
        valid.course.heading_rad = 0.1 * std::sin(at_s);
        valid.course.yaw_rate_radps = curvature_pm * velocity_mps + 0.1 * std::cos(at_s);
        valid.course.offset_m += kPeriod_s * velocity_mps * std::sin(valid.course.heading_rad);
      }),
                       0);
    }
  }
}

/// Where the curve begins it goes on showing 0.
TEST(a_frozen_yaw_rate_is_seen) {
  for (const double curvature_pm : {0.1, -0.1}) {
    for (const double velocity_mps : {1.0, -1.0}) {
      Body body = along(0.0, velocity_mps);
      body.curvature_pm = curvature_pm;
      assert_int_equal(body.cycles_until_seen(),
                       cycles_to(0.01 * 0.1, kMostYawed_rad, kPoseForget_s));
    }
  }
}

TEST(a_yaw_rate_that_is_off_is_seen) {
  for (const double off_radps : {0.3, -0.3}) {
    for (const double curvature_pm : {0.0, 0.1}) {
      Body body = along(curvature_pm, 1.0);
      body.valid.course.yaw_rate_radps += off_radps;
      assert_int_equal(body.cycles_until_seen(),
                       cycles_to(0.01 * 0.3, kMostYawed_rad, kPoseForget_s));
    }
  }
}

/// It turns out of the curve, and its heading says that it does not.
TEST(a_frozen_heading_is_seen) {
  for (const double turns_radps : {0.05, -0.05}) {
    Body body = along(0.1, 1.0);
    body.valid.course.yaw_rate_radps += turns_radps;
    assert_int_equal(body.cycles_until_seen(),
                     cycles_to(0.01 * 0.05, kMostYawed_rad, kPoseForget_s));
  }
}

/// Height and climb say another slope than the pitch; what turns may rise by its turn.
TEST(another_slope_is_seen) {
  for (const double rate_radps : {0.0, 0.1, -0.1}) {
    for (const double climb_mps : {0.2, -0.2}) {
      Body body(0.0);
      body.valid.climb_mps = climb_mps;
      body.valid.pitch_rate_radps = rate_radps;
      const int seen = body.begin_until_seen();
      const double beyond_mps = 0.2 - kTippingArm_m * std::abs(rate_radps);
      assert_int_equal(seen, cycles_to(0.01 * beyond_mps, kMostUphill_m, kSlopeForget_s));
      assert_true(seen > 0);
    }
  }
  // Turning as fast as it rises.
  Body tips(0.0);
  tips.valid.climb_mps = 0.2;
  tips.valid.pitch_rate_radps = 0.2 / kTippingArm_m;
  assert_int_equal(tips.begin_until_seen([](DozerValid& valid) {
    valid.pitch_rate_radps = -valid.pitch_rate_radps;  // To and fro, or it would lie down.
  }),
                   0);
}

/// Slip is healthy up to its share; the source nearest to the velocity speaks for it.
TEST(tracks_that_run_on_are_seen) {
  for (const double tracks_mps : {2.0, -2.0}) {
    const double slips_mps = (1.0 - kPoseMostSlip) * 2.0 - kSlipMargin_mps;
    const double way = tracks_mps > 0.0 ? 1.0 : -1.0;
    Body standing(way * (slips_mps - 0.2), tracks_mps);
    assert_int_equal(standing.begin_until_seen(),
                     cycles_to(0.01 * 0.2, kMostSlipped_m, kPoseForget_s));
    Body slipping(way * (slips_mps + 0.001), tracks_mps);
    assert_int_equal(slipping.begin_until_seen(), 0);
  }
  // As much the other way: faster than its tracks.
  Body sliding(1.0, 0.5);
  assert_int_equal(sliding.begin_until_seen(),
                   cycles_to(0.01 * 0.25, kMostSlipped_m, kPoseForget_s));
}

TEST(one_source_that_agrees_is_enough) {
  for (int agrees = 0; agrees < 3; ++agrees) {
    Body body;
    double* const speeds_mps[] = {&body.speeds.left_mps, &body.speeds.right_mps,
                                  &body.speeds.transmission_mps};
    for (int i = 0; i < 3; ++i) {
      *speeds_mps[i] = i == agrees ? 1.0 : 3.0 - 5.0 * (i % 2);
    }
    assert_int_equal(body.begin_until_seen(), 0);
  }
}

/// Tracks that run against each other, as far from the body as the transmission: always the same
/// one speaks, or the residual would come and go.
TEST(of_sources_as_far_off_the_transmission_counts, Body body) {
  body.valid.velocity_mps = 0.0;
  body.speeds = {-1.0, -1.0, 1.0};
  body.step();
  body.step();
  assert_true(body.state.slipped_m > 0.0);
}

/// A cycle of no length keeps a residual to the bit.
TEST(the_most_itself_is_well) {
  const struct {
    double PoseWatchState::*residual;
    double most;
  } rows[] = {{&PoseWatchState::ahead_m, kMostAhead_m},
              {&PoseWatchState::climbed_m, kMostClimbed_m},
              {&PoseWatchState::turned_rad, kMostTurned_rad},
              {&PoseWatchState::rolled_rad, kMostTurned_rad},
              {&PoseWatchState::aside_m, kMostAhead_m},
              {&PoseWatchState::yawed_rad, kMostYawed_rad},
              {&PoseWatchState::uphill_m, kMostUphill_m},
              {&PoseWatchState::slipped_m, kMostSlipped_m},
              {&PoseWatchState::nods_rad, kMostDrift_rad},
              {&PoseWatchState::rocks_rad, kMostDrift_rad},
              {&PoseWatchState::later_m, kMostLater_m},
              {&PoseWatchState::behind_m, kMostSlips_m},
              {&PoseWatchState::before_m, kMostSlips_m}};
  for (const auto& row : rows) {
    for (const double sign : {1.0, -1.0}) {
      Body body;
      body.step();
      body.state.*row.residual = sign * row.most;
      assert_false(watch_pose(body.valid, body.speeds, 0.0, 0.0, body.state));
      body.state.*row.residual = sign * std::nextafter(row.most, 1.0);
      assert_true(watch_pose(body.valid, body.speeds, 0.0, 0.0, body.state));
    }
  }
}

/// Along a slope the tracks run faster than x grows.
TEST(speed_is_that_along_the_ground) {
  Body body(1.0, 1.0 / std::cos(0.75));
  body.valid.pitch_rad = 0.75;
  body.valid.climb_mps = std::tan(0.75);
  assert_int_equal(body.begin_until_seen(), 0);
  // Without the slope it would be 0.27 m/s too slow.
  body.speeds = {1.72, 1.72, 1.72};
  assert_int_equal(body.cycles_until_seen(), 0);
}

TEST(no_number_does_not_fit, Body body) {
  body.step();
  body.valid.velocity_mps = std::numeric_limits<double>::quiet_NaN();
  assert_true(body.step());
}

/// A long cycle forgets all at most.
TEST(a_long_cycle_forgets, Body body) {
  body.step();
  body.state.ahead_m = body.state.climbed_m = body.state.turned_rad = body.state.yawed_rad =
      body.state.uphill_m = body.state.slipped_m = 1.0;
  body.valid.position_m += 4.0 * body.valid.velocity_mps;
  assert_false(watch_pose(body.valid, body.speeds, 0.0, 4.0, body.state));
  assert_near(body.state.ahead_m + body.state.climbed_m + body.state.turned_rad +
                  body.state.yawed_rad + body.state.uphill_m + body.state.slipped_m,
              0.0, 0.0);
}

/// Of a pose that comes 20 ms later each second its position falls behind its velocity; one that
/// comes 3 ms later is well.
TEST(a_pose_that_comes_later_is_seen) {
  for (const double later : {0.02, -0.02, 0.003}) {
    Body body(1.6);
    const double each_m = kPeriod_s * 1.6 * later;
    const int due = cycles_to(std::abs(each_m), kMostLater_m, kLaterForget_s);
    assert_int_equal(body.begin_until_seen([&](DozerValid& valid) { valid.position_m -= each_m; }),
                     due);
    assert_true(later == 0.003 ? due == 0 : due > 300 && due < 600);
  }
}

/// A drift that is too slow for the short residual; a gyro that is off by less is well.
TEST(a_slow_drift_is_seen) {
  for (const double rate_radps : {0.008, -0.008, 0.0029, -0.0029}) {
    const double each_rad = kPeriod_s * rate_radps;
    const int due = cycles_to(std::abs(each_rad), kMostDrift_rad, kDriftForget_s);
    Body nods;
    // Not up any slope: it is the drift that tells.
    const auto drift = [&](DozerValid& valid) {
      valid.pitch_rad += each_rad;
      valid.climb_mps = std::tan(valid.pitch_rad);
    };
    assert_int_equal(nods.begin_until_seen(drift), due);
    Body rocks;
    assert_int_equal(rocks.begin_until_seen([&](DozerValid& valid) { valid.roll_rad += each_rad; }),
                     due);
    assert_true(std::abs(rate_radps) < 0.003 ? due == 0 : due > 100 && due < 300);
  }
}

/// Cycles until a body is seen whose tracks run `tracks_mps` while it goes 1 m/s, or 0; either way.
int slip_seen(double velocity_mps, double tracks_mps, double traction_share) {
  Body body(velocity_mps, tracks_mps);
  body.speeds.traction_share = traction_share;
  return body.begin_until_seen();
}

int way_to(double each_m) {
  double sum_m = 0.0;
  for (int n = 1; n <= 2000; ++n) {
    sum_m += each_m;
    if (sum_m > kMostSlips_m) {
      return n;
    }
  }
  return 0;
}

TEST(slip_without_a_load_is_seen) {
  const double light = kSlipFromTraction;
  for (const double way : {1.0, -1.0}) {
    assert_int_equal(slip_seen(way * 0.8, way, light), way_to(0.01 * (0.2 - kUnloadedSlip)));
    assert_int_equal(slip_seen(way * 1.2, way, light), way_to(0.01 * (0.2 - kUnloadedSlip)));
    assert_int_equal(slip_seen(way * (1.001 - kUnloadedSlip), way, light), 0);
    assert_int_equal(slip_seen(way * (0.999 + kUnloadedSlip), way, light), 0);
  }
}

TEST(a_load_explains_slip) {
  const double half = kSlipFromTraction + 0.5 * kSlipOverTraction;
  const double between = 0.5 * (kUnloadedSlip + kPoseMostSlip);
  assert_int_equal(slip_seen(0.999 - between - 0.02, 1.0, half), way_to(0.01 * 0.021));
  assert_int_equal(slip_seen(1.001 - between, 1.0, half), 0);
  assert_int_equal(slip_seen(1.001 - kPoseMostSlip, 1.0, 3.0), 0);
  // Nobody tells the lines' pressures.
  assert_int_equal(slip_seen(0.75, 1.0, 0.0), 0);
}

/// What crawls is at rest as far as its sensors tell; what has ended is forgotten by fitting.
TEST(slip_is_summed_over_the_way) {
  assert_int_equal(slip_seen(0.0, kTrackAtRest_mps, 0.1), 0);
  Body creeps(0.0, 0.5 * kTrackAtRest_mps);
  creeps.speeds.traction_share = 0.1;
  repeat(50, [&] { assert_false(creeps.step()); });
  assert_true(creeps.state.behind_m == 0.0);
  assert_true(slip_seen(0.0, 1.001 * kTrackAtRest_mps, 0.1) > 0);
  Body body(0.8, 1.0);
  body.speeds.traction_share = 0.1;
  body.step();
  repeat(150, [&] {
    body.go_on();
    assert_false(body.step());
  });
  assert_true(body.state.behind_m > 0.1);
  body.valid.velocity_mps = 1.0;
  repeat(150, [&] {
    body.go_on();
    static_cast<void>(body.step());
  });
  assert_near(body.state.behind_m, 0.0, 0.0);
}
