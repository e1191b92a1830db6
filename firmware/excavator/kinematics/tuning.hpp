// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about the kinematics: each was chosen.

namespace graben {

// Turns in which angles are taken (bucket_linkage.cpp, excavator_kinematics.cpp, imu_joints.cpp)

/// Middle of the turn in which the arm's angle is taken: it folds in. [rad; chosen: a quarter turn,
/// the ranges of both shipped arms are about it; not tried]
inline constexpr double kArmCentre_rad = -1.57;
/// Middle of the turn in which the bucket's angle is taken: it is mostly folded in. [rad; chosen:
/// the ranges of both shipped buckets are about it; not tried]
inline constexpr double kBucketCentre_rad = -1.1;

// Strokes, joints and teeth (excavator_kinematics.cpp)

/// A stroke may pass its range by this much: the pose may be made from a stroke at its end. [m;
/// chosen: above rounding, far below what a sensor resolves; not tried]
inline constexpr double kPoseStrokeTolerance_m = 1e-6;
/// Difference of two angles of the bucket, there and back through its linkage, that is rounding;
/// beyond it the linkage has closed the other way. [rad; chosen: not tried]
inline constexpr double kLinkageSameAngle_rad = 1e-6;
/// Lever of a cylinder below which its joint counts as singular. [m; chosen: levers of a machine
/// are decimetres; not tried]
inline constexpr double kSmallestLever_m = 1e-3;
/// Determinant of the joints' Jacobian, boom length * arm length * sin(arm angle), below which boom
/// and arm count as in line. [m2; chosen: not tried]
inline constexpr double kSmallestDeterminant_m2 = 1e-3;

// The swing (swing_kinematics.cpp)

/// Radius of the teeth about the swing axis below which no swing can follow them: the machine
/// stands there. [m; chosen: 0.05 was tried]
inline constexpr double kLeastSwingRadius_m = 0.3;

}  // namespace graben
