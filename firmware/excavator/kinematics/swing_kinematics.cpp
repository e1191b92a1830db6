// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/kinematics/swing_kinematics.hpp"

#include <cmath>

namespace graben {
namespace {

DriveVector with_swing(const Eigen::Vector3d& planar, double swing) {
  return {planar[kBoom], planar[kArm], planar[kBucket], swing};
}

/// Of the stroke at `axis`: outside its range, or only so because the joint is folded over.
BlindSpot stroke_spot(const ExcavatorGeometry& geometry, int axis,
                      const Eigen::Vector3d& strokes_m) {
  const double stroke_m = strokes_m[axis];
  const double most_m = geometry.cylinder[static_cast<unsigned>(axis)].stroke_m;
  const bool outside = stroke_m < 0.0 || stroke_m > most_m;
  return outside ? BlindSpot{BlindKind::kStrokeEnd, axis, stroke_m}
                 : BlindSpot{BlindKind::kDeadCentre, axis};
}

/// Distance from the swing axis along a path, and the swing, with their derivatives.
struct Polar {
  double radius_m = 0.0;
  double radius_rate = 0.0;
  double radius_curvature = 0.0;
  double swing_rad = 0.0;
  double swing_rate = 0.0;
  double swing_curvature = 0.0;
};

Polar polar(const Eigen::Vector3d& position_m, const Eigen::Vector3d& rate,
            const Eigen::Vector3d& curvature) {
  const Eigen::Vector2d p = position_m.head<2>();
  const Eigen::Vector2d v = rate.head<2>();
  const Eigen::Vector2d a = curvature.head<2>();
  const auto cross = [](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    return from.x() * to.y() - from.y() * to.x();
  };
  Polar result;
  result.radius_m = p.norm();
  result.swing_rad = std::atan2(p.y(), p.x());
  const double square_m2 = p.squaredNorm();
  result.radius_rate = p.dot(v) / result.radius_m;
  result.swing_rate = cross(p, v) / square_m2;
  result.radius_curvature =
      p.dot(a) / result.radius_m + result.radius_m * result.swing_rate * result.swing_rate;
  result.swing_curvature =
      cross(p, a) / square_m2 - 2.0 * result.radius_rate * result.swing_rate / result.radius_m;
  return result;
}

bool finite(const TeethPose& pose) {
  return pose.position_m.allFinite() && std::isfinite(pose.attitude_rad);
}

}  // namespace

SwingKinematics::SwingKinematics(const ExcavatorGeometry& geometry) : planar_(geometry) {}

TipPose SwingKinematics::tip(double radius_m, double height_m, double attitude_rad) const {
  const Eigen::Vector2d& foot_m = geometry().boom_foot_m;
  return {radius_m - foot_m.x(), height_m - foot_m.y(), attitude_rad};
}

BlindSpot SwingKinematics::blind_spot(ReachStatus status, const Eigen::Vector3d& strokes_m) const {
  switch (status) {
    case ReachStatus::kOk:
      return {};
    case ReachStatus::kOutOfReach:
      return {BlindKind::kOutOfReach, kArm};
    case ReachStatus::kBoomStroke:
      return stroke_spot(geometry(), kBoom, strokes_m);
    case ReachStatus::kArmStroke:
      return stroke_spot(geometry(), kArm, strokes_m);
    case ReachStatus::kBucketStroke:
      return stroke_spot(geometry(), kBucket, strokes_m);
    case ReachStatus::kLinkageOpen:
      return {BlindKind::kLinkageOpen, kBucket};
    case ReachStatus::kSingular:
      return {BlindKind::kSingular, kArm};
    case ReachStatus::kNotFinite:
      break;
  }
  return {BlindKind::kNotFinite};
}

TeethPose SwingKinematics::teeth_from_joints(const DriveVector& joints_rad) const {
  const TipPose tip = planar_.pose_from_joints(joints_rad.head<3>());
  const Eigen::Vector2d& foot_m = geometry().boom_foot_m;
  const double radius_m = foot_m.x() + tip.x_m;
  const double swing_rad = joints_rad[kSwing];
  return {{radius_m * std::cos(swing_rad), radius_m * std::sin(swing_rad), foot_m.y() + tip.y_m},
          tip.attitude_rad};
}

DriveResult SwingKinematics::joints_from_teeth(const TeethPose& teeth) const {
  if (!finite(teeth)) {
    return {};
  }
  const Eigen::Vector2d level_m = teeth.position_m.head<2>();
  const double radius_m = level_m.norm();
  if (radius_m < kLeastSwingRadius_m) {
    return {{BlindKind::kSingular, kSwing}};
  }
  const JointResult joints =
      planar_.joints_from_pose(tip(radius_m, teeth.position_m.z(), teeth.attitude_rad));
  return {blind_spot(joints.status, Eigen::Vector3d::Zero()),
          with_swing(joints.joints_rad, std::atan2(level_m.y(), level_m.x()))};
}

DriveResult SwingKinematics::drive_from_joints(const DriveVector& joints_rad) const {
  if (!joints_rad.allFinite()) {
    return {};
  }
  const StrokeResult strokes = planar_.strokes_from_joints(joints_rad.head<3>());
  return {blind_spot(strokes.status, strokes.strokes_m),
          with_swing(strokes.strokes_m, joints_rad[kSwing])};
}

DriveResult SwingKinematics::joints_from_drive(const DriveVector& drive) const {
  if (!drive.allFinite()) {
    return {};
  }
  const JointResult joints = planar_.joints_from_strokes(drive.head<3>());
  return {blind_spot(joints.status, drive.head<3>()), with_swing(joints.joints_rad, drive[kSwing])};
}

DriveResult SwingKinematics::drive_from_teeth(const TeethPose& teeth) const {
  const DriveResult joints = joints_from_teeth(teeth);
  return joints.blind.kind == BlindKind::kNone ? drive_from_joints(joints.value) : joints;
}

DriveMotion SwingKinematics::motion_from_teeth(const TeethPose& teeth, const TeethPose& rate,
                                               const TeethPose& curvature,
                                               double swing_near_rad) const {
  DriveMotion motion;
  if (!finite(teeth) || !finite(rate) || !finite(curvature)) {
    return motion;
  }
  if (teeth.position_m.head<2>().norm() < kLeastSwingRadius_m) {
    motion.blind = {BlindKind::kSingular, kSwing};
    return motion;
  }
  const Polar at = polar(teeth.position_m, rate.position_m, curvature.position_m);
  const PathMotion planar = planar_.motion_from_pose(
      tip(at.radius_m, teeth.position_m.z(), teeth.attitude_rad),
      {at.radius_rate, rate.position_m.z(), rate.attitude_rad},
      {at.radius_curvature, curvature.position_m.z(), curvature.attitude_rad});
  motion.blind = blind_spot(planar.status, planar.strokes_m);
  if (planar.status == ReachStatus::kSingular) {
    motion.blind.drive = planar.axis;
  }
  const double swing_rad = wrap_near(at.swing_rad, swing_near_rad);
  motion.joints_rad = with_swing(planar.joints_rad, swing_rad);
  motion.value = with_swing(planar.strokes_m, swing_rad);
  motion.rate = with_swing(planar.strokes_rate, at.swing_rate);
  motion.curvature = with_swing(planar.strokes_curvature, at.swing_curvature);
  return motion;
}

}  // namespace graben
