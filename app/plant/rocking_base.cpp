// SPDX-License-Identifier: Apache-2.0
#include "app/plant/rocking_base.hpp"

#include <algorithm>
#include <cmath>

#include "app/plant/excavator_plant_profile.hpp"

namespace graben::plant {
namespace {

// No source gives these; each is what machines of the class have, roughly.

/// Mass of all that is no link over that of the links: a 22 t machine's are some 4.5 t.
constexpr double kBodyOverLinks = 4.0;
/// Of the body about the middle of its tracks.
constexpr double kGyration_m = 1.6;
/// Each end of the tracks from their middle: the springs under them make it rock and sink.
constexpr double kHalfTrack_m = 1.5;
/// Of the body with stretched links. Soft ground takes what swings out in a few swings.
constexpr double kDampingRatio = 0.2;

}  // namespace

double full_bucket_force_n(const ExcavatorPlantProfile& profile) {
  const ExcavatorGeometry& geometry = profile.machine.geometry;
  const LinkageGeometry linkage(geometry);
  const CylinderGeometry& cylinder = geometry.cylinder[kBucket];
  double most_m = 0.0;
  constexpr int kPlaces = 50;
  for (int i = 0; i <= kPlaces; ++i) {
    const JointArray stroke_m = {0.5 * geometry.cylinder[kBoom].stroke_m,
                                 0.5 * geometry.cylinder[kArm].stroke_m,
                                 cylinder.stroke_m * i / kPlaces};
    const JointArray joint = linkage.angles_at(stroke_m);
    most_m =
        std::max(most_m, std::abs(linkage.levers(rotations_of(joint))[kBucket].stroke_per_angle_m));
  }
  return profile.machine.pump[0].relief_pa * cylinder.cap_area_m2() * most_m /
         geometry.bucket_length_m;
}

RockingBase::RockingBase(const ExcavatorPlantProfile& profile) {
  const ExcavatorGeometry& geometry = profile.machine.geometry;
  // The bucket under the boom's end.
  const double reach_m = geometry.boom_foot_m.x() + geometry.boom_length_m;
  stiffness_nmprad_ = full_bucket_force_n(profile) * reach_m / profile.rocking_rad;
  double links_kg = 0.0;
  for (const LinkBody& link : profile.link) {
    links_kg += link.mass_kg;
  }
  body_kgm2_ = kBodyOverLinks * links_kg * kGyration_m * kGyration_m;
  const double whole_kgm2 = body_kgm2_ + links_kg * reach_m * reach_m / 2.0;
  damping_nmsprad_ = 2.0 * kDampingRatio * std::sqrt(stiffness_nmprad_ * whole_kgm2);
}

void RockingBase::step(const BaseLoad& load, double step_s) {
  acceleration_radps2_ = (load.moment_nm - load.links_moment_nm - stiffness_nmprad_ * angle_rad_ -
                          damping_nmsprad_ * rate_radps_) /
                         (body_kgm2_ + load.inertia_kgm2);
  rate_radps_ += step_s * acceleration_radps2_;
  angle_rad_ += step_s * rate_radps_;
  // Both springs alike: their sum is the rocking one's over the square of its arm. It follows with
  // the lag that its damper gives.
  const double up_npm = stiffness_nmprad_ / (kHalfTrack_m * kHalfTrack_m);
  const double lag_s = damping_nmsprad_ / stiffness_nmprad_;
  sunk_m_ += -std::expm1(-step_s / lag_s) * (-load.up_n / up_npm - sunk_m_);
}

}  // namespace graben::plant
