// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/load/link_moments.hpp"

#include <cmath>

#include "firmware/excavator/estimation/load/tuning.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

Eigen::Vector2d left_of(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Eigen::Vector2d in_frame(const Eigen::Vector2d& along, const Eigen::Vector2d& v) {
  return v.x() * along + v.y() * left_of(along);
}

/// Of a point that turns with its link about the link's joint.
Eigen::Vector2d turned_mps2(const Eigen::Vector2d& arm_m, double rate_radps,
                            double acceleration_radps2) {
  return acceleration_radps2 * left_of(arm_m) - rate_radps * rate_radps * arm_m;
}

/// Middle of what a bucket carries, in its frame: along the line pin to teeth, and off it. Its back
/// bulges half as far as it could: the mean of a triangle pin, heel, teeth and of the trapezium
/// with a back that stands on the line at the pin. Where else a load lies is learnt.
Eigen::Vector2d load_middle_m(const ExcavatorGeometry& geometry) {
  const double length_m = geometry.bucket_length_m;
  const ExcavatorBody& body = geometry.body;
  const bool said = body.floor_m > 0.0;
  const double floor_m = said ? body.floor_m : kUnsaidFloor * length_m;
  const double floor_rad = said ? body.floor_rad : kUnsaidFloor_rad;
  const double heel_m = length_m - floor_m * std::cos(floor_rad);
  const double deep_m = floor_m * std::sin(floor_rad);
  const double sum_m = heel_m + length_m;
  const Eigen::Vector2d triangle_m(sum_m / 3.0, deep_m / 3.0);
  const Eigen::Vector2d trapezium_m(
      (heel_m * heel_m + heel_m * length_m + length_m * length_m) / (3.0 * sum_m),
      deep_m * (heel_m + sum_m) / (3.0 * sum_m));
  return 0.5 * (triangle_m + trapezium_m);
}

}  // namespace

LinkPlaces link_places(const OilProfile& oil, const ExcavatorGeometry& geometry,
                       const Eigen::Vector3d& joints_rad) {
  const std::array<double, kAxisCount> length_m = {geometry.boom_length_m, geometry.arm_length_m,
                                                   geometry.bucket_length_m};
  LinkPlaces at;
  Eigen::Vector2d pin_m = Eigen::Vector2d::Zero();
  double direction_rad = 0.0;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    direction_rad += joints_rad[i];
    at.along[i] = {std::cos(direction_rad), std::sin(direction_rad)};
    at.pin_m[i] = pin_m;
    at.centre_m[i] = pin_m + in_frame(at.along[i], oil.link[i].centre_m);
    if (i == kBucket) {
      at.load_m = pin_m + in_frame(at.along[i], load_middle_m(geometry));
    }
    pin_m += length_m[i] * at.along[i];
  }
  at.teeth_m = pin_m;
  return at;
}

LinkMoments holding_moments(const OilProfile& oil, const LinkPlaces& at) {
  LinkMoments moments;
  for (unsigned joint = 0; joint < kAxisCount; ++joint) {
    const double pin_m = at.pin_m[joint].x();
    for (unsigned link = joint; link < kAxisCount; ++link) {
      moments.of_link(joint, link) =
          kStandardGravity_mps2 * oil.link[link].mass_kg * (at.centre_m[link].x() - pin_m);
    }
    moments.load_nmpkg[joint] = kStandardGravity_mps2 * (at.load_m.x() - pin_m);
  }
  return moments;
}

LinkMoments moving_moments(const OilProfile& oil, const LinkPlaces& at,
                           const Eigen::Vector3d& rates_radps,
                           const Eigen::Vector3d& accelerations_radps2, double swing_radps,
                           double foot_m) {
  const auto outwards_mps2 = [&](const Eigen::Vector2d& place_m) -> Eigen::Vector2d {
    return {-swing_radps * swing_radps * (foot_m + place_m.x()), 0.0};
  };
  LinkMoments moments;
  Eigen::Vector2d pin_mps2 = Eigen::Vector2d::Zero();
  double rate_radps = 0.0;
  double turn_radps2 = 0.0;
  for (unsigned link = 0; link < kAxisCount; ++link) {
    const LinkMass& body = oil.link[link];
    rate_radps += rates_radps[link];
    turn_radps2 += accelerations_radps2[link];
    const Eigen::Vector2d arm_m = at.centre_m[link] - at.pin_m[link];
    const Eigen::Vector2d force_n =
        body.mass_kg *
        (pin_mps2 + turned_mps2(arm_m, rate_radps, turn_radps2) + outwards_mps2(at.centre_m[link]));
    for (unsigned joint = 0; joint <= link; ++joint) {
      moments.of_link(joint, link) =
          cross(at.centre_m[link] - at.pin_m[joint], force_n) + body.inertia_kgm2 * turn_radps2;
    }
    if (link == kBucket) {
      const Eigen::Vector2d load_mps2 =
          pin_mps2 + turned_mps2(at.load_m - at.pin_m[link], rate_radps, turn_radps2) +
          outwards_mps2(at.load_m);
      for (unsigned joint = 0; joint < kAxisCount; ++joint) {
        moments.load_nmpkg[joint] = cross(at.load_m - at.pin_m[joint], load_mps2);
      }
      break;
    }
    pin_mps2 += turned_mps2(at.pin_m[link + 1] - at.pin_m[link], rate_radps, turn_radps2);
  }
  return moments;
}

Eigen::Matrix<double, kAxisCount, 2> teeth_moments_m(const LinkPlaces& at) {
  Eigen::Matrix<double, kAxisCount, 2> moments_m;
  for (unsigned joint = 0; joint < kAxisCount; ++joint) {
    const Eigen::Vector2d arm_m = at.teeth_m - at.pin_m[joint];
    moments_m.row(joint) << -arm_m.y(), arm_m.x();
  }
  return moments_m;
}

}  // namespace graben
