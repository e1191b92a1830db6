// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/tilt.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/travel/body_motion.hpp"
#include "firmware/dozer/tuning.hpp"

namespace graben {
namespace {

double direction_rad(const Eigen::Vector2d& vector) { return std::atan2(vector.y(), vector.x()); }

/// Of a turn from one pin to the other, within half a circle.
double within_half_turn(double angle_rad) {
  return std::atan2(std::sin(angle_rad), std::cos(angle_rad));
}

/// How the slope of `direction` changes as it turns with `rate`.
double slope_rate(const Eigen::Vector3d& direction, const Eigen::Vector3d& rate) {
  const double across = std::max(direction.y(), kEdgeLeastAcross);
  return (rate.z() * across - direction.z() * rate.y()) / (across * across);
}

}  // namespace

TiltKinematics::TiltKinematics(const TiltProfile& tilt)
    : angle_most_rad_(tilt.angle_most_rad),
      base_radius_m_(tilt.base_m.norm()),
      eye_radius_m_(tilt.eye_m.norm()) {
  if (tilt.present) {
    enclosed_rad_ = within_half_turn(direction_rad(tilt.eye_m) - direction_rad(tilt.base_m));
    const double right_m = length_m(-angle_most_rad_);
    const double left_m = length_m(angle_most_rad_);
    shortest_m_ = std::min(right_m, left_m);
    stroke_max_m_ = std::abs(left_m - right_m);
  }
}

double TiltKinematics::length_m(double angle_rad) const {
  return std::sqrt(base_radius_m_ * base_radius_m_ + eye_radius_m_ * eye_radius_m_ -
                   2.0 * base_radius_m_ * eye_radius_m_ * std::cos(enclosed_rad_ + angle_rad));
}

double TiltKinematics::angle_rad(double stroke_m) const {
  const double length_m = shortest_m_ + std::clamp(stroke_m, 0.0, stroke_max_m_);
  const double cosine =
      (base_radius_m_ * base_radius_m_ + eye_radius_m_ * eye_radius_m_ - length_m * length_m) /
      (2.0 * base_radius_m_ * eye_radius_m_);
  return std::copysign(std::acos(std::clamp(cosine, -1.0, 1.0)), enclosed_rad_) - enclosed_rad_;
}

double TiltKinematics::stroke_m(double angle_rad) const {
  return length_m(std::clamp(angle_rad, -angle_most_rad_, angle_most_rad_)) - shortest_m_;
}

double TiltKinematics::stroke_rate_mprad(double angle_rad) const {
  const double angle = std::clamp(angle_rad, -angle_most_rad_, angle_most_rad_);
  return base_radius_m_ * eye_radius_m_ * std::sin(enclosed_rad_ + angle) / length_m(angle);
}

Eigen::Matrix3d rotation_from_pitch_and_roll(double pitch_rad, double roll_rad) {
  const double c = std::cos(roll_rad);
  const double s = std::sin(roll_rad);
  Eigen::Matrix3d roll;
  roll << 1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c;
  return rotation_from_pitch(pitch_rad) * roll;
}

EdgeSlope edge_slope(const Eigen::Matrix3d& body_rotation, double blade_angle_rad,
                     double tilt_rad) {
  const double c = std::cos(tilt_rad);
  const double s = std::sin(tilt_rad);
  // theta_1 turns the blade as pitch does the body.
  const Eigen::Matrix3d blade = rotation_from_pitch(blade_angle_rad);
  const Eigen::Vector3d in_body = blade * Eigen::Vector3d(0.0, c, s);
  const Eigen::Vector3d direction = body_rotation * in_body;
  const Eigen::Vector3d tilted = body_rotation * (blade * Eigen::Vector3d(0.0, -s, c));
  const Eigen::Vector3d rolled = body_rotation * Eigen::Vector3d(0.0, -in_body.z(), in_body.y());
  return {direction.z() / std::max(direction.y(), kEdgeLeastAcross), slope_rate(direction, tilted),
          slope_rate(direction, rolled)};
}

CrossSample slope_along_edge(const GradeProfile& design, double x_m, double askew_rad) {
  const CrossSample across = design.cross_at(x_m);
  if (!design.curves()) {
    return across;
  }
  /// Step of the design's bend. [m; derived: that of its heights]
  constexpr double kStep_m = GradeHeights::kStep_m;
  const double s = std::sin(askew_rad);
  const double c = std::cos(askew_rad);
  const double bend_pm =
      (design.at(x_m + kStep_m).slope - design.at(x_m - kStep_m).slope) / (2.0 * kStep_m);
  return {c * across.slope - s * design.at(x_m).slope, c * across.change_pm - s * bend_pm};
}

namespace {

/// With the machine on the track: it has turned back by what the track bends up to the edge.
CrossSample slope_ahead(const GradeProfile& design, double x_m, double reach_m) {
  return slope_along_edge(design, x_m + reach_m,
                          -reach_m * design.curvature_at(x_m + 0.5 * reach_m));
}

}  // namespace

double tilt_on_rad(const DozerBody& body, const GradeProfile& design, double x_m, double reach_m) {
  return std::atan2(slope_ahead(design, x_m, reach_m).slope, 1.0) -
         std::atan2(cross_below_tracks(body, design, x_m).slope, 1.0);
}

double tilt_oil_m2(const DozerProfile& profile, const TiltKinematics& tilt,
                   const GradeProfile& design, double x_m, double reach_m) {
  const double change_pm = slope_ahead(design, x_m, reach_m).change_pm -
                           cross_below_tracks(profile.body, design, x_m).change_pm;
  const double angle_rad = tilt_on_rad(profile.body, design, x_m, reach_m);
  const double way = tilt.stroke_rate_mprad(angle_rad) * change_pm;
  return way >= 0.0 ? profile.tilt.cap_area_m2() * way : -profile.tilt.rod_area_m2() * way;
}

}  // namespace graben
