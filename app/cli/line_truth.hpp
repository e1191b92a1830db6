#pragma once
/// How far the teeth are from a planned line.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "firmware/motion/line.hpp"

namespace graben::cli {

/// From the straight line through both ends, m; ground frame.
[[nodiscard]] inline double line_distance_m(const TeethLine& line, const Eigen::Vector3d& teeth_m) {
  const Eigen::Vector3d direction = line.change.position_m.normalized();
  return (teeth_m - line.from.position_m).cross(direction).norm();
}

}  // namespace graben::cli
