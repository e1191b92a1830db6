// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Soft ground under the tracks: the machine rocks on it in the plane of the links, and sinks.
///
/// A spring and a damper under each end of the tracks. Taken off what a machine has: it rocks about
/// the middle of its tracks on the ground, in the plane of the links alone, which a swing carries
/// along; it does not slide; sinking has no mass, and the ground springs back wholly.

#include <Eigen/Core>

#include "app/plant/linkage_geometry.hpp"

namespace graben::plant {

struct ExcavatorPlantProfile;

/// What pushes the machine, about the middle of the tracks; left about that is up at the bucket.
struct BaseLoad {
  double moment_nm = 0.0;        ///< All but the reaction of what turns with the base.
  double up_n = 0.0;             ///< Of the ground on the bucket.
  double inertia_kgm2 = 0.0;     ///< Of the links as they are.
  double links_moment_nm = 0.0;  ///< Rate of the links' moment of momentum in the base's frame.
};

/// The force at the edge, N, that the bucket's cylinder has at the first pump's relief with its
/// best lever: what a data sheet calls breakout force.
[[nodiscard]] double full_bucket_force_n(const ExcavatorPlantProfile& profile);

class RockingBase {
 public:
  /// Of a profile with `rocking_rad` above 0.
  explicit RockingBase(const ExcavatorPlantProfile& profile);

  void step(const BaseLoad& load, double step_s);

  /// Bucket up is positive.
  [[nodiscard]] double angle_rad() const { return angle_rad_; }
  [[nodiscard]] double acceleration_radps2() const { return acceleration_radps2_; }
  [[nodiscard]] double sunk_m() const { return sunk_m_; }

  /// A place of the machine's plane, from the middle of the tracks, and where it is then.
  [[nodiscard]] Eigen::Vector2d on_ground(const Eigen::Vector2d& at_m) const {
    return Rotation::by(angle_rad_).apply(at_m) - Eigen::Vector2d(0.0, sunk_m_);
  }

 private:
  double stiffness_nmprad_;
  double damping_nmsprad_;
  double body_kgm2_;
  double angle_rad_ = 0.0;
  double rate_radps_ = 0.0;
  double acceleration_radps2_ = 0.0;
  double sunk_m_ = 0.0;
};

}  // namespace graben::plant
