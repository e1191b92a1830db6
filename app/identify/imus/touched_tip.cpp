// SPDX-License-Identifier: Apache-2.0
#include "app/identify/imus/touched_tip.hpp"

#include <limits>

namespace graben::identify {

TouchedTip::TouchedTip(const ExcavatorProfile& profile)
    : kinematics_(profile.geometry),
      linkage_(profile.geometry.linkage, profile.geometry.cylinder[kBucket].base_m,
               profile.geometry.arm_length_m),
      on_rocker_(profile.imu.mount[kBucket].on_rocker) {}

Eigen::Vector3d TouchedTip::joints_rad(const Rest& rest, const Eigen::Vector3d& turns_rad) const {
  // A sensor that is turned up by so much shows its link as much lower.
  const Eigen::Vector3d link_rad = Eigen::Vector3d(rest.angle_rad.data()) - turns_rad;
  Eigen::Vector3d joints(link_rad[0], link_rad[1] - link_rad[0], link_rad[2] - link_rad[1]);
  if (on_rocker_) {
    const LinkageState bucket = linkage_.from_rocker(joints[2]);
    joints[2] = bucket.closed ? bucket.angle_rad : std::numeric_limits<double>::quiet_NaN();
  }
  return joints;
}

Eigen::Vector2d TouchedTip::at(const Rest& rest, const Eigen::Vector3d& turns_rad) const {
  const TipPose tip = kinematics_.pose_from_joints(joints_rad(rest, turns_rad));
  return {tip.x_m, tip.y_m};
}

Eigen::Matrix<double, 2, 3> TouchedTip::slope(const Rest& rest,
                                              const Eigen::Vector3d& turns_rad) const {
  constexpr double kStep_rad = 1e-5;
  Eigen::Matrix<double, 2, 3> slope;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const Eigen::Vector3d step = kStep_rad * Eigen::Vector3d::Unit(axis);
    slope.col(axis) = (at(rest, turns_rad + step) - at(rest, turns_rad - step)) / (2.0 * kStep_rad);
  }
  return slope;
}

}  // namespace graben::identify
