// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/field/rounded_rectangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {
/// Turn of a corner. [rad; derived: a right angle, half of kPi]
constexpr double kHalfPi = 0.5 * kPi;
}  // namespace

RoundedRectangle::RoundedRectangle(const DigPath& path)
    : path_(path),
      inner_min_(path.x_min_m + path.corner_radius_m, path.y_min_m + path.corner_radius_m),
      inner_max_(path.x_max_m - path.corner_radius_m, path.y_max_m - path.corner_radius_m) {}

PathPoint RoundedRectangle::point(const Eigen::Vector2d& position_m,
                                  const Eigen::Vector2d& outward) const {
  PathPoint result;
  result.position_m = position_m;
  result.tangent = {outward.y(), -outward.x()};
  const double slope =
      (path_.attitude_at_x_max_rad - path_.attitude_at_x_min_rad) / (path_.x_max_m - path_.x_min_m);
  result.attitude_rad = path_.attitude_at_x_min_rad + slope * (position_m.x() - path_.x_min_m);
  result.attitude_slope_radpm = slope * result.tangent.x();
  return result;
}

PathPoint RoundedRectangle::closest(const Eigen::Vector2d& position_m) const {
  const Eigen::Vector2d inner = position_m.cwiseMax(inner_min_).cwiseMin(inner_max_);
  const Eigen::Vector2d from_inner = position_m - inner;
  const double distance = from_inner.norm();
  if (distance > 0.0) {
    const Eigen::Vector2d outward = from_inner / distance;
    return point(inner + path_.corner_radius_m * outward, outward);
  }
  // Inside the rectangle of the corners' centres the nearest side has it.
  const std::array<double, 4> gap = {path_.x_max_m - position_m.x(), position_m.y() - path_.y_min_m,
                                     position_m.x() - path_.x_min_m,
                                     path_.y_max_m - position_m.y()};
  switch (std::min_element(gap.begin(), gap.end()) - gap.begin()) {
    case 0:
      return point({path_.x_max_m, position_m.y()}, {1.0, 0.0});
    case 1:
      return point({position_m.x(), path_.y_min_m}, {0.0, -1.0});
    case 2:
      return point({path_.x_min_m, position_m.y()}, {-1.0, 0.0});
    default:
      return point({position_m.x(), path_.y_max_m}, {0.0, 1.0});
  }
}

double RoundedRectangle::length_m() const {
  const Eigen::Vector2d straight = inner_max_ - inner_min_;
  return 2.0 * straight.sum() + 4.0 * kHalfPi * path_.corner_radius_m;
}

PathPoint RoundedRectangle::at_share(double share) const {
  const Eigen::Vector2d straight = inner_max_ - inner_min_;
  const std::array<double, 4> side_m = {straight.y(), straight.x(), straight.y(), straight.x()};
  const double corner_m = kHalfPi * path_.corner_radius_m;
  // Each side starts beside a corner's centre and is followed by the corner at its other end.
  const std::array<Eigen::Vector2d, 4> centre = {
      inner_max_, Eigen::Vector2d(inner_max_.x(), inner_min_.y()), inner_min_,
      Eigen::Vector2d(inner_min_.x(), inner_max_.y())};
  double left_m = (share - std::floor(share)) * length_m();
  for (unsigned k = 0; k < 4; ++k) {
    const double outward_rad = -static_cast<double>(k) * kHalfPi;
    const Eigen::Vector2d outward(std::cos(outward_rad), std::sin(outward_rad));
    const Eigen::Vector2d along(outward.y(), -outward.x());
    if (left_m <= side_m[k]) {
      return point(centre[k] + path_.corner_radius_m * outward + left_m * along, outward);
    }
    left_m -= side_m[k];
    if (left_m <= corner_m) {
      const double turned_rad = outward_rad - left_m / corner_m * kHalfPi;
      const Eigen::Vector2d turned(std::cos(turned_rad), std::sin(turned_rad));
      return point(centre[(k + 1) % 4] + path_.corner_radius_m * turned, turned);
    }
    left_m -= corner_m;
  }
  return point(centre[0] + path_.corner_radius_m * Eigen::Vector2d(1.0, 0.0), {1.0, 0.0});
}

}  // namespace graben
