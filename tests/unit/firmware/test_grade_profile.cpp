// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/grade_profile.hpp"

#include <array>
#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

const GradeDesign& design() { return test::dozer().profile.grade; }

TEST(away_from_corners_it_goes_through_the_points) {
  const GradeProfile profile(design());
  for (int i = 0; i + 1 < design().count; ++i) {
    const GradePoint& from = design().point[static_cast<unsigned>(i)];
    const GradePoint& to = design().point[static_cast<unsigned>(i) + 1];
    const double slope = (to.z_m - from.z_m) / (to.x_m - from.x_m);
    const double middle_m = 0.5 * (from.x_m + to.x_m);
    assert_near(profile.at(middle_m).height_m, 0.5 * (from.z_m + to.z_m), 1e-12);
    assert_near(profile.at(middle_m).slope, slope, 1e-12);
  }
}

/// A parabola of this length leaves the corner by a quarter of kink times half length.
TEST(corners_are_parabolas) {
  const GradeDesign bent = test::bend(-0.4, 0.3);
  const GradeProfile profile(bent);
  assert_near(profile.at(9.7).height_m, 0.0, 1e-12);
  assert_near(profile.at(9.7).slope, 0.0, 1e-12);
  assert_near(profile.at(10.0).height_m, -0.4 * 0.3 / 4.0, 1e-12);
  assert_near(profile.at(10.0).slope, -0.2, 1e-12);
  assert_near(profile.at(10.3).height_m, -0.4 * 0.3, 1e-12);
  assert_near(profile.at(10.3).slope, -0.4, 1e-12);
}

TEST(slope_is_the_derivative_and_has_no_step) {
  const GradeProfile profile(design());
  double last = profile.at(0.5).slope;
  for (double x_m = 0.5; x_m < 26.5; x_m += 0.001) {
    const double derivative =
        (profile.at(x_m + 1e-6).height_m - profile.at(x_m - 1e-6).height_m) / 2e-6;
    assert_near(profile.at(x_m).slope, derivative, 1e-5);
    assert_near(profile.at(x_m).slope, last, 2e-3);
    last = profile.at(x_m).slope;
  }
}

TEST(beyond_its_ends_it_goes_on_level) {
  const GradeProfile profile(test::bend(-0.1, 0.3));
  assert_near(profile.at(-50.0).height_m, 0.0, 1e-12);
  assert_near(profile.at(80.0).height_m, -5.0, 1e-12);
  assert_near(profile.at(80.0).slope, 0.0, 1e-12);
}

TEST(the_plane_lies_under_it) {
  GradeDesign tilted = design();
  tilted.plane_height_m = 1.5;
  tilted.plane_slope = 0.02;
  const GradeProfile over(tilted);
  const GradeProfile flat(design());
  for (double x_m = -2.0; x_m < 30.0; x_m += 0.37) {
    assert_near(over.at(x_m).height_m, flat.at(x_m).height_m + 1.5 + 0.02 * x_m, 1e-12);
    assert_near(over.at(x_m).slope, flat.at(x_m).slope + 0.02, 1e-12);
  }
}

TEST(the_error_is_along_the_normal) {
  const GradeProfile profile(test::bend(-0.75, 0.3));
  assert_near(grade_error_m(profile, 5.0, 0.1), 0.1, 1e-12);
  // 3-4-5: a slope of 3/4 makes 4/5 of the height.
  const double below_m = profile.at(30.0).height_m - 0.1;
  assert_near(grade_error_m(profile, 30.0, below_m), -0.08, 1e-12);
}

TEST(a_design_without_points_is_the_plane, GradeDesign empty) {
  empty.plane_height_m = 2.0;
  assert_near(GradeProfile(empty).at(7.0).height_m, 2.0, 0.0);
}

/// A pass goes no lower than it may, along the plane.
TEST(a_floor_holds_it_up) {
  GradeDesign tilted = design();
  tilted.plane_slope = 0.02;
  const GradeProfile whole(tilted);
  GradeProfile pass(tilted);
  pass.set_floor(-0.2);
  assert_near(pass.at(7.0).height_m, 0.02 * 7.0 - 0.2, 1e-12);
  assert_near(pass.at(7.0).slope, 0.02, 1e-12);
  assert_near(pass.at(2.0).height_m, whole.at(2.0).height_m, 0.0);
  assert_near(pass.at(11.0).height_m, whole.at(11.0).height_m, 0.0);
}

/// Heights of a parabola, and of a bend.
std::array<double, 101> on_grid(double curvature) {
  std::array<double, 101> height_m{};
  for (unsigned i = 0; i < height_m.size(); ++i) {
    const double x_m = GradeHeights::kStep_m * i;
    height_m[i] = -0.5 * curvature * x_m * x_m;
  }
  return height_m;
}

GradeDesign with_heights(const std::array<double, 101>& height_m) {
  GradeDesign grade;
  grade.heights = {height_m.data(), nullptr, static_cast<int>(height_m.size()), 2.0};
  return grade;
}

/// Between the heights too, but for the ends, where it goes on level.
TEST(heights_on_a_grid_are_gone_through) {
  const auto height_m = on_grid(0.1);
  const GradeDesign grade = with_heights(height_m);
  assert_near(grade.begin_m(), 2.0, 0.0);
  assert_near(grade.end_m(), 7.0, 1e-12);
  const GradeProfile profile(grade);
  for (double x_m = 2.1; x_m < 6.9; x_m += 0.0137) {
    const double along_m = x_m - 2.0;
    assert_near(profile.at(x_m).height_m, -0.05 * along_m * along_m, 1e-12);
    assert_near(profile.at(x_m).slope, -0.1 * along_m, 1e-12);
  }
  for (const double beyond_m : {-1e7, -3.0, 2.0}) {
    assert_near(profile.at(beyond_m).height_m, 0.0, 0.0);
    assert_near(profile.at(beyond_m).slope, 0.0, 0.0);
  }
  for (const double beyond_m : {7.0 + 1e-12, 1e7}) {
    assert_near(profile.at(beyond_m).height_m, -1.25, 1e-12);
    assert_near(profile.at(beyond_m).slope, 0.0, 0.0);
  }
  assert_true(std::isnan(profile.at(std::nan("")).height_m));
}

/// As of points: the slope has no step, and plane and floor hold.
TEST(heights_have_a_plane_and_a_floor) {
  const auto height_m = on_grid(0.1);
  GradeDesign grade = with_heights(height_m);
  grade.plane_height_m = 1.0;
  grade.plane_slope = 0.02;
  GradeProfile profile(grade);
  double last = profile.at(2.2).slope;
  for (double x_m = 2.2; x_m < 6.9; x_m += 0.001) {
    assert_near(profile.at(x_m).slope, last, 2e-4);
    last = profile.at(x_m).slope;
  }
  assert_near(profile.at(5.0).height_m, 1.0 + 0.02 * 5.0 - 0.05 * 9.0, 1e-12);
  profile.set_floor(-0.2);
  assert_near(profile.at(5.0).height_m, 1.0 + 0.02 * 5.0 - 0.2, 1e-12);
  assert_near(profile.at(5.0).slope, 0.02, 1e-12);
}
