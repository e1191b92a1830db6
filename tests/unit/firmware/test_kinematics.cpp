// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"

constexpr int kSteps = 16;

const ExcavatorKinematics& machine() {
  static const ExcavatorKinematics kinematics(test::excavator().profile.geometry);
  return kinematics;
}

double stroke_max(unsigned axis) { return machine().geometry().cylinder[axis].stroke_m; }

/// Calls `check` over a grid that includes every end of every stroke.
template <class Check>
void over_the_whole_range(Check check) {
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      for (int k = 0; k <= kSteps; ++k) {
        check(Eigen::Vector3d(stroke_max(0) * i / kSteps, stroke_max(1) * j / kSteps,
                              stroke_max(2) * k / kSteps));
      }
    }
  }
}

TEST(strokes_to_pose_and_back) {
  over_the_whole_range([](const Eigen::Vector3d& strokes) {
    const JointResult joints = machine().joints_from_strokes(strokes);
    assert_int_equal(joints.status, ReachStatus::kOk);
    const StrokeResult back =
        machine().strokes_from_pose(machine().pose_from_joints(joints.joints_rad));
    assert_int_equal(back.status, ReachStatus::kOk);
    for (int axis = 0; axis < kAxisCount; ++axis) {
      assert_near(back.strokes_m[axis], strokes[axis], 1e-9);
    }
  });
}

Eigen::Vector3d tip_at(const Eigen::Vector3d& strokes) {
  const TipPose tip = machine().pose_from_joints(machine().joints_from_strokes(strokes).joints_rad);
  return {tip.x_m, tip.y_m, tip.attitude_rad};
}

TEST(jacobian_is_the_slope_of_the_pose) {
  constexpr double kStep_m = 1e-6;
  over_the_whole_range([](const Eigen::Vector3d& strokes) {
    Eigen::Vector3d inside = strokes;
    for (int axis = 0; axis < kAxisCount; ++axis) {
      inside[axis] =
          std::min(std::max(inside[axis], 1e-4), stroke_max(static_cast<unsigned>(axis)) - 1e-4);
    }
    const KinematicState state = machine().state(inside);
    assert_int_equal(state.status, ReachStatus::kOk);
    for (int axis = 0; axis < kAxisCount; ++axis) {
      Eigen::Vector3d ahead = inside;
      Eigen::Vector3d behind = inside;
      ahead[axis] += kStep_m;
      behind[axis] -= kStep_m;
      const Eigen::Vector3d slope = (tip_at(ahead) - tip_at(behind)) / (2.0 * kStep_m);
      const Eigen::Vector3d column = state.jacobian.col(axis);
      for (int row = 0; row < 3; ++row) {
        assert_near(column[row], slope[row], 1e-6 * std::max(1.0, std::abs(slope[row])));
      }
    }
    const Eigen::Matrix3d unit = state.jacobian * state.jacobian_inverse;
    assert_true((unit - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-9);
  });
}

/// Pins by hand: all joints at zero put the links in one horizontal line, the attitude backwards.
TEST(straight_out_is_the_sum_of_the_links) {
  const ExcavatorGeometry& geometry = machine().geometry();
  const TipPose pose = machine().pose_from_joints(Eigen::Vector3d::Zero());
  assert_near(pose.x_m, geometry.boom_length_m + geometry.arm_length_m + geometry.bucket_length_m,
              1e-12);
  assert_near(pose.y_m, 0.0, 1e-12);
  assert_near(pose.attitude_rad, 3.14159265358979, 1e-12);
}

/// Extension raises the boom, folds the arm in and curls the bucket in.
TEST(signs_of_extension) {
  const Eigen::Vector3d middle(0.5 * stroke_max(0), 0.5 * stroke_max(1), 0.5 * stroke_max(2));
  const Eigen::Vector3d at = machine().joints_from_strokes(middle).joints_rad;
  const Eigen::Vector3d longer =
      machine().joints_from_strokes(middle + Eigen::Vector3d::Constant(0.01)).joints_rad;
  assert_true(longer[kBoom] > at[kBoom]);
  assert_true(longer[kArm] < at[kArm]);
  assert_true(longer[kBucket] < at[kBucket]);
}

/// Bucket linkage at one angle, its four points laid out by hand: the rocker's end has the rocker's
/// distance from its pivot and the coupler's from the lug.
TEST(linkage_closes) {
  const ExcavatorGeometry& geometry = machine().geometry();
  const BucketLinkageSolver solver(geometry.linkage, geometry.cylinder[kBucket].base_m,
                                   geometry.arm_length_m);
  for (double angle = -2.69; angle < 0.52; angle += 0.05) {
    const LinkageState there = solver.from_angle(angle);
    assert_true(there.closed);
    assert_true(there.length_rate < 0.0);
    const LinkageState back = solver.from_length(there.length_m);
    assert_true(back.closed);
    assert_near(back.angle_rad, angle, 1e-9);
  }
  const LinkageState apart = solver.from_length(10.0);
  assert_false(apart.closed);
}

void check_finite(const StrokeResult& result) {
  assert_true(result.strokes_m.allFinite());
  assert_int_not_equal(result.status, ReachStatus::kOk);
}

TEST(unreachable_poses_give_a_status) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  check_finite(machine().strokes_from_pose({15.0, 0.0, 1.5}));
  check_finite(machine().strokes_from_pose({0.0, 0.0, 1.5}));
  check_finite(machine().strokes_from_pose({6.0, -1.0, -1.5}));
  check_finite(machine().strokes_from_pose({nan, 0.0, 1.5}));
  check_finite(machine().strokes_from_pose({6.0, infinity, 1.5}));
  check_finite(machine().strokes_from_pose({6.0, 0.0, nan}));
  check_finite(machine().strokes_from_joints({0.0, -1.0, nan}));
  check_finite(machine().strokes_from_joints({0.0, -1.0, 3.0}));
  assert_int_equal(machine().strokes_from_pose({15.0, 0.0, 1.5}).status, ReachStatus::kOutOfReach);
}

/// Whatever pose is asked for, the answer is finite, and where it is 'ok' it leads back there.
TEST(any_pose_has_an_honest_answer) {
  for (double x = -12.0; x <= 12.0; x += 0.75) {
    for (double y = -10.0; y <= 12.0; y += 0.75) {
      for (double attitude = -3.0; attitude <= 6.0; attitude += 0.5) {
        const StrokeResult strokes = machine().strokes_from_pose({x, y, attitude});
        assert_true(strokes.strokes_m.allFinite());
        if (strokes.status == ReachStatus::kOk) {
          const KinematicState state = machine().state(strokes.strokes_m);
          assert_near(state.tip.x_m, x, 1e-9);
          assert_near(state.tip.y_m, y, 1e-9);
          assert_near(
              std::remainder(state.tip.attitude_rad - attitude, 2.0 * 3.14159265358979323846), 0.0,
              1e-9);
        }
      }
    }
  }
}

TEST(strokes_outside_the_cylinder_are_refused) {
  const Eigen::Vector3d middle(0.5, 0.5, 0.5);
  const ReachStatus which[] = {ReachStatus::kBoomStroke, ReachStatus::kArmStroke,
                               ReachStatus::kBucketStroke};
  for (int axis = 0; axis < kAxisCount; ++axis) {
    Eigen::Vector3d strokes = middle;
    strokes[axis] = -0.001;
    assert_int_equal(machine().state(strokes).status, which[axis]);
    strokes[axis] = stroke_max(static_cast<unsigned>(axis)) + 0.001;
    assert_int_equal(machine().state(strokes).status, which[axis]);
    strokes[axis] = std::numeric_limits<double>::quiet_NaN();
    assert_int_equal(machine().state(strokes).status, ReachStatus::kNotFinite);
  }
}
