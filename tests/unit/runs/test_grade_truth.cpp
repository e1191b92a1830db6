// SPDX-License-Identifier: Apache-2.0
/// What the design asks of the blade, by hand.

#include "app/runs/grade_truth.hpp"

#include <cmath>

#include "app/machines/simulated/simulated_dozer.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using runs::BodyPose;
using runs::BodyRates;
using runs::GradeTruth;

const DozerProfile& profile() {
  static const machines::SimulatedDozer machine =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  return machine.profile;
}

const GradeTruth& truth() {
  static const GradeTruth made(profile());
  return made;
}

/// Pivot to edge, forward, at home: sqrt(1.60^2 - 0.386^2).
constexpr double kReach_m = 1.552741;
constexpr double kPivot_m = 0.6718;

TEST(at_home_the_edge_is_at_the_ground_line) {
  const Eigen::Vector2d edge = truth().edge_m({3.0, 0.5, 0.0}, 0.0);
  assert_near(edge.x(), 3.0 + kPivot_m + kReach_m, 1e-6);
  assert_near(edge.y(), 0.5, 1e-12);
  // Nose up by a quarter turn, forward is up and up is back.
  const Eigen::Vector2d upright = truth().edge_m({0.0, 0.0, 0.5 * 3.14159265358979}, 0.0);
  assert_near(upright.x(), 0.0, 1e-9);
  assert_near(upright.y(), kPivot_m + kReach_m, 1e-6);
  // Fully lowered it is 0.38 m below the body: then forward.
  const double lowest = plant::BladeLinkage(profile().blade).lowest_rad();
  assert_near(truth().edge_m({0.0, 0.0, 0.5 * 3.14159265358979}, lowest).x(), 0.38, 1e-9);
}

/// Strokes run from the blade fully raised to fully lowered; beyond them the end counts.
TEST(angle_of_a_stroke) {
  const plant::BladeLinkage linkage(profile().blade);
  for (const double angle : {linkage.lowest_rad(), -0.1, 0.0, 0.3, linkage.highest_rad()}) {
    assert_near(truth().blade_angle_rad(linkage.stroke_m(angle)), angle, 1e-12);
  }
  assert_near(truth().blade_angle_rad(-1.0), linkage.highest_rad(), 1e-12);
  assert_near(truth().blade_angle_rad(9.0), linkage.lowest_rad(), 1e-12);
}

/// The trench's floor is 0.35 m down from 5.3 m on; between 4.3 and 4.7 m it falls by 0.35 in 1 m.
TEST(error_is_the_height_over_the_design) {
  assert_near(truth().error_m({2.0, 0.01}), 0.01, 1e-12);
  assert_near(truth().error_m({7.0, -0.36}), -0.01, 1e-12);
  assert_near(truth().error_m({4.5, -0.175}), 0.0, 1e-12);
}

/// Cylinder velocity per velocity of the edge upwards, at home and level: by the linkage's lever.
double per_rise() {
  const plant::BladeLinkage linkage(profile().blade);
  return linkage.length_per_angle_m(0.0) / kReach_m;
}

TEST(on_the_level_the_blade_may_stand) {
  assert_near(truth().required_blade_mps({}, {1.6, 0.0, 0.0}, 0.0), 0.0, 1e-9);
}

/// A body that rises makes the blade go down, which is out; one that raises its nose too, by the
/// edge's distance from the body's origin.
TEST(the_bodys_motion_is_made_up_for) {
  assert_true(per_rise() < 0.0);
  assert_near(truth().required_blade_mps({}, {0.0, 0.1, 0.0}, 0.0), -0.1 * per_rise(), 1e-7);
  assert_near(truth().required_blade_mps({}, {0.0, 0.0, 0.2}, 0.0),
              -0.2 * (kPivot_m + kReach_m) * per_rise(), 1e-7);
}

/// The design falls under the edge: the blade follows its slope times the travel's speed, and what
/// the edge goes forward as it goes down: 0.386 m below the pivot.
TEST(the_designs_slope_is_followed) {
  // The edge is at 4.5 m, on the straight part of the way down.
  const BodyPose body = {4.5 - kPivot_m - kReach_m, -0.175, 0.0};
  const double wanted = 0.35 * per_rise() * kReach_m / (kReach_m + 0.35 * 0.386);
  assert_near(truth().required_blade_mps(body, {1.0, 0.0, 0.0}, 0.0), -wanted, 1e-6);
  assert_near(truth().required_blade_mps(body, {2.0, 0.0, 0.0}, 0.0), -2.0 * wanted, 1e-6);
}

/// Two cylinders of 110 mm with 60 mm rods: 0.019007 and 0.013352 m2.
TEST(flow_of_a_velocity) {
  assert_near(truth().inflow_m3ps(0.1), 0.0019007, 1e-7);
  assert_near(truth().inflow_m3ps(-0.1), 0.0013352, 1e-7);
  assert_near(truth().inflow_m3ps(0.0), 0.0, 0.0);
}

/// 84.6 L/min at 1500 rpm, in proportion at 1000; never more than the valve's 120 L/min.
TEST(available_flow) {
  assert_near(runs::available_flow_m3ps(profile(), 157.08) * 6e4, 84.6, 0.01);
  assert_near(runs::available_flow_m3ps(profile(), 104.72) * 6e4, 56.4, 0.01);
  assert_near(runs::available_flow_m3ps(profile(), 230.38) * 6e4, 120.0, 1e-9);
}
