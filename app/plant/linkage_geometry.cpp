// SPDX-License-Identifier: Apache-2.0
#include "app/plant/linkage_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kBucketStart = -1.2;  // rad, within the working range of any such linkage
constexpr double kBucketStride = 0.01;
constexpr double kWidestTurn = 3.0;
constexpr int kHalvings = 60;

/// Cylinder between a point that the joint leaves at rest and one that it turns about its own pin;
/// both from that pin.
Lever pin_lever(const CylinderGeometry& cylinder, const Eigen::Vector2d& base_m,
                const Eigen::Vector2d& eye_m) {
  const Eigen::Vector2d along = eye_m - base_m;
  const double length = along.norm();
  return {length - cylinder.closed_length_m, along.dot(turned(eye_m)) / length};
}

double direction(const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); }

/// Angle at the joint's pin between base and eye when the cylinder has this stroke.
double pin_opening(const CylinderGeometry& cylinder, const Eigen::Vector2d& base_m,
                   double stroke_m) {
  const double length = cylinder.closed_length_m + stroke_m;
  const double b = base_m.norm();
  const double e = cylinder.eye_m.norm();
  const double cosine = (b * b + e * e - length * length) / (2.0 * b * e);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2.0 * kPi); }

}  // namespace

Rotation Rotation::by(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

JointRotations rotations_of(const JointArray& angle_rad) {
  return {Rotation::by(angle_rad[0]), Rotation::by(angle_rad[1]), Rotation::by(angle_rad[2])};
}

std::array<Lever, kAxisCount> LinkageGeometry::levers(const JointRotations& joint) const {
  const CylinderGeometry& boom = geometry_.cylinder[kBoom];
  const CylinderGeometry& arm = geometry_.cylinder[kArm];
  const Eigen::Vector2d arm_pin(geometry_.boom_length_m, 0.0);
  return {pin_lever(boom, boom.base_m, joint[kBoom].apply(boom.eye_m)),
          pin_lever(arm, arm.base_m - arm_pin, joint[kArm].apply(arm.eye_m)),
          bucket_lever(joint[kBucket])};
}

Lever LinkageGeometry::bucket_lever(const Rotation& bucket) const {
  const CylinderGeometry& cylinder = geometry_.cylinder[kBucket];
  const BucketLinkage& bars = geometry_.linkage;
  // Arm frame; the rocker's end is where the circles of rocker and coupler meet, left of the
  // direction from the pivot to the lug.
  const Eigen::Vector2d lug_arm = bucket.apply(bars.lug_m);
  const Eigen::Vector2d to_lug =
      Eigen::Vector2d(geometry_.arm_length_m, 0.0) + lug_arm - bars.rocker_pivot_m;
  const double distance_square = to_lug.squaredNorm();
  const double rocker_square = bars.rocker_m * bars.rocker_m;
  const double along =
      0.5 * (distance_square + rocker_square - bars.coupler_m * bars.coupler_m) / distance_square;
  // Bars stretched to a line cannot be passed; the end stops keep the linkage away from there.
  const double aside = std::sqrt(std::max(0.0, rocker_square / distance_square - along * along));
  const Eigen::Vector2d rocker = along * to_lug + aside * turned(to_lug);
  // The coupler keeps its length: its direction sees the same speed at both of its ends.
  const Eigen::Vector2d coupler = rocker - to_lug;
  const double rocker_rate = coupler.dot(turned(lug_arm)) / coupler.dot(turned(rocker));
  const Eigen::Vector2d piston = bars.rocker_pivot_m + rocker - cylinder.base_m;
  const double length = piston.norm();
  return {length - cylinder.closed_length_m, piston.dot(turned(rocker)) * rocker_rate / length};
}

double LinkageGeometry::bucket_angle_at(double stroke_m) const {
  // Stroke falls with the angle: walk to a bracket as far as it does, then halve.
  const auto stroke_at = [this](double angle) {
    return bucket_lever(Rotation::by(angle)).stroke_m;
  };
  double low = kBucketStart;
  while (stroke_at(low) < stroke_m && stroke_at(low - kBucketStride) > stroke_at(low) &&
         low > -kPi) {
    low -= kBucketStride;
  }
  double high = kBucketStart;
  while (stroke_at(high) > stroke_m && stroke_at(high + kBucketStride) < stroke_at(high) &&
         high < kBucketStart + kWidestTurn) {
    high += kBucketStride;
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (stroke_at(middle) > stroke_m ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

JointArray LinkageGeometry::angles_at(const JointArray& stroke_m) const {
  const CylinderGeometry& boom = geometry_.cylinder[kBoom];
  const CylinderGeometry& arm = geometry_.cylinder[kArm];
  const Eigen::Vector2d arm_base = arm.base_m - Eigen::Vector2d(geometry_.boom_length_m, 0.0);
  return {wrapped(direction(boom.base_m) + pin_opening(boom, boom.base_m, stroke_m[kBoom]) -
                  direction(boom.eye_m)),
          wrapped(direction(arm_base) - pin_opening(arm, arm_base, stroke_m[kArm]) -
                  direction(arm.eye_m)),
          bucket_angle_at(stroke_m[kBucket])};
}

TipPose LinkageGeometry::tip(const JointArray& angle_rad) const {
  const double boom = angle_rad[kBoom];
  const double arm = boom + angle_rad[kArm];
  const double bucket = arm + angle_rad[kBucket];
  const Eigen::Vector2d position = Rotation::by(boom).apply({geometry_.boom_length_m, 0.0}) +
                                   Rotation::by(arm).apply({geometry_.arm_length_m, 0.0}) +
                                   Rotation::by(bucket).apply({geometry_.bucket_length_m, 0.0});
  return {position, bucket + kPi};
}

}  // namespace graben::plant
