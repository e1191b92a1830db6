// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/blade.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

const BladeGeometry& geometry() { return test::dozer().profile.blade; }

/// Home as machines/dozer_9t.toml has it: edge at the ground line, cylinder at its home length, so
/// that L12 closes the triangle.
TEST(home_is_where_the_file_says) {
  const BladeKinematics blade(geometry());
  assert_near(blade.edge_m(0.0).y(), 0.0, 1e-12);
  assert_near(blade.edge_m(0.0).x(), 0.6718 + std::sqrt(1.6 * 1.6 - 0.386 * 0.386), 1e-12);
  const Eigen::Vector2d eye_m =
      geometry().pivot_m + blade.eye_radius_m() * geometry().arm_m.normalized();
  assert_near((eye_m - geometry().base_m).norm(), geometry().length_home_m, 1e-12);
  assert_near(blade.eye_radius_m(), 0.7079, 1e-4);
}

TEST(its_reach_is_that_of_the_file) {
  const BladeKinematics blade(geometry());
  assert_near(blade.edge_m(blade.angle_min_rad()).y(), -0.38, 1e-12);
  assert_near(blade.edge_m(blade.angle_max_rad()).y(), 0.80, 1e-12);
  assert_near(blade.stroke_m(blade.angle_max_rad()), 0.0, 1e-12);
  assert_near(blade.stroke_m(blade.angle_min_rad()), blade.stroke_max_m(), 1e-12);
  const DozerProfile& profile = test::dozer().profile;
  assert_near(dozer_bank(profile).row[0].most_travel_m,
              BladeKinematics(profile.blade).stroke_max_m(), 0.0);
}

TEST(stroke_and_angle_are_each_others_inverse) {
  const BladeKinematics blade(geometry());
  for (int i = 0; i <= 20; ++i) {
    const double stroke_m = blade.stroke_max_m() * i / 20.0;
    assert_near(blade.stroke_m(blade.angle_rad(stroke_m)), stroke_m, 1e-12);
  }
  // Extension lowers.
  assert_true(blade.angle_rad(0.1) > blade.angle_rad(0.2));
}

TEST(rates_are_the_derivatives) {
  const BladeKinematics blade(geometry());
  constexpr double kStep_rad = 1e-6;
  for (double angle_rad = -0.2; angle_rad < 0.45; angle_rad += 0.05) {
    const double stroke_rate =
        (blade.stroke_m(angle_rad + kStep_rad) - blade.stroke_m(angle_rad - kStep_rad)) /
        (2.0 * kStep_rad);
    assert_near(blade.stroke_rate_mprad(angle_rad), stroke_rate, 1e-8);
    assert_true(stroke_rate < 0.0);
    const Eigen::Vector2d edge_rate =
        (blade.edge_m(angle_rad + kStep_rad) - blade.edge_m(angle_rad - kStep_rad)) /
        (2.0 * kStep_rad);
    assert_near((blade.edge_rate_mprad(angle_rad) - edge_rate).norm(), 0.0, 1e-8);
  }
}

TEST(beyond_its_reach_it_stays_at_the_end) {
  const BladeKinematics blade(geometry());
  assert_near(blade.angle_rad(-1.0), blade.angle_max_rad(), 1e-12);
  assert_near(blade.angle_rad(9.0), blade.angle_min_rad(), 1e-12);
  assert_near(blade.stroke_m(9.0), 0.0, 1e-12);
  assert_near(blade.stroke_m(-9.0), blade.stroke_max_m(), 1e-12);
}
