// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "firmware/dozer/travel/fall.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

constexpr double kPeriod_s = 0.01;

const DozerProfile& profile() { return test::dozer().profile; }

const BladeKinematics& blade() {
  static const BladeKinematics kinematics(profile().blade);
  return kinematics;
}

/// Level, with its blade at home.
FallSituation level_at(double x_m, double raise_mps) {
  FallSituation now;
  now.driving = {motion_of(profile().body, {0.0, 0.0}, 0.0, 0.0), x_m, 0.1};
  now.stroke_m = blade().stroke_m(0.0);
  now.answer_s = 0.05;
  now.raise_mps = raise_mps;
  return now;
}

FallState after(const GradeProfile& design, const FallSituation& now, double seconds,
                FallState state = {}) {
  const GroundMap ground = test::cut_to(design, now.driving.x_m);
  for (int n = 0; n < static_cast<int>(seconds / kPeriod_s + 0.5); ++n) {
    state = next_fall(profile(), blade(), ground, design, state, now, kPeriod_s);
  }
  return state;
}

TEST(on_level_ground_nothing_falls) {
  const FallState state = after(GradeProfile(test::level(0.0)), level_at(0.0, 0.1), 0.5);
  assert_near(state.sinks_m, 0.0, 1e-6);
  assert_near(state.lift_m, 0.0, 0.0);
}

/// Its mass centre 0.4 m beyond a crest, and still level: it will come down faster than a slow
/// blade rises. A fast one it does not need room for.
TEST(a_body_that_is_held_over_a_crest_is_given_room) {
  const GradeProfile design(test::bend(-0.3, 0.3));
  const FallState slow = after(design, level_at(10.4, 0.03), 0.5);
  const FallState fast = after(design, level_at(10.4, 0.5), 0.5);
  assert_true(slow.sinks_m > fast.sinks_m + 0.02);
  assert_near(slow.lift_m, 0.8 * profile().grade.tolerance_m, 1e-12);
  assert_near(fast.lift_m,
              std::clamp(fast.sinks_m - 0.2 * profile().grade.tolerance_m, 0.0,
                         0.8 * profile().grade.tolerance_m),
              1e-12);
}

/// As fast as a lift may, down slower; its rate is told.
TEST(the_lift_comes_and_goes_at_its_rates) {
  const GradeProfile crest(test::bend(-0.3, 0.3));
  const FallState rising = after(crest, level_at(10.4, 0.03), 0.08);
  assert_near(rising.rate_mps, 0.2, 1e-9);
  assert_in_range(static_cast<int>(1e4 * rising.lift_m), 1, 159);
  const FallState up = after(crest, level_at(10.4, 0.03), 0.5);
  const FallState down = after(GradeProfile(test::level(0.0)), level_at(0.0, 0.1), 0.2, up);
  assert_near(down.rate_mps, -0.05, 1e-9);
  assert_true(down.lift_m > 0.0 && down.lift_m < up.lift_m);
}

/// An edge that is raised already falls as far, and not from a design that it does not touch.
TEST(it_counts_from_where_the_edge_is) {
  const GradeProfile design(test::bend(-0.3, 0.3));
  FallSituation above = level_at(10.4, 0.03);
  above.stroke_m -= 0.01;
  const double home_m = after(design, level_at(10.4, 0.03), 0.1).sinks_m;
  assert_near(after(design, above, 0.1).sinks_m, home_m, 0.1 * home_m);
}

/// The blade has to have risen by what the edge sinks when the machine is 0.1 m on; where it rises
/// in time nothing holds the machine.
TEST(a_deep_fall_is_driven_to_slowly) {
  const GradeProfile design(test::bend(-0.3, 0.3));
  const FallState deep = after(design, level_at(10.4, 0.03), 0.1);
  const double per_stroke = -blade().edge_rate_mprad(0.0).y() / blade().stroke_rate_mprad(0.0);
  assert_true(deep.sinks_m > 0.05);
  assert_near(deep.speed_mps, 0.1 * 0.03 * per_stroke / deep.sinks_m, 1e-9);
  const FallState none = after(GradeProfile(test::level(0.0)), level_at(0.0, 0.1), 0.1);
  assert_true(none.speed_mps > 10.0);
}
