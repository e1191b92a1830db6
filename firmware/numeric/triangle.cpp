// SPDX-License-Identifier: Apache-2.0
#include "firmware/numeric/triangle.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

double direction(const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); }
}  // namespace

double wrap_near(double angle_rad, double centre_rad) {
  return angle_rad - kTwoPi * std::floor((angle_rad - centre_rad + kPi) / kTwoPi);
}

CylinderTriangle::CylinderTriangle(const Eigen::Vector2d& parent_pin_m,
                                   const Eigen::Vector2d& child_pin_m, int side)
    : a_m_(parent_pin_m.norm()),
      b_m_(child_pin_m.norm()),
      offset_rad_(direction(child_pin_m) - direction(parent_pin_m)),
      side_(side) {}

bool CylinderTriangle::on_side(double angle_rad) const {
  return side_ * wrap_near(offset_rad_ + angle_rad, 0.0) >= 0.0;
}

double CylinderTriangle::length(double angle_rad) const {
  const double opening = offset_rad_ + angle_rad;
  return std::sqrt(
      std::max(0.0, a_m_ * a_m_ + b_m_ * b_m_ - 2.0 * a_m_ * b_m_ * std::cos(opening)));
}

double CylinderTriangle::length_rate(double angle_rad) const {
  const double length_m = length(angle_rad);
  if (length_m <= 0.0) {
    return 0.0;
  }
  return a_m_ * b_m_ * std::sin(offset_rad_ + angle_rad) / length_m;
}

double CylinderTriangle::length_curvature(double angle_rad) const {
  const double length_m = length(angle_rad);
  if (length_m <= 0.0) {
    return 0.0;
  }
  const double rate = length_rate(angle_rad);
  return (a_m_ * b_m_ * std::cos(offset_rad_ + angle_rad) - rate * rate) / length_m;
}

double CylinderTriangle::angle(double length_m) const {
  const double cosine = (a_m_ * a_m_ + b_m_ * b_m_ - length_m * length_m) / (2.0 * a_m_ * b_m_);
  const double opening = std::acos(std::clamp(cosine, -1.0, 1.0));
  return wrap_near(side_ * opening - offset_rad_, 0.0);
}

}  // namespace graben
