// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/travel/preview.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

constexpr double kAllowed_m = 0.006;

const DozerProfile& profile() { return test::dozer().profile; }

const BladeKinematics& blade() {
  static const BladeKinematics of(profile().blade);
  return of;
}

double flow_m3ps() { return available_flow_m3ps(profile().implement, 157.08); }

/// After it has stood there for long.
Preview standing(const GradeProfile& design, double x_m, double of_flow = 1.0) {
  Preview preview(profile(), blade());
  const GroundMap untouched;
  for (int n = 0; n < 400; ++n) {
    preview.look(untouched, design, x_m, {0.0, 0.0}, of_flow * flow_m3ps());
  }
  return preview;
}

AheadLimit standing_at(const GradeProfile& design, double x_m, double speed_mps, double lead_s) {
  return standing(design, x_m).limit(x_m, speed_mps, kAllowed_m, lead_s);
}

TEST(on_the_level_nothing_holds_it) {
  const AheadLimit ahead = standing_at(GradeProfile(test::level(0.0)), 0.0, 1.0, 0.2);
  assert_true(ahead.speed_mps > 5.0);
  assert_true(ahead.lowest_mps > 5.0);
  assert_near(standing(GradeProfile(test::level(0.0)), 0.0).lift(0.5, 1.0, kAllowed_m).height_m,
              0.0, 1e-4);
}

/// The body tips over the bend: where half the flow is there, half the speed is.
TEST(it_is_the_flow_that_holds_it) {
  const GradeProfile design(test::ledge(-0.3, 0.3));
  const double with_all_mps = standing(design, 9.2).limit(9.2, 3.0, 1e-5, 0.0).lowest_mps;
  const double with_half_mps = standing(design, 9.2, 0.5).limit(9.2, 3.0, 1e-5, 0.0).lowest_mps;
  assert_true(with_all_mps < 0.6);
  assert_near(with_half_mps / with_all_mps, 0.5, 0.15);
}

/// What may be left standing is what it may be faster by.
TEST(what_is_allowed_makes_it_faster) {
  const GradeProfile design(test::ledge(-0.3, 0.3));
  const Preview preview = standing(design, 9.2);
  double last_mps = 0.0;
  for (const double allowed_m : {0.001, 0.005, 0.02, 0.05}) {
    const double limit_mps = preview.limit(9.2, 3.0, allowed_m, 0.0).lowest_mps;
    assert_true(limit_mps > last_mps);
    last_mps = limit_mps;
  }
}

/// At a speed that the flow does not suffice for the blade rises before the body tips, and at no
/// speed further than is allowed, as there it will not be so fast.
TEST(the_blade_rises_before_the_body_tips) {
  const GradeProfile design(test::ledge(-0.3, 0.3));
  const Preview preview = standing(design, 9.2);
  double highest_m = 0.0;
  double highest_at_m = 0.0;
  for (double x_m = 9.2; x_m < 11.0; x_m += 0.05) {
    const double lift_m = preview.lift(x_m, 1.6, kAllowed_m).height_m;
    assert_true(lift_m >= -1e-9);
    highest_at_m = lift_m > highest_m ? x_m : highest_at_m;
    highest_m = std::max(highest_m, lift_m);
  }
  // The crest is at 10.
  assert_true(highest_at_m > 9.2 && highest_at_m < 10.0);
  assert_true(highest_m > 0.5 * kAllowed_m);
  assert_true(highest_m <= 1.2 * kAllowed_m);
}

/// v^2 <= v_i^2 + 2 a s: the nearer the bend, the slower, by the braking that is planned with.
TEST(it_brakes_in_time_for_a_bend) {
  const GradeProfile design(test::ledge(-0.35, 0.3));
  const Preview preview = standing(design, 8.3);
  const double near_mps = preview.limit(8.4, 0.0, kAllowed_m, 0.0).speed_mps;
  const double far_mps = preview.limit(8.3, 0.0, kAllowed_m, 0.0).speed_mps;
  assert_near(far_mps * far_mps - near_mps * near_mps,
              2.0 * profile().travel.deceleration_max_mps2 * 0.1, 0.01);
  // Seen no sooner than it is looked for.
  assert_true(standing_at(design, 2.0, 0.0, 0.0).speed_mps > 5.0);
}

/// What it takes to answer counts as way that is already driven.
TEST(the_lead_is_left_off) {
  const GradeProfile design(test::ledge(-0.35, 0.3));
  const Preview preview = standing(design, 8.9);
  const double with_mps = preview.limit(8.9, 0.5, kAllowed_m, 0.2).speed_mps;
  const double without_mps = preview.limit(9.0, 0.5, kAllowed_m, 0.0).speed_mps;
  assert_near(with_mps, without_mps, 1e-3);
}

/// A ledge ahead: the body will tip over it, which the paper's limit sees only when it happens.
TEST(it_knows_that_the_body_will_tip) {
  const AheadLimit ahead = standing_at(GradeProfile(profile().grade), 3.3, 1.2, 0.0);
  assert_true(ahead.lowest_mps < 0.5);
  assert_true(ahead.lowest_mps >= profile().travel.speed_min_mps);
}

/// Where the blade does not come down to the design it leaves ground standing, at any speed.
TEST(what_the_blade_does_not_reach_is_a_cost) {
  const double reached_m = standing(GradeProfile(test::bend(-0.1, 0.3)), 8.9).least_cost_m(9.3);
  const Preview beyond = standing(GradeProfile(test::bend(-0.5, 0.3)), 8.9);
  assert_true(reached_m < 0.005);
  assert_true(beyond.least_cost_m(9.3) > 0.1);
  assert_near(beyond.limit(8.9, 3.0, kAllowed_m, 0.0).lowest_mps, profile().travel.speed_min_mps,
              1e-12);
}

/// A full flow lowers the blade slower and slower towards the end of its stroke.
TEST(towards_the_end_of_the_stroke_it_is_slower) {
  const auto lowest_mps = [](double slope) {
    return standing(GradeProfile(test::bend(slope, 0.3)), 8.9, 10.0)
        .limit(8.9, 3.0, 1e-3, 0.0)
        .lowest_mps;
  };
  assert_true(lowest_mps(-0.1) > 2.0);
  assert_true(lowest_mps(-0.28) < 1.0);
}

/// Until a station is known it counts as the slowest.
TEST(what_is_not_known_yet_is_slow) {
  const GradeProfile design(test::level(0.0));
  Preview preview(profile(), blade());
  preview.look(GroundMap(), design, 0.0, {0.0, 0.0}, flow_m3ps());
  assert_near(preview.limit(0.0, 1.0, kAllowed_m, 0.0).lowest_mps, profile().travel.speed_min_mps,
              1e-12);
}

/// The fastest probe needs 2.5 m of 0.032 m a step, eight steps a cycle.
TEST(it_is_known_after_some_cycles) {
  const GradeProfile design(test::level(0.0));
  const GroundMap untouched;
  Preview preview(profile(), blade());
  int looks = 0;
  do {
    preview.look(untouched, design, 0.0, {0.0, 0.0}, flow_m3ps());
    ++looks;
  } while (looks < 100 &&
           preview.limit(0.0, 4.0, kAllowed_m, 0.0).lowest_mps <= profile().travel.speed_min_mps);
  assert_int_equal(looks, 10);
}

/// Forwards, backwards, and far away.
TEST(it_follows_wherever_the_machine_goes) {
  const GradeProfile design(test::ledge(-0.35, 0.3));
  const GroundMap untouched;
  Preview preview(profile(), blade());
  for (const double target_m : {8.0, 3.0, 8.0, 500.0, -80.0, 8.0}) {
    for (int n = 0; n < 400; ++n) {
      preview.look(untouched, design, target_m, {0.0, 0.0}, flow_m3ps());
    }
  }
  const double there_mps = preview.limit(8.0, 0.0, kAllowed_m, 0.0).speed_mps;
  assert_near(there_mps, standing_at(design, 8.0, 0.0, 0.0).speed_mps, 1e-6);
}

/// No place is too far to be looked at, and none need be a number.
TEST(far_away_it_stays_defined) {
  const GradeProfile design(test::level(0.0));
  Preview preview(profile(), blade());
  for (const double x_m : {1e9, -1e300, std::numeric_limits<double>::quiet_NaN()}) {
    preview.look(GroundMap(), design, x_m, {0.0, 0.0}, flow_m3ps());
    assert_true(preview.limit(x_m, 1.0, kAllowed_m, 0.2).speed_mps >= 0.0);
    assert_true(std::isfinite(preview.lift(x_m, 1.0, kAllowed_m).height_m));
  }
}
