// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The blade's tilt: cylinder, angle, and the slope of the cutting edge across the track.

#include "firmware/dozer/grade_profile.hpp"
#include "firmware/dozer/mobile_jacobian.hpp"

namespace graben {

/// The angle is 0 with the blade level in the machine, and positive with its left end up. The
/// stroke counts from the end of the range where the cylinder is shortest.
class TiltKinematics {
 public:
  /// Of a machine without tilt it stays at 0.
  explicit TiltKinematics(const TiltProfile& tilt);

  /// What is out of the range is taken for its end.
  [[nodiscard]] double angle_rad(double stroke_m) const;
  [[nodiscard]] double stroke_m(double angle_rad) const;
  /// d stroke / d angle, m/rad; its sign says which way extension turns the blade.
  [[nodiscard]] double stroke_rate_mprad(double angle_rad) const;

  [[nodiscard]] double stroke_max_m() const { return stroke_max_m_; }

 private:
  [[nodiscard]] double length_m(double angle_rad) const;

  double angle_most_rad_;
  double base_radius_m_;
  double eye_radius_m_;
  double enclosed_rad_ = 0.0;  ///< From base to eye about the axis, level.
  double shortest_m_ = 0.0;
  double stroke_max_m_ = 0.0;
};

/// R_V of a body that is pitched (nose up) and rolled (left side up) but not turned: it rolls about
/// its own longitudinal axis.
[[nodiscard]] Eigen::Matrix3d rotation_from_pitch_and_roll(double pitch_rad, double roll_rad);

/// Slope of the cutting edge's line across the track, dz/dy in the world, and how it answers.
struct EdgeSlope {
  double slope = 0.0;
  double per_tilt = 1.0;  ///< d slope / d tilt angle.
  double per_roll = 1.0;  ///< d slope / d roll of the body.
};
[[nodiscard]] EdgeSlope edge_slope(const Eigen::Matrix3d& body_rotation, double blade_angle_rad,
                                   double tilt_rad);

/// Slope of the design along an edge at `x_m` that lies askew to the track: turned to the left by
/// so much, its left end lies back and its right end ahead. Straight across, the cross slope.
[[nodiscard]] CrossSample slope_along_edge(const GradeProfile& design, double x_m,
                                           double askew_rad);

/// Oil that the tilt takes in per metre of way, m^3/m = m^2, with the body's origin at `x_m` on the
/// design as already cut: the edge follows the cross slope ahead, the body that below its tracks.
[[nodiscard]] double tilt_oil_m2(const DozerProfile& profile, const TiltKinematics& tilt,
                                 const GradeProfile& design, double x_m, double reach_m);

/// Tilt angle that the design asks for there.
[[nodiscard]] double tilt_on_rad(const DozerBody& body, const GradeProfile& design, double x_m,
                                 double reach_m);

}  // namespace graben
