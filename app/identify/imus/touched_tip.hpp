// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the bucket's edge is by gravity in the links' IMUs.

#include <Eigen/Core>

#include "app/identify/imus/rest_log.hpp"
#include "firmware/excavator/kinematics/bucket_linkage.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"

namespace graben::identify {

class TouchedTip {
 public:
  explicit TouchedTip(const ExcavatorProfile& profile);

  /// From the boom foot's pin, level; `turns_rad` is what is added to each mount's turn. Not finite
  /// where the bucket's linkage does not close.
  [[nodiscard]] Eigen::Vector2d at(const Rest& rest, const Eigen::Vector3d& turns_rad) const;
  /// Its derivative by the turns, m/rad; that by the angles is the same with the other sign.
  [[nodiscard]] Eigen::Matrix<double, 2, 3> slope(const Rest& rest,
                                                  const Eigen::Vector3d& turns_rad) const;
  /// Boom against the horizontal, arm against boom, bucket against arm.
  [[nodiscard]] Eigen::Vector3d joints_rad(const Rest& rest,
                                           const Eigen::Vector3d& turns_rad) const;

 private:
  ExcavatorKinematics kinematics_;
  BucketLinkageSolver linkage_;
  bool on_rocker_ = false;
};

}  // namespace graben::identify
