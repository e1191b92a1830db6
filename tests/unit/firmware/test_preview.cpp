#include <limits>

#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/travel/preview.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

namespace {

using namespace graben;

const DozerProfile& profile() { return test::dozer().profile; }

const BladeKinematics& blade() {
  static const BladeKinematics of(profile().blade);
  return of;
}

double flow_m3ps() { return available_flow_m3ps(profile().implement, 157.08); }

/// What the preview allows at `x_m`, after it has stood there for long.
AheadLimit standing_at(const GradeProfile& design, double x_m, double speed_mps, double lead_s) {
  Preview preview(profile(), blade());
  const GroundMap untouched;
  for (int n = 0; n < 100; ++n) {
    preview.look(untouched, design, x_m, {0.0, 0.0});
  }
  return preview.limit(x_m, speed_mps, flow_m3ps(), lead_s);
}

void on_the_level_nothing_holds_it(void**) {
  const AheadLimit ahead = standing_at(GradeProfile(test::level(0.0)), 0.0, 1.0, 0.2);
  assert_true(ahead.speed_mps > 5.0);
  assert_true(ahead.lowest_mps > 5.0);
}

/// Body level, edge on a long slope, all far from the bend: the blade cylinders' speed over the
/// machine's is that of the triangle, worked out here by itself.
void on_a_slope_before_the_tracks_it_is_the_flow_of_the_cylinders(void**) {
  const GradeDesign bent = test::bend(-0.2, 0.3);
  const GradeProfile design(bent);
  const BladeKinematics blade(profile().blade);
  const double x_m = 8.4;  // Edge near 10.6, first wheel at 9.6.
  const auto stroke_at = [&](double at_m) {
    double angle_rad = 0.0;
    for (int n = 0; n < 50; ++n) {
      const Eigen::Vector2d edge_m = blade.edge_m(angle_rad);
      angle_rad += (design.at(at_m + edge_m.x()).height_m - edge_m.y()) / 1.6;
    }
    return blade.stroke_m(angle_rad);
  };
  const double per_metre = (stroke_at(x_m + 0.01) - stroke_at(x_m - 0.01)) / 0.02;
  const double expected_mps = flow_m3ps() / inflow_m3ps(profile().blade, per_metre);
  // With what is ahead too far away to matter at this speed.
  const AheadLimit ahead = standing_at(design, x_m, 0.0, 0.0);
  assert_true(ahead.speed_mps <= expected_mps * 1.001);
  assert_true(ahead.speed_mps >= expected_mps * 0.95);
}

/// v^2 <= v_i^2 + 2 a s: the nearer the bend, the slower, by the braking that is planned with.
void it_brakes_in_time_for_a_bend(void**) {
  const GradeProfile design(test::bend(-0.4, 0.3));
  const double near_mps = standing_at(design, 7.0, 0.0, 0.0).speed_mps;
  const double far_mps = standing_at(design, 6.0, 0.0, 0.0).speed_mps;
  assert_near(far_mps * far_mps - near_mps * near_mps,
              2.0 * profile().travel.deceleration_max_mps2 * 1.0, 0.02);
  // Seen no sooner than it is looked for.
  assert_true(standing_at(design, 2.0, 0.0, 0.0).speed_mps > 5.0);
}

/// What it takes to answer counts as way that is already driven.
void the_lead_is_left_off(void**) {
  const GradeProfile design(test::bend(-0.4, 0.3));
  const double with_mps = standing_at(design, 6.6, 1.0, 0.4).speed_mps;
  const double without_mps = standing_at(design, 7.0, 1.0, 0.0).speed_mps;
  assert_near(with_mps, without_mps, 0.02);
}

/// A ledge ahead: the body will tip over it, which the paper's limit sees only when it happens.
void it_knows_that_the_body_will_tip(void**) {
  const GradeProfile design(profile().grade);
  const GroundMap untouched;
  Preview preview(profile(), blade());
  for (int n = 0; n < 100; ++n) {
    preview.look(untouched, design, 3.3, {0.0, 0.0});
  }
  const AheadLimit ahead = preview.limit(3.3, 1.0, flow_m3ps(), 0.0);
  assert_true(ahead.lowest_mps < 0.5);
  assert_true(ahead.lowest_mps >= profile().travel.speed_min_mps);
}

/// Until a station is known it counts as the slowest.
void what_is_not_known_yet_is_slow(void**) {
  const GradeProfile design(test::level(0.0));
  Preview preview(profile(), blade());
  preview.look(GroundMap(), design, 0.0, {0.0, 0.0});
  assert_near(preview.limit(0.0, 0.0, flow_m3ps(), 0.0).lowest_mps, profile().travel.speed_min_mps,
              1e-12);
}

/// Looks from a place on the level, from this stand, until all that is near is known. Until then it
/// is as slow as what is not known.
int looks_until_known(const Stand& measured) {
  const GradeProfile design(test::level(0.0));
  const GroundMap untouched;
  Preview preview(profile(), blade());
  for (int looks = 1; looks < 300; ++looks) {
    preview.look(untouched, design, 0.0, measured);
    const AheadLimit ahead = preview.limit(0.0, 0.0, flow_m3ps(), 0.0);
    if (ahead.lowest_mps > profile().travel.speed_min_mps) {
      return looks;
    }
    assert_near(ahead.lowest_mps, profile().travel.speed_min_mps, 1e-12);
  }
  return 0;
}

/// 36 stations, three a cycle, as one on the level takes a step. From 0.75 m up it comes down by
/// 0.05 m a step: the first two stations take eight each, all that a cycle has.
void what_takes_more_steps_takes_more_cycles(void**) {
  assert_int_equal(looks_until_known({0.0, 0.0}), 12);
  assert_int_equal(looks_until_known({0.75, 0.0}), 2 + 12);
}

/// Forwards, backwards, and far away.
void it_follows_wherever_the_machine_goes(void**) {
  const GradeProfile design(test::bend(-0.4, 0.3));
  const GroundMap untouched;
  Preview preview(profile(), blade());
  for (const double target_m : {7.0, 3.0, 7.0, 500.0, -80.0, 7.0}) {
    for (int n = 0; n < 200; ++n) {
      preview.look(untouched, design, target_m, {0.0, 0.0});
    }
  }
  const double there_mps = preview.limit(7.0, 0.0, flow_m3ps(), 0.0).speed_mps;
  assert_near(there_mps, standing_at(design, 7.0, 0.0, 0.0).speed_mps, 1e-6);
}

/// No place is too far to be looked at, and none need be a number.
void far_away_it_stays_defined(void**) {
  const GradeProfile design(test::level(0.0));
  Preview preview(profile(), blade());
  for (const double x_m : {1e9, -1e300, std::numeric_limits<double>::quiet_NaN()}) {
    preview.look(GroundMap(), design, x_m, {0.0, 0.0});
    assert_true(preview.limit(x_m, 1.0, flow_m3ps(), 0.2).speed_mps >= 0.0);
  }
}

/// The ground that was really cut replaces the design under the tracks.
void it_learns_what_was_cut(void**) {
  const GradeProfile design(test::level(0.0));
  GroundMap ground;
  for (double x_m = 0.0; x_m < 5.0; x_m += 0.02) {
    const double dent_m = x_m > 4.0 && x_m < 4.4 ? -0.07 : 0.0;
    ground.pass(x_m, dent_m, design, -2.2, 0.0, 0.0);
  }
  Preview preview(profile(), blade());
  for (int n = 0; n < 200; ++n) {
    preview.look(ground, design, 2.8, {0.0, 0.0});
  }
  const double dented_mps = preview.limit(2.8, 0.0, flow_m3ps(), 0.0).lowest_mps;
  assert_true(dented_mps < 0.8 * standing_at(design, 2.8, 0.0, 0.0).lowest_mps);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(on_the_level_nothing_holds_it),
      cmocka_unit_test(on_a_slope_before_the_tracks_it_is_the_flow_of_the_cylinders),
      cmocka_unit_test(it_brakes_in_time_for_a_bend),
      cmocka_unit_test(the_lead_is_left_off),
      cmocka_unit_test(it_knows_that_the_body_will_tip),
      cmocka_unit_test(what_is_not_known_yet_is_slow),
      cmocka_unit_test(what_takes_more_steps_takes_more_cycles),
      cmocka_unit_test(it_follows_wherever_the_machine_goes),
      cmocka_unit_test(far_away_it_stays_defined),
      cmocka_unit_test(it_learns_what_was_cut),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
