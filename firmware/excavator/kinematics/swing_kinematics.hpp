// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator with its swing (Zhang et al., 3.2): teeth in space <-> four joints <-> strokes and
/// swing. The planar chain of ExcavatorKinematics, its origin set off by a_1 and d_0, turned about
/// the vertical. Ground frame: x and y level, z up, origin where the swing axis meets the ground;
/// swing 0 looks along x and turns towards y.
///
/// Formulas of the paper that do not agree with its own figures, and what stands here instead:
///   (4)  theta_3 = t_3 - beta - xi contradicts (3), its own definition of xi; (3) with the sum of
///        the triangle's angles gives theta_3 = t_3 - beta + xi - pi.
///   (5)  tan^-1 of beta has to know the quadrant: the bucket pin can stand behind the boom foot.
///   (6)  at lambda_1 = 2.400 m it gives theta_1 = 71.570 deg, not the printed 68.810 (which would
///        be 2.387 m); at 1.450 m it gives the printed -45.179.

#include <Eigen/Core>
#include <cstdint>

#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/excavator/kinematics/tuning.hpp"

namespace graben {

/// Pose of the bucket's teeth in the ground frame.
struct TeethPose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  /// xi of (3): from the teeth to the bucket pin, against the horizontal that the swing looks
  /// along, = theta_1 + theta_2 + theta_3 + pi.
  double attitude_rad = 0.0;
};

// A DriveVector here holds joint angles in rad, or strokes in m from the closed cylinder and the
// swing in rad, (lambda_1, lambda_2, lambda_3, lambda_0).

/// Why the machine can't be somewhere.
enum class BlindKind : std::uint8_t {
  kNone = 0,
  kOutOfReach = 1,   ///< The bucket pin is farther or nearer than the arm's joint can set it.
  kStrokeEnd = 2,    ///< The cylinder's stroke would be outside its range.
  kDeadCentre = 3,   ///< The joint would be past its cylinder's dead centre.
  kLinkageOpen = 4,  ///< Rocker and coupler of the bucket can't meet.
  kSingular = 5,     ///< A lever vanishes: boom and arm in one line, a cylinder through its joint,
                     ///< or, for the swing, teeth over its axis.
  kNotFinite = 6,
};

/// A place that the plan of a line has to avoid, and whose joint makes it one.
struct BlindSpot {
  BlindKind kind = BlindKind::kNone;
  int drive = kBoom;      ///< Whose.
  double stroke_m = 0.0;  ///< What it would have to be, where the kind is kStrokeEnd.
};

/// Joints, or strokes and swing.
struct DriveResult {
  BlindSpot blind{BlindKind::kNotFinite};
  DriveVector value = DriveVector::Zero();
};

/// Drives at one place of a path, and their first and second derivative by its parameter.
struct DriveMotion {
  BlindSpot blind{BlindKind::kNotFinite};
  DriveVector joints_rad = DriveVector::Zero();
  DriveVector value = DriveVector::Zero();  ///< Strokes and swing.
  DriveVector rate = DriveVector::Zero();
  DriveVector curvature = DriveVector::Zero();
};

/// Closed forms throughout. The elbow is always up (t_2 of (5) with k_2 = -1: theta_2 in -pi .. 0),
/// as the arm cylinder's range has it; the machine always faces its teeth, never bends over
/// backwards across the swing axis.
class SwingKinematics {
 public:
  explicit SwingKinematics(const ExcavatorGeometry& geometry);

  /// (2), (3).
  [[nodiscard]] TeethPose teeth_from_joints(const DriveVector& joints_rad) const;
  /// (4), (5). Swing in (-pi, pi].
  [[nodiscard]] DriveResult joints_from_teeth(const TeethPose& teeth) const;
  /// (6) and its like of arm and bucket; joints outside the strokes' ranges are blind spots.
  [[nodiscard]] DriveResult drive_from_joints(const DriveVector& joints_rad) const;
  [[nodiscard]] DriveResult joints_from_drive(const DriveVector& drive) const;
  [[nodiscard]] DriveResult drive_from_teeth(const TeethPose& teeth) const;

  /// What a path of the teeth asks of the drives: its pose and derivatives there. The swing's value
  /// is the one nearest to `swing_near_rad`, so that a path can cross the back of the machine.
  [[nodiscard]] DriveMotion motion_from_teeth(const TeethPose& teeth, const TeethPose& rate,
                                              const TeethPose& curvature,
                                              double swing_near_rad) const;

  [[nodiscard]] const ExcavatorKinematics& planar() const { return planar_; }
  [[nodiscard]] const ExcavatorGeometry& geometry() const { return planar_.geometry(); }

 private:
  [[nodiscard]] TipPose tip(double radius_m, double height_m, double attitude_rad) const;
  [[nodiscard]] BlindSpot blind_spot(ReachStatus status, const Eigen::Vector3d& strokes_m) const;

  ExcavatorKinematics planar_;
};

}  // namespace graben
