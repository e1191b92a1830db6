// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Closed rounded rectangle with an attitude along it: Kim's digging path (section 5, Fig. 9).

#include <Eigen/Core>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben {

/// A point of the path with what the field needs of it.
struct PathPoint {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d tangent = Eigen::Vector2d::Zero();  ///< Unit, in the digging direction.
  double attitude_rad = 0.0;                          ///< Linear in x of the position.
  double attitude_slope_radpm = 0.0;                  ///< d attitude / d path length.
};

/// Run clockwise with x forward and y up: down at the far side, in along the bottom, up at the
/// near side, out along the top. Needs x_min < x_max, y_min < y_max and a radius of at most half
/// the shorter side.
class RoundedRectangle {
 public:
  explicit RoundedRectangle(const DigPath& path);

  /// Nearest point of the path, in closed form. Off the path's medial axis it is unique; on it,
  /// one of the nearest.
  [[nodiscard]] PathPoint closest(const Eigen::Vector2d& position_m) const;

  /// Point at this share (0 .. 1) of the way round, from the upper end of the far side.
  [[nodiscard]] PathPoint at_share(double share) const;
  [[nodiscard]] double length_m() const;

 private:
  [[nodiscard]] PathPoint point(const Eigen::Vector2d& position_m,
                                const Eigen::Vector2d& outward) const;

  DigPath path_;
  Eigen::Vector2d inner_min_;  ///< Rectangle of the corners' centres.
  Eigen::Vector2d inner_max_;
};

}  // namespace graben
