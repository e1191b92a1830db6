// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "firmware/excavator/kinematics/tuning.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

/// Sum of the first n joint angles gives the direction of link n.
Eigen::Vector2d link(double length_m, double direction_rad) {
  return {length_m * std::cos(direction_rad), length_m * std::sin(direction_rad)};
}

}  // namespace

ExcavatorKinematics::ExcavatorKinematics(const ExcavatorGeometry& geometry)
    : geometry_(geometry),
      boom_(geometry.cylinder[kBoom].base_m, geometry.cylinder[kBoom].eye_m, 1),
      // The arm joint stands at the boom's tip: its cylinder's base as seen from there.
      arm_(geometry.cylinder[kArm].base_m - Eigen::Vector2d(geometry.boom_length_m, 0.0),
           geometry.cylinder[kArm].eye_m, -1),
      bucket_(geometry.linkage, geometry.cylinder[kBucket].base_m, geometry.arm_length_m) {}

ReachStatus ExcavatorKinematics::check_strokes(const Eigen::Vector3d& strokes_m) const {
  constexpr std::array<ReachStatus, kAxisCount> kWhich = {
      ReachStatus::kBoomStroke, ReachStatus::kArmStroke, ReachStatus::kBucketStroke};
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const double stroke = strokes_m[axis];
    if (!std::isfinite(stroke)) {
      return ReachStatus::kNotFinite;
    }
    const auto i = static_cast<unsigned>(axis);
    if (stroke < -kPoseStrokeTolerance_m ||
        stroke > geometry_.cylinder[i].stroke_m + kPoseStrokeTolerance_m) {
      return kWhich[i];
    }
  }
  return ReachStatus::kOk;
}

JointResult ExcavatorKinematics::joints_from_strokes(const Eigen::Vector3d& strokes_m) const {
  const ReachStatus reach = check_strokes(strokes_m);
  if (reach != ReachStatus::kOk) {
    return {reach, Eigen::Vector3d::Zero()};
  }
  const auto length = [&](int axis) {
    return geometry_.cylinder[static_cast<unsigned>(axis)].closed_length_m + strokes_m[axis];
  };
  const LinkageState bucket = bucket_.from_length(length(kBucket));
  if (!bucket.closed) {
    return {ReachStatus::kLinkageOpen, Eigen::Vector3d::Zero()};
  }
  return {ReachStatus::kOk,
          {boom_.angle(length(kBoom)), arm_.angle(length(kArm)), bucket.angle_rad}};
}

StrokeResult ExcavatorKinematics::strokes_from_joints(const Eigen::Vector3d& joints_rad) const {
  if (!joints_rad.allFinite()) {
    return {};
  }
  // A joint turned past its cylinder's dead centre has the length of another angle.
  if (!boom_.on_side(joints_rad[kBoom])) {
    return {ReachStatus::kBoomStroke, Eigen::Vector3d::Zero()};
  }
  if (!arm_.on_side(joints_rad[kArm])) {
    return {ReachStatus::kArmStroke, Eigen::Vector3d::Zero()};
  }
  const LinkageState bucket = bucket_.from_angle(joints_rad[kBucket]);
  const LinkageState same = bucket_.from_length(bucket.length_m);
  if (!bucket.closed || !same.closed ||
      std::abs(same.angle_rad - bucket.angle_rad) > kLinkageSameAngle_rad) {
    return {ReachStatus::kLinkageOpen, Eigen::Vector3d::Zero()};
  }
  const Eigen::Vector3d strokes(
      boom_.length(joints_rad[kBoom]) - geometry_.cylinder[kBoom].closed_length_m,
      arm_.length(joints_rad[kArm]) - geometry_.cylinder[kArm].closed_length_m,
      bucket.length_m - geometry_.cylinder[kBucket].closed_length_m);
  return {check_strokes(strokes), strokes};
}

TipPose ExcavatorKinematics::pose_from_joints(const Eigen::Vector3d& joints_rad) const {
  const double boom = joints_rad[kBoom];
  const double arm = boom + joints_rad[kArm];
  const double bucket = arm + joints_rad[kBucket];
  const Eigen::Vector2d tip = link(geometry_.boom_length_m, boom) +
                              link(geometry_.arm_length_m, arm) +
                              link(geometry_.bucket_length_m, bucket);
  return {tip.x(), tip.y(), bucket + kPi};
}

JointResult ExcavatorKinematics::joints_from_pose(const TipPose& pose) const {
  if (!std::isfinite(pose.x_m) || !std::isfinite(pose.y_m) || !std::isfinite(pose.attitude_rad)) {
    return {};
  }
  const double boom_m = geometry_.boom_length_m;
  const double arm_m = geometry_.arm_length_m;
  const Eigen::Vector2d pin =
      Eigen::Vector2d(pose.x_m, pose.y_m) + link(geometry_.bucket_length_m, pose.attitude_rad);
  const double cosine =
      (pin.squaredNorm() - boom_m * boom_m - arm_m * arm_m) / (2.0 * boom_m * arm_m);
  if (!(cosine >= -1.0 && cosine <= 1.0)) {
    return {ReachStatus::kOutOfReach, Eigen::Vector3d::Zero()};
  }
  const double arm = -std::acos(cosine);
  const double boom =
      wrap_near(std::atan2(pin.y(), pin.x()) -
                    std::atan2(arm_m * std::sin(arm), boom_m + arm_m * std::cos(arm)),
                0.0);
  const double bucket = wrap_near(pose.attitude_rad - kPi - boom - arm, kBucketCentre_rad);
  return {ReachStatus::kOk, {boom, arm, bucket}};
}

StrokeResult ExcavatorKinematics::strokes_from_pose(const TipPose& pose) const {
  const JointResult joints = joints_from_pose(pose);
  if (joints.status != ReachStatus::kOk) {
    return {joints.status, Eigen::Vector3d::Zero()};
  }
  return strokes_from_joints(joints.joints_rad);
}

Eigen::Matrix3d ExcavatorKinematics::joint_jacobian(const Eigen::Vector3d& joints_rad) const {
  const double boom = joints_rad[kBoom];
  const double arm = boom + joints_rad[kArm];
  const double bucket = arm + joints_rad[kBucket];
  const Eigen::Vector2d bucket_part = link(geometry_.bucket_length_m, bucket);
  const Eigen::Vector2d arm_part = link(geometry_.arm_length_m, arm) + bucket_part;
  const Eigen::Vector2d boom_part = link(geometry_.boom_length_m, boom) + arm_part;
  Eigen::Matrix3d by_joint;
  by_joint << -boom_part.y(), -arm_part.y(), -bucket_part.y(),  //
      boom_part.x(), arm_part.x(), bucket_part.x(),             //
      1.0, 1.0, 1.0;
  return by_joint;
}

PathMotion ExcavatorKinematics::motion_from_pose(const TipPose& pose, const TipPose& rate,
                                                 const TipPose& curvature) const {
  PathMotion motion;
  const JointResult joints = joints_from_pose(pose);
  motion.status = joints.status;
  if (joints.status != ReachStatus::kOk) {
    return motion;
  }
  const Eigen::Vector3d& at = joints.joints_rad;
  const StrokeResult strokes = strokes_from_joints(at);
  motion.status = strokes.status;
  motion.joints_rad = at;
  motion.strokes_m = strokes.strokes_m;
  if (strokes.status != ReachStatus::kOk) {
    return motion;
  }
  const LinkageState linkage = bucket_.from_angle(at[kBucket]);
  const Eigen::Vector3d levers(boom_.length_rate(at[kBoom]), arm_.length_rate(at[kArm]),
                               linkage.length_rate);
  const Eigen::Matrix3d by_joint = joint_jacobian(at);
  bool invertible = false;
  Eigen::Matrix3d inverse;
  by_joint.computeInverseWithCheck(inverse, invertible, kSmallestDeterminant_m2);
  if (!invertible || levers.cwiseAbs().minCoeff(&motion.axis) < kSmallestLever_m) {
    motion.status = ReachStatus::kSingular;
    // Boom and arm in one line: no joint but the arm's brings them out of it.
    motion.axis = invertible ? motion.axis : kArm;
    return motion;
  }
  motion.joints_rate = inverse * Eigen::Vector3d(rate.x_m, rate.y_m, rate.attitude_rad);
  // Each link's end turns about its pin, with the square of its rate towards it.
  Eigen::Vector3d asked(curvature.x_m, curvature.y_m, curvature.attitude_rad);
  const Eigen::Vector3d length_m(geometry_.boom_length_m, geometry_.arm_length_m,
                                 geometry_.bucket_length_m);
  double direction = 0.0;
  double turning = 0.0;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    direction += at[axis];
    turning += motion.joints_rate[axis];
    asked.head<2>() += turning * turning * link(length_m[axis], direction);
  }
  motion.joints_curvature = inverse * asked;
  const Eigen::Vector3d bend(boom_.length_curvature(at[kBoom]), arm_.length_curvature(at[kArm]),
                             linkage.length_curvature);
  motion.strokes_rate = levers.cwiseProduct(motion.joints_rate);
  motion.strokes_curvature = levers.cwiseProduct(motion.joints_curvature) +
                             bend.cwiseProduct(motion.joints_rate.cwiseAbs2());
  return motion;
}

KinematicState ExcavatorKinematics::state(const Eigen::Vector3d& strokes_m) const {
  KinematicState result;
  const JointResult joints = joints_from_strokes(strokes_m);
  result.status = joints.status;
  if (joints.status != ReachStatus::kOk) {
    return result;
  }
  result.strokes_m = strokes_m;
  result.joints_rad = joints.joints_rad;
  result.tip = pose_from_joints(joints.joints_rad);

  const Eigen::Matrix3d by_joint = joint_jacobian(joints.joints_rad);
  const LinkageState linkage = bucket_.from_angle(joints.joints_rad[kBucket]);
  const Eigen::Vector3d levers(boom_.length_rate(joints.joints_rad[kBoom]),
                               arm_.length_rate(joints.joints_rad[kArm]), linkage.length_rate);
  if (!linkage.closed || levers.cwiseAbs().minCoeff() < kSmallestLever_m) {
    result.status = ReachStatus::kSingular;
    return result;
  }
  result.jacobian = by_joint * levers.cwiseInverse().asDiagonal();
  bool invertible = false;
  Eigen::Matrix3d joint_inverse;
  by_joint.computeInverseWithCheck(joint_inverse, invertible, kSmallestDeterminant_m2);
  if (!invertible) {
    result.status = ReachStatus::kSingular;
    return result;
  }
  result.jacobian_inverse = levers.asDiagonal() * joint_inverse;
  return result;
}

}  // namespace graben
