// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A joint driven by a cylinder: a triangle of two fixed sides and the cylinder's length.

#include <Eigen/Core>

namespace graben {

/// Pins A and B about a joint at the origin. A stays in the parent's frame, B turns with the child.
/// `angle` is the child's frame against the parent's.
class CylinderTriangle {
 public:
  /// `side` is +1 if B stands counter-clockwise from A as seen from the joint over the whole
  /// range, -1 if clockwise: the one choice that the cylinder's length leaves open.
  CylinderTriangle(const Eigen::Vector2d& parent_pin_m, const Eigen::Vector2d& child_pin_m,
                   int side);

  /// Whether the pins stand on their side of each other at this angle. Where they don't, the same
  /// length belongs to another angle.
  [[nodiscard]] bool on_side(double angle_rad) const;
  /// Pin-to-pin length, m.
  [[nodiscard]] double length(double angle_rad) const;
  /// d length / d angle, m/rad; negative where turning the child shortens the cylinder.
  [[nodiscard]] double length_rate(double angle_rad) const;
  /// d^2 length / d angle^2, m/rad^2.
  [[nodiscard]] double length_curvature(double angle_rad) const;

  /// Angle at a length. A length that the triangle can't have gives the nearest one it can.
  [[nodiscard]] double angle(double length_m) const;

 private:
  double a_m_;
  double b_m_;
  double offset_rad_;  ///< Angle from A to B at joint angle 0.
  int side_;
};

/// Equivalent of `angle_rad` in (centre - pi, centre + pi].
[[nodiscard]] double wrap_near(double angle_rad, double centre_rad);

}  // namespace graben
