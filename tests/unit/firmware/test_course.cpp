// SPDX-License-Identifier: Apache-2.0
// The machine on a track that curves: where its edge is, and that it steers there and back.

#include "firmware/dozer/travel/course.hpp"

#include <cmath>
#include <vector>

#include "firmware/dozer/tilt.hpp"
#include "tests/unit/cmocka_cpp.hpp"

constexpr double kReach_m = 2.27;
constexpr double kPeriod_s = 0.01;

/// Straight to x = 10 m, then of this curvature; along it a slope and, across, another.
struct Curve {
  explicit Curve(double curvature_pm, double grade = 0.0, double across = 0.0) {
    constexpr int kCount = 2001;
    for (int i = 0; i < kCount; ++i) {
      const double x_m = i * GradeHeights::kStep_m;
      height.push_back(grade * x_m);
      cross.push_back(across);
      curvature.push_back(x_m < 10.0 ? 0.0 : curvature_pm);
    }
    grade_.heights = {height.data(), cross.data(), kCount, 0.0, curvature.data()};
  }
  [[nodiscard]] GradeProfile design() const { return GradeProfile(grade_); }

  std::vector<double> height;
  std::vector<double> cross;
  std::vector<double> curvature;
  GradeDesign grade_;
};

TEST(on_an_arc_the_edge_is_outside_of_it) {
  for (const double radius_m : {20.0, -12.0}) {
    const Curve curve(1.0 / radius_m);
    const EdgeCourse edge = edge_course(curve.design(), 30.0, {}, kReach_m);
    // From the centre of the circle.
    const double distance_m = std::hypot(radius_m, kReach_m);
    assert_near(edge.offset_m, std::copysign(distance_m - std::abs(radius_m), -radius_m), 1e-3);
    const double across_m = std::abs(radius_m);
    assert_near(edge.ahead_m, across_m * std::atan2(kReach_m, across_m), 2e-3);
    assert_near(edge.heading_rad, -kReach_m / radius_m, 1e-9);
  }
  const Curve straight(0.0);
  const EdgeCourse edge = edge_course(straight.design(), 30.0, {0.1, 0.05, 0.0}, kReach_m);
  assert_near(edge.offset_m, 0.1 + kReach_m * std::sin(0.05), 1e-12);
  assert_near(edge.ahead_m, kReach_m * std::cos(0.05), 1e-12);
}

/// The edge of a machine in a left curve lies turned to the right: its left end ahead.
TEST(an_askew_edge_has_a_share_of_the_grade) {
  const Curve curve(0.05, 0.1, 0.03);
  const CrossSample along = slope_along_edge(curve.design(), 30.0, -0.11);
  assert_near(along.slope, std::cos(0.11) * 0.03 + std::sin(0.11) * 0.1, 1e-9);
  assert_near(along.change_pm, 0.0, 1e-9);
}

/// A machine that turns as it is told, but for what its tracks slip.
struct Driven {
  const GradeProfile& design;
  double slips = 0.0;
  double x_m = 0.0;
  Course course = {};
  SteeringState state = {};
  double most_m = 0.0;  ///< Of the edge off the track, of late.
  bool learns = true;

  void drive(double speed_mps, double way_m) {
    most_m = 0.0;
    const int count = static_cast<int>(way_m / std::abs(speed_mps) / kPeriod_s);
    for (int n = 0; n < count; ++n) {
      state =
          steer(design, state, {x_m, kReach_m, speed_mps, speed_mps, course, learns}, kPeriod_s);
      course.yaw_rate_radps = (1.0 - slips) * state.curvature_pm * speed_mps;
      const double along_mps = speed_mps * std::cos(course.heading_rad) /
                               (1.0 - design.curvature_at(x_m) * course.offset_m);
      course.offset_m += kPeriod_s * speed_mps * std::sin(course.heading_rad);
      course.heading_rad +=
          kPeriod_s * (course.yaw_rate_radps - design.curvature_at(x_m) * along_mps);
      x_m += kPeriod_s * along_mps;
      most_m = std::max(most_m, std::abs(edge_course(design, x_m, course, kReach_m).offset_m));
    }
  }
};

TEST(forward_the_edge_keeps_to_the_track) {
  for (const double slips : {0.0, 0.3}) {
    const Curve curve(0.05);
    const GradeProfile design = curve.design();
    Driven machine{design, slips};
    machine.drive(1.6, 30.0);
    assert_true(machine.most_m < (slips > 0.0 ? 0.08 : 0.02));
    machine.drive(1.6, 10.0);
    assert_true(machine.most_m < 0.005);
    // Its origin has gone inside.
    assert_near(machine.course.offset_m, 20.0 - std::sqrt(400.0 - kReach_m * kReach_m), 0.01);
    assert_near(machine.state.trim_pm, slips > 0.0 ? 0.05 * slips / (1.0 - slips) : 0.0, 2e-3);
  }
}

TEST(told_not_to_it_learns_no_slip) {
  const Curve curve(0.05);
  const GradeProfile design = curve.design();
  Driven machine{design, 0.3};
  machine.learns = false;
  machine.drive(1.6, 40.0);
  assert_near(machine.state.trim_pm, 0.0, 0.0);
  assert_true(machine.most_m > 0.005);
}

TEST(it_comes_back_from_beside) {
  const Curve straight(0.0);
  const GradeProfile design = straight.design();
  Driven machine{design};
  machine.course = {0.3, 0.1, 0.0};
  machine.drive(1.0, 20.0);
  assert_near(machine.course.offset_m, 0.0, 2e-3);
  assert_near(machine.course.heading_rad, 0.0, 2e-3);
}

TEST(backward_the_origin_is_led) {
  const Curve curve(-0.06);
  const GradeProfile design = curve.design();
  Driven machine{design, 0.1, 60.0, {0.2, 0.05, 0.0}};
  machine.drive(-0.8, 30.0);
  machine.drive(-0.8, 10.0);
  assert_true(machine.most_m < 0.03);
  assert_true(machine.x_m < 21.0 && machine.x_m > 18.0);
}

/// Nothing turns it tighter, and a machine at rest learns nothing.
TEST(it_is_bounded) {
  const Curve straight(0.0);
  const GradeProfile design = straight.design();
  SteeringState state;
  for (int n = 0; n < 1000; ++n) {
    state = steer(design, state, {5.0, kReach_m, 1.0, 0.0, {-5.0, -1.0, 0.0}}, kPeriod_s);
  }
  assert_near(state.curvature_pm, kTightest_pm, 0.0);
  assert_near(state.trim_pm, 0.0, 0.0);
}

TEST(a_course_goes_on) {
  const Curve curve(0.05);
  const Course after = course_after(curve.design(), {0.1, 0.02, 0.03}, 30.0, 1.0, 0.2);
  assert_near(after.offset_m, 0.1 + 0.2 * std::sin(0.02), 1e-12);
  assert_near(after.heading_rad, 0.02 + 0.2 * (0.03 - 0.05), 1e-9);
}
