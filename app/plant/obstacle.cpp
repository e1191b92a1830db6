#include "app/plant/obstacle.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

/// Of the tip in the rock's own frame.
struct Place {
  double depth_m = 0.0;  ///< Behind the face.
  double along_m = 0.0;  ///< Of the face's point, along the face.
};

Place place_of(const ObstacleProfile& profile, const Eigen::Vector2d& tip_m) {
  const Eigen::Vector2d along_face(-profile.normal.y(), profile.normal.x());
  const Eigen::Vector2d from_point = tip_m - profile.point_m;
  return {-from_point.dot(profile.normal), from_point.dot(along_face)};
}

bool is_inside(const ObstacleProfile& profile, const Place& place) {
  return place.depth_m > 0.0 && place.depth_m < profile.size_m &&
         std::abs(place.along_m) < profile.size_m;
}

}  // namespace

bool is_inside(const ObstacleProfile& profile, const Eigen::Vector2d& tip_m) {
  return is_inside(profile, place_of(profile, tip_m));
}

Eigen::Vector2d Obstacle::step(const Eigen::Vector2d& tip_m) {
  if (touched()) {
    held_s_ += step_s_;
  }
  const Eigen::Vector2d along_face(-profile_.normal.y(), profile_.normal.x());
  const Place place = place_of(profile_, tip_m);
  const auto [depth_m, along_m] = place;
  const double sinking_mps = (depth_m - last_depth_m_) / step_s_;
  last_depth_m_ = depth_m;
  if (gone() || !is_inside(profile_, place)) {
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
