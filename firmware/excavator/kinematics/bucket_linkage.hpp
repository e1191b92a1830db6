// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The bucket's four-bar linkage: cylinder length <-> rocker <-> bucket angle.

#include <Eigen/Core>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben {

/// Bucket angle and its slope at a cylinder length.
struct LinkageState {
  bool closed = false;       ///< False: rocker and coupler can't meet there; nothing else is set.
  double angle_rad = 0.0;    ///< Bucket against arm.
  double length_m = 0.0;     ///< Cylinder, pin to pin.
  double length_rate = 0.0;  ///< d length / d angle, m/rad; negative: extension curls in.
  double length_curvature = 0.0;  ///< d^2 length / d angle^2, m/rad^2.
  double per_rocker = 0.0;        ///< d angle / d rocker's angle.
};

/// Rocker on the arm at `rocker_pivot`, its end joined by the coupler to the bucket's lug and
/// pushed by the cylinder from `base` (all arm frame, bucket pin at (arm_length, 0)). Of the two
/// ways that rocker and coupler can close, the one with the rocker's end to the left of the line
/// from pivot to lug: there extension curls in over the whole stroke.
class BucketLinkageSolver {
 public:
  BucketLinkageSolver(const BucketLinkage& linkage, const Eigen::Vector2d& cylinder_base_m,
                      double arm_length_m);

  [[nodiscard]] LinkageState from_angle(double angle_rad) const;
  /// Closed form: the rocker's angle from the cylinder's triangle, then the lug's from the
  /// coupler's.
  [[nodiscard]] LinkageState from_length(double length_m) const;
  /// At an angle of the rocker against the arm: of pivot to end against x.
  [[nodiscard]] LinkageState from_rocker(double rocker_rad) const;

 private:
  [[nodiscard]] LinkageState with_end(const Eigen::Vector2d& rocker_end_m) const;
  [[nodiscard]] LinkageState with_rocker_end(const Eigen::Vector2d& rocker_end_m,
                                             const Eigen::Vector2d& lug_m, double angle_rad) const;

  BucketLinkage linkage_;
  Eigen::Vector2d base_m_;
  Eigen::Vector2d pin_m_;
};

}  // namespace graben
