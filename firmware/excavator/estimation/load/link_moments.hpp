// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What it takes to hold and to move the links, link by link: Newton's and Euler's equations from
/// the boom's foot to the bucket, in the plane of the links (x outwards, y up).

#include <Eigen/Core>
#include <array>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben {

/// Where links and joints are. `arm_m[i]` leads from joint i to the teeth.
struct LinkPlaces {
  std::array<Eigen::Vector2d, kAxisCount> along;     ///< Of each link, pin to next pin, length 1.
  std::array<Eigen::Vector2d, kAxisCount> centre_m;  ///< Of mass, from the boom's foot.
  std::array<Eigen::Vector2d, kAxisCount> pin_m;     ///< Each link's joint, from the boom's foot.
  Eigen::Vector2d teeth_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d load_m = Eigen::Vector2d::Zero();  ///< Middle of what the bucket carries.
};

/// Moments about the joints, N m: one row a joint, one column a link; a link that the joint does
/// not carry has none. `load` is that of each kilogram that the bucket carries.
struct LinkMoments {
  Eigen::Matrix3d of_link = Eigen::Matrix3d::Zero();
  Eigen::Vector3d load_nmpkg = Eigen::Vector3d::Zero();
};

[[nodiscard]] LinkPlaces link_places(const OilProfile& oil, const ExcavatorGeometry& geometry,
                                     const Eigen::Vector3d& joints_rad);

/// That hold the links up where they are, at rest.
[[nodiscard]] LinkMoments holding_moments(const OilProfile& oil, const LinkPlaces& at);

/// That give the links their accelerations besides: joint rates and accelerations, and the
/// platform's turning, which throws the links outwards. `foot_m` is how far the boom's foot is from
/// the swing axis.
[[nodiscard]] LinkMoments moving_moments(const OilProfile& oil, const LinkPlaces& at,
                                         const Eigen::Vector3d& rates_radps,
                                         const Eigen::Vector3d& accelerations_radps2,
                                         double swing_radps, double foot_m);

/// Of a force of 1 N on the teeth about each joint: outwards in column 0, up in column 1, N m.
[[nodiscard]] Eigen::Matrix<double, kAxisCount, 2> teeth_moments_m(const LinkPlaces& at);

}  // namespace graben
