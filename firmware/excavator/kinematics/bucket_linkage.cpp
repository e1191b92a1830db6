// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/kinematics/bucket_linkage.hpp"

#include <cmath>

#include "firmware/excavator/kinematics/tuning.hpp"
#include "firmware/numeric/triangle.hpp"

namespace graben {
namespace {

Eigen::Vector2d left_of(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

Eigen::Vector2d rotated(const Eigen::Vector2d& v, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

struct Meeting {
  bool exists = false;
  Eigen::Vector2d point_m = Eigen::Vector2d::Zero();
};

/// Where circles about `from` and `to` meet, on the left (side +1) or right (-1) of from -> to.
Meeting meet(const Eigen::Vector2d& from, double from_radius_m, const Eigen::Vector2d& to,
             double to_radius_m, double side) {
  const Eigen::Vector2d line = to - from;
  const double distance = line.norm();
  if (distance <= 0.0) {
    return {};
  }
  const double along =
      (from_radius_m * from_radius_m - to_radius_m * to_radius_m + distance * distance) /
      (2.0 * distance);
  const double height_squared = from_radius_m * from_radius_m - along * along;
  if (height_squared < 0.0) {
    return {};
  }
  const Eigen::Vector2d unit = line / distance;
  return {true, from + along * unit + side * std::sqrt(height_squared) * left_of(unit)};
}

}  // namespace

BucketLinkageSolver::BucketLinkageSolver(const BucketLinkage& linkage,
                                         const Eigen::Vector2d& cylinder_base_m,
                                         double arm_length_m)
    : linkage_(linkage), base_m_(cylinder_base_m), pin_m_(arm_length_m, 0.0) {}

LinkageState BucketLinkageSolver::with_rocker_end(const Eigen::Vector2d& rocker_end_m,
                                                  const Eigen::Vector2d& lug_m,
                                                  double angle_rad) const {
  const Eigen::Vector2d cylinder = rocker_end_m - base_m_;
  const Eigen::Vector2d coupler = lug_m - rocker_end_m;
  const Eigen::Vector2d rocker = rocker_end_m - linkage_.rocker_pivot_m;
  const Eigen::Vector2d lug = lug_m - pin_m_;
  const Eigen::Vector2d rocker_motion = left_of(rocker);
  const Eigen::Vector2d lug_motion = left_of(lug);
  // The coupler keeps its length: (rocker_motion . coupler) d rocker = (lug_motion . coupler) d
  // lug.
  const double rocker_share = rocker_motion.dot(coupler);
  const double length_m = cylinder.norm();
  if (std::abs(rocker_share) < 1e-9 || length_m <= 0.0) {
    return {};
  }
  const double rocker_per_bucket = lug_motion.dot(coupler) / rocker_share;
  const double per_rocker = rocker_motion.dot(cylinder) / length_m;
  // The same condition once more by the bucket's angle; a point turns with the square of its rate
  // towards its pivot.
  const double square = rocker_per_bucket * rocker_per_bucket;
  const double rocker_curvature = ((lug_motion - rocker_per_bucket * rocker_motion).squaredNorm() -
                                   coupler.dot(lug) + square * coupler.dot(rocker)) /
                                  rocker_share;
  const double per_rocker_curvature =
      (rocker.squaredNorm() - cylinder.dot(rocker) - per_rocker * per_rocker) / length_m;
  return {true,
          angle_rad,
          length_m,
          per_rocker * rocker_per_bucket,
          per_rocker_curvature * square + per_rocker * rocker_curvature,
          std::abs(rocker_per_bucket) < 1e-9 ? 0.0 : 1.0 / rocker_per_bucket};
}

LinkageState BucketLinkageSolver::from_angle(double angle_rad) const {
  const Eigen::Vector2d lug_m = pin_m_ + rotated(linkage_.lug_m, angle_rad);
  const Meeting end =
      meet(linkage_.rocker_pivot_m, linkage_.rocker_m, lug_m, linkage_.coupler_m, 1.0);
  if (!end.exists) {
    return {};
  }
  return with_rocker_end(end.point_m, lug_m, angle_rad);
}

LinkageState BucketLinkageSolver::from_length(double length_m) const {
  // The rocker's end lies ahead of the line from the cylinder's base to the pivot, on its left.
  const Meeting end = meet(base_m_, length_m, linkage_.rocker_pivot_m, linkage_.rocker_m, 1.0);
  if (!end.exists) {
    return {};
  }
  return with_end(end.point_m);
}

LinkageState BucketLinkageSolver::from_rocker(double rocker_rad) const {
  return with_end(linkage_.rocker_pivot_m + rotated({linkage_.rocker_m, 0.0}, rocker_rad));
}

LinkageState BucketLinkageSolver::with_end(const Eigen::Vector2d& rocker_end_m) const {
  // Seen from the bucket pin, the lug that has the rocker's end on the left of pivot -> lug.
  const Meeting lug = meet(rocker_end_m, linkage_.coupler_m, pin_m_, linkage_.lug_m.norm(), 1.0);
  if (!lug.exists) {
    return {};
  }
  const Eigen::Vector2d lug_arm = lug.point_m - pin_m_;
  const double angle =
      std::atan2(lug_arm.y(), lug_arm.x()) - std::atan2(linkage_.lug_m.y(), linkage_.lug_m.x());
  return with_rocker_end(rocker_end_m, lug.point_m, wrap_near(angle, kBucketCentre_rad));
}

}  // namespace graben
