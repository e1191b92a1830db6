#pragma once
/// What the bucket is held by and what it carries, as the controller knows it.

#include <Eigen/Core>

namespace graben {

/// By chamber pressures, pose and motion; see load_observer.hpp. A standard deviation is that of
/// the error; of the force, of each component.
struct TipLoad {
  bool known = false;  ///< Of the force. Pressures, pose and the links' masses are known.
  /// Of the ground on the teeth, in the plane of the links: x outwards, y up.
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();
  double force_sd_n = 0.0;
  bool payload_known = false;  ///< It was lifted free, and lies in the bucket since.
  double payload_kg = 0.0;
  double payload_sd_kg = 0.0;
};

}  // namespace graben
