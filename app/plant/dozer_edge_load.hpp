// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What soil does to a cutting edge with a slope across: a force on each strip of it.

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "app/plant/dozer_cross_ground.hpp"

namespace graben::plant {

/// Of the edge, over a line of the ground.
struct EdgePlace {
  bool reached = false;               ///< The edge comes over the line.
  double along_m = 0.0;               ///< To the left along it from its middle.
  Eigen::Vector2d at_m = {0.0, 0.0};  ///< x and z.
};

/// The lines of CrossGround with the one below the middle, from left to right.
inline constexpr std::size_t kEdgeStrips = CrossGround::kLines + 1;
using EdgePlaces = std::array<EdgePlace, kEdgeStrips>;

/// Of the edge's width, what belongs to each place: to halfway to the next one, the outermost ones
/// to its ends (the trapezoidal rule). Sums up to 1.
[[nodiscard]] std::array<double, kEdgeStrips> strip_shares(const EdgePlaces& places,
                                                           double half_width_m);

/// Forces and moments of the strips together. The first two moments are about axes of the blade,
/// the others of the body.
struct EdgeLoad {
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();  ///< Along and up, in the world.
  double lift_nm = 0.0;                               ///< About the blade's pivot, raising it.
  double tilt_nm = 0.0;   ///< About its own longitudinal axis, raising its left end.
  double pitch_nm = 0.0;  ///< About the mass centre, nose up.
  double roll_nm = 0.0;   ///< Left side up.
  double yaw_nm = 0.0;    ///< To the left.
};

/// How the machine stands in it; lengths from the body frame's origin, ahead, to the left, up, with
/// the world's vertical.
struct EdgeStand {
  Eigen::Vector3d edge_middle_m;
  Eigen::Vector3d pivot_m;
  Eigen::Vector3d mass_centre_m;
  Eigen::Vector3d blade_axis;  ///< The longitudinal one, forward.
  Eigen::Vector3d body_axis;   ///< The same of the body.
  Eigen::Vector3d lift_axis;   ///< To the left.
};

/// Adds the force on a strip there.
void add_strip(const EdgeStand& stand, const Eigen::Vector3d& at_m, const Eigen::Vector2d& force_n,
               EdgeLoad& load);

}  // namespace graben::plant
