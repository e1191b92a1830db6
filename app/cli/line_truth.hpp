#pragma once
/// How far the teeth are from a planned line.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "firmware/motion/line.hpp"

namespace graben::cli {

/// From the straight line through both ends, m; ground frame.
[[nodiscard]] inline double line_distance_m(const TeethLine& line, const Eigen::Vector3d& teeth_m) {
  const Eigen::Vector3d off_m = teeth_m - line.from.position_m;
  const double length_m = line.change.position_m.norm();
  // A line that only turns the bucket is a point.
  return length_m > 0.0 ? off_m.cross(line.change.position_m).norm() / length_m : off_m.norm();
}

}  // namespace graben::cli
