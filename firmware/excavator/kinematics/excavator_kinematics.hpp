// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Strokes <-> joints <-> tip pose of an excavator in the sagittal plane, and the Jacobian (2).
/// x forward, y up, origin at the boom foot pin. Strokes count from the closed cylinder.

#include <Eigen/Core>
#include <cstdint>

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/kinematics/bucket_linkage.hpp"
#include "firmware/numeric/triangle.hpp"

namespace graben {

/// Pose of the bucket: tip position and attitude phi_b, the direction from the tip to the bucket
/// pin, = boom + arm + bucket + pi.
struct TipPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double attitude_rad = 0.0;
};

/// Reachability of a pose or a set of strokes, and the obstacle.
enum class ReachStatus : std::uint8_t {
  kOk = 0,
  kOutOfReach = 1,  ///< The bucket pin is farther or nearer than boom and arm can set it.
  kBoomStroke = 2,  ///< The cylinder's stroke would be outside its range.
  kArmStroke = 3,
  kBucketStroke = 4,
  kLinkageOpen = 5,  ///< Rocker and coupler of the bucket can't meet there.
  kSingular = 6,     ///< A lever vanishes: the Jacobian has no inverse.
  kNotFinite = 7,
};

struct JointResult {
  ReachStatus status = ReachStatus::kNotFinite;
  Eigen::Vector3d joints_rad = Eigen::Vector3d::Zero();
};

struct StrokeResult {
  ReachStatus status = ReachStatus::kNotFinite;
  Eigen::Vector3d strokes_m = Eigen::Vector3d::Zero();
};

/// Everything that a cycle needs of where the machine stands.
struct KinematicState {
  ReachStatus status = ReachStatus::kNotFinite;
  Eigen::Vector3d strokes_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d joints_rad = Eigen::Vector3d::Zero();
  TipPose tip;
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();          ///< v_b = J V_L of (2).
  Eigen::Matrix3d jacobian_inverse = Eigen::Matrix3d::Zero();  ///< V_L = J^-1 v_b of (3).
};

/// Where tip, joints and cylinders are at one place of a path, and how they go on from there: first
/// and second derivatives by whatever parameter the path has.
struct PathMotion {
  ReachStatus status = ReachStatus::kNotFinite;
  int axis = 0;  ///< Whose lever or reach it is, where the status is kSingular.
  Eigen::Vector3d joints_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d joints_rate = Eigen::Vector3d::Zero();
  Eigen::Vector3d joints_curvature = Eigen::Vector3d::Zero();
  /// Set where the joints are had, even if they are outside their range.
  Eigen::Vector3d strokes_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d strokes_rate = Eigen::Vector3d::Zero();
  Eigen::Vector3d strokes_curvature = Eigen::Vector3d::Zero();
};

/// Closed forms throughout; every function costs a constant number of operations and returns a
/// status instead of a number that isn't one.
class ExcavatorKinematics {
 public:
  explicit ExcavatorKinematics(const ExcavatorGeometry& geometry);

  /// Joints at these strokes; refuses strokes outside the cylinders' ranges by more than 1 um.
  [[nodiscard]] JointResult joints_from_strokes(const Eigen::Vector3d& strokes_m) const;
  [[nodiscard]] StrokeResult strokes_from_joints(const Eigen::Vector3d& joints_rad) const;
  [[nodiscard]] TipPose pose_from_joints(const Eigen::Vector3d& joints_rad) const;
  /// Elbow up: the arm folds in (its angle is negative), as its cylinder's range has it.
  [[nodiscard]] JointResult joints_from_pose(const TipPose& pose) const;
  [[nodiscard]] StrokeResult strokes_from_pose(const TipPose& pose) const;
  /// What a path of the tip asks of joints and cylinders, by the inverse of the Jacobian: `pose`,
  /// and the path's first and second derivative there.
  [[nodiscard]] PathMotion motion_from_pose(const TipPose& pose, const TipPose& rate,
                                            const TipPose& curvature) const;
  /// Pose, Jacobian and inverse at these strokes.
  [[nodiscard]] KinematicState state(const Eigen::Vector3d& strokes_m) const;

  [[nodiscard]] const ExcavatorGeometry& geometry() const { return geometry_; }

 private:
  [[nodiscard]] ReachStatus check_strokes(const Eigen::Vector3d& strokes_m) const;
  /// Of x, y and attitude by the joints.
  [[nodiscard]] Eigen::Matrix3d joint_jacobian(const Eigen::Vector3d& joints_rad) const;

  ExcavatorGeometry geometry_;
  CylinderTriangle boom_;
  CylinderTriangle arm_;
  BucketLinkageSolver bucket_;
};

}  // namespace graben
