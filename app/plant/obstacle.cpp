#include "app/plant/obstacle.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {

Eigen::Vector2d Obstacle::step(const Eigen::Vector2d& tip_m) {
  if (touched()) {
    held_s_ += step_s_;
  }
  const Eigen::Vector2d along_face(-profile_.normal.y(), profile_.normal.x());
  const Eigen::Vector2d from_point = tip_m - profile_.point_m;
  const double depth_m = -from_point.dot(profile_.normal);
  const double along_m = from_point.dot(along_face);
  const double sinking_mps = (depth_m - last_depth_m_) / step_s_;
  last_depth_m_ = depth_m;
  const bool inside =
      depth_m > 0.0 && depth_m < profile_.size_m && std::abs(along_m) < profile_.size_m;
  if (gone() || !inside) {
    anchor_m_ = along_m;
    return Eigen::Vector2d::Zero();
  }
  held_s_ = std::max(held_s_, step_s_);
  const double across_n =
      profile_.stiffness_npm * depth_m + profile_.damping_nspm * std::max(0.0, sinking_mps);
  // A spring along the face, whose anchor slips where the force would be more than friction holds.
  const double most_m = profile_.friction * across_n / profile_.stiffness_npm;
  anchor_m_ = std::clamp(anchor_m_, along_m - most_m, along_m + most_m);
  return across_n * profile_.normal + profile_.stiffness_npm * (anchor_m_ - along_m) * along_face;
}

}  // namespace graben::plant
