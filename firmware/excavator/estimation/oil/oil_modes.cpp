// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/oil/oil_modes.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/estimation/oil/tuning.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

double full_share(double pressure_pa) {
  return std::clamp(pressure_pa / kOilEmpty_pa, kOilEmptyShare, 1.0);
}

double cross(const Eigen::Vector2d& a, double angle_rad, const Eigen::Vector2d& b) {
  // a . R(angle) b
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return a.x() * (c * b.x() - s * b.y()) + a.y() * (s * b.x() + c * b.y());
}

}  // namespace

double payload_kg(const OilProfile& oil, const ExcavatorGeometry& geometry,
                  const KinematicState& now, double boom_force_n) {
  const Eigen::Vector2d along(1.0, 0.0);
  const double boom_rad = now.joints_rad[kBoom];
  const double arm_rad = boom_rad + now.joints_rad[kArm];
  const double bucket_rad = arm_rad + now.joints_rad[kBucket];
  const Eigen::Vector2d elbow_m(geometry.boom_length_m, 0.0);
  const Eigen::Vector2d wrist_m(geometry.arm_length_m, 0.0);
  const double arm_pin_m = cross(along, boom_rad, elbow_m);
  const double bucket_pin_m = arm_pin_m + cross(along, arm_rad, wrist_m);
  const double bucket_m = bucket_pin_m + cross(along, bucket_rad, oil.link[kBucket].centre_m);
  const double moment_kgm =
      oil.link[kBoom].mass_kg * cross(along, boom_rad, oil.link[kBoom].centre_m) +
      oil.link[kArm].mass_kg * (arm_pin_m + cross(along, arm_rad, oil.link[kArm].centre_m)) +
      oil.link[kBucket].mass_kg * bucket_m;
  const double turn_radpm = now.jacobian(2, kBoom);
  const double carried_kgm = boom_force_n / (kStandardGravity_mps2 * turn_radpm) - moment_kgm;
  return bucket_m > kWeighedReach_m
             ? std::clamp(kWeighedHeavier * carried_kgm / bucket_m, 0.0, kWeighedMost_kg)
             : 0.0;
}

Eigen::Matrix2d stroke_inertia_kg(const OilProfile& oil, const ExcavatorGeometry& geometry,
                                  const KinematicState& now, double payload_kg) {
  const LinkMass& boom = oil.link[kBoom];
  const LinkMass& arm = oil.link[kArm];
  LinkMass bucket = oil.link[kBucket];
  bucket.mass_kg += payload_kg;
  const double bucket_rad = now.joints_rad[kBucket];
  const double c = std::cos(bucket_rad);
  const double s = std::sin(bucket_rad);
  const Eigen::Vector2d& centre_m = bucket.centre_m;
  // In the arm's frame.
  const Eigen::Vector2d bucket_m(geometry.arm_length_m + c * centre_m.x() - s * centre_m.y(),
                                 s * centre_m.x() + c * centre_m.y());
  const double carried_kg = arm.mass_kg + bucket.mass_kg;
  const Eigen::Vector2d moment_kgm = arm.mass_kg * arm.centre_m + bucket.mass_kg * bucket_m;
  const double arm_kgm2 = arm.inertia_kgm2 + arm.mass_kg * arm.centre_m.squaredNorm() +
                          bucket.inertia_kgm2 + bucket.mass_kg * bucket_m.squaredNorm();
  const Eigen::Vector2d boom_m(geometry.boom_length_m, 0.0);
  const double coupled_kgm2 = cross(boom_m, now.joints_rad[kArm], moment_kgm);
  const double boom_kgm2 = boom.inertia_kgm2 + boom.mass_kg * boom.centre_m.squaredNorm() +
                           carried_kg * boom_m.squaredNorm();
  // The attitude turns with each joint: its row of the Jacobian is the joints' turn per stroke.
  const double boom_radpm = now.jacobian(2, kBoom);
  const double arm_radpm = now.jacobian(2, kArm);
  const double both_kg = boom_radpm * arm_radpm * (arm_kgm2 + coupled_kgm2);
  Eigen::Matrix2d inertia_kg;
  inertia_kg << boom_radpm * boom_radpm * (boom_kgm2 + arm_kgm2 + 2.0 * coupled_kgm2), both_kg,
      both_kg, arm_radpm * arm_radpm * arm_kgm2;
  return inertia_kg;
}

double oil_column_npm(const OilProfile& oil, const CylinderGeometry& cylinder,
                      double dead_volume_m3, double stroke_m, const LoadState& load) {
  const double cap_m2 = cylinder.cap_area_m2();
  const double rod_m2 = cylinder.rod_area_m2();
  const double in_m = std::clamp(stroke_m, 0.0, cylinder.stroke_m);
  const double cap_m3 = dead_volume_m3 + cap_m2 * in_m;
  const double rod_m3 = dead_volume_m3 + rod_m2 * (cylinder.stroke_m - in_m);
  return oil.bulk_modulus_pa * (full_share(load.cap_pa) * cap_m2 * cap_m2 / cap_m3 +
                                full_share(load.rod_pa) * rod_m2 * rod_m2 / rod_m3);
}

OilModes oil_modes(const OilProfile& oil, const ExcavatorGeometry& geometry,
                   const KinematicState& now, Span<const LoadState> load, double payload_kg,
                   double stiffness_share) {
  OilModes modes;
  for (int axis = 0; axis < 2; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    modes.stiffness_npm[axis] =
        stiffness_share * oil_column_npm(oil, geometry.cylinder[k], oil.dead_volume_m3[k],
                                         now.strokes_m[axis], load[axis]);
  }
  // With x = K^-1/2 y the pair is K^-1/2 M K^-1/2 y = y / omega^2, symmetric: one turn solves it.
  const Eigen::Vector2d root = modes.stiffness_npm.cwiseSqrt();
  const Eigen::Matrix2d inertia_kg = stroke_inertia_kg(oil, geometry, now, payload_kg);
  const double boom = inertia_kg(0, 0) / (root[0] * root[0]);
  const double both = inertia_kg(0, 1) / (root[0] * root[1]);
  const double arm = inertia_kg(1, 1) / (root[1] * root[1]);
  const double half = 0.5 * (boom - arm);
  const double radius = std::sqrt(half * half + both * both);
  const double mean = 0.5 * (boom + arm);
  const double turn_rad = 0.5 * std::atan2(both, half);
  Eigen::Matrix2d turned;
  turned << std::cos(turn_rad), -std::sin(turn_rad), std::sin(turn_rad), std::cos(turn_rad);
  for (int j = 0; j < 2; ++j) {
    const Eigen::Vector2d shape = turned.col(j).cwiseQuotient(root);
    const double length = shape.norm();
    modes.shape.col(j) = shape / length;
    modes.inverse.row(j) = length * turned.col(j).cwiseProduct(root).transpose();
    modes.omega_radps[j] = 1.0 / std::sqrt(j == 0 ? mean + radius : mean - radius);
  }
  return modes;
}

}  // namespace graben
