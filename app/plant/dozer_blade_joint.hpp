// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer's blade on joint 1: its linkage, weight and inertia.

#include <Eigen/Core>

#include "app/plant/cylinder.hpp"
#include "app/plant/dozer_plant_profile.hpp"

namespace graben::plant {

/// Triangle of pivot, cylinder base and rod eye; the rod eye lies on the line from the pivot to the
/// blade's foot. The angle counts from home, where the cutting edge is at the ground line, blade up
/// positive. Body frame.
class BladeLinkage {
 public:
  explicit BladeLinkage(const BladeGeometry& blade);

  [[nodiscard]] double length_m(double angle_rad) const;
  /// d length / d angle: negative, as the shortest cylinder has the blade up.
  [[nodiscard]] double length_per_angle_m(double angle_rad) const;
  [[nodiscard]] Eigen::Vector2d edge_m(double angle_rad) const;
  /// Angle from the body's x axis to the line from pivot to foot.
  [[nodiscard]] double arm_angle_rad(double angle_rad) const { return arm_home_ + angle_rad; }

  [[nodiscard]] double lowest_rad() const { return lowest_; }
  [[nodiscard]] double highest_rad() const { return highest_; }
  [[nodiscard]] double stroke_m(double angle_rad) const { return length_m(angle_rad) - shortest_; }
  [[nodiscard]] double full_stroke_m() const { return stroke_m(lowest_); }

 private:
  Eigen::Vector2d pivot_;
  double edge_reach_;
  double edge_home_;   ///< Angle from the body's x axis to the line from pivot to edge, at home.
  double arm_home_;    ///< The same to the foot.
  double base_angle_;  ///< The same to the cylinder's base.
  double l11_;         ///< Pivot to base.
  double l12_;         ///< Pivot to rod eye.
  double lowest_;
  double highest_;
  double shortest_;  ///< Length with the blade fully raised.
};

/// The blade as a mass point on the arm, moved by the cylinders. The body's pitch turns gravity;
/// what its acceleration does to the blade is left out: over a ledge about a tenth of the weight.
class BladeJoint {
 public:
  explicit BladeJoint(const DozerPlantProfile& profile);

  /// Cylinder force that holds the blade at rest, N, extension positive.
  [[nodiscard]] double holding_force_n(double body_pitch_rad) const;
  /// Returns the cylinders' mean velocity over the step, m/s.
  /// `moment_nm` is what acts on the blade beside its weight; raising it is positive.
  double accelerate(const PistonLoad& load, double body_pitch_rad, double step_s,
                    double moment_nm = 0.0);
  void move(double step_s);

  [[nodiscard]] const BladeLinkage& linkage() const { return linkage_; }
  [[nodiscard]] double angle_rad() const { return angle_; }
  [[nodiscard]] double stroke_m() const { return linkage_.stroke_m(angle_); }
  [[nodiscard]] double velocity_mps() const { return lever_ * rate_; }

 private:
  [[nodiscard]] double gravity_moment_nm(double body_pitch_rad) const;

  BladeLinkage linkage_;
  double weight_moment_;
  double inertia_;
  double angle_ = 0.0;
  double rate_ = 0.0;
  double lever_;  ///< d stroke / d angle here.
};

}  // namespace graben::plant
