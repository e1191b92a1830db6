// SPDX-License-Identifier: Apache-2.0
#include "app/runs/fence_truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben::runs {
namespace {

/// Points along a link, along each side of the bucket's triangle, across it, and of the rear.
constexpr int kAlong = 48;
constexpr int kTriangle = 8;
constexpr int kAcross = 6;
constexpr int kRear = 12;
constexpr int kRearUp = 6;

Eigen::Vector2d heading(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

double share(int i, int of) { return static_cast<double>(i) / of; }

/// Of lengths of metres, whose squares neither overflow nor vanish: std::hypot was a sixth of a run
/// past fences.
double length_m(double one_m, double other_m) {
  return std::sqrt(one_m * one_m + other_m * other_m);
}

/// Of what goes `out_m` beyond a shape in plan and `up_m` above or below it; both below 0 inside.
double outside_m(double out_m, double up_m) {
  const double most_m = std::max(out_m, up_m);
  return most_m > 0.0 ? length_m(std::max(out_m, 0.0), std::max(up_m, 0.0)) : most_m;
}

double to_cylinder_m(const Fence& fence, const Eigen::Vector3d& at_m) {
  const Eigen::Vector3d off_m = at_m - fence.centre_m;
  return outside_m(length_m(off_m.x(), off_m.y()) - fence.half_m.x(),
                   std::abs(off_m.z()) - fence.half_m.z());
}

double to_box_m(const Fence& fence, const Eigen::Vector3d& at_m) {
  const Eigen::Vector3d off_m = at_m - fence.centre_m;
  const double level = length_m(fence.normal.x(), fence.normal.y());
  const Eigen::Vector2d way =
      level > 0.0 ? Eigen::Vector2d(fence.normal.head<2>() / level) : Eigen::Vector2d::UnitX();
  const double first_m = way.x() * off_m.x() + way.y() * off_m.y();
  const double second_m = way.x() * off_m.y() - way.y() * off_m.x();
  const double level_m =
      outside_m(std::abs(first_m) - fence.half_m.x(), std::abs(second_m) - fence.half_m.y());
  return outside_m(level_m, std::abs(off_m.z()) - fence.half_m.z());
}

/// Of a grid's surface, by its four heights round a place.
double grid_height_m(const DesignSurface& of, const Eigen::Vector2d& at_m) {
  const double turn_rad = std::atan2(of.sine, of.cosine);
  const double cells_x =
      (of.machine_m.x() + at_m.norm() * std::cos(std::atan2(at_m.y(), at_m.x()) + turn_rad)) /
      of.step_m;
  const double cells_y =
      (of.machine_m.y() + at_m.norm() * std::sin(std::atan2(at_m.y(), at_m.x()) + turn_rad)) /
      of.step_m;
  double sum = 0.0;
  for (int k = 0; k < 4; ++k) {
    const double column = std::floor(cells_x) + (k % 2);
    const double row = std::floor(cells_y) + (k / 2);
    if (!(column >= 0.0 && row >= 0.0 && column < of.columns && row < of.rows)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const std::int16_t height =
        of.height[static_cast<int>(row) * of.columns + static_cast<int>(column)];
    if (height == DesignSurface::kNone) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const double share = (1.0 - std::abs(cells_x - column)) * (1.0 - std::abs(cells_y - row));
    sum += share * height;
  }
  return of.base_m + DesignSurface::kUnit_m * sum;
}

double distance_m(const Fence& fence, const Eigen::Vector3d& at_m) {
  switch (fence.shape) {
    case FenceShape::kSurface:
      // By edge_over_m.
      return std::numeric_limits<double>::quiet_NaN();
    case FenceShape::kBox:
      return to_box_m(fence, at_m);
    case FenceShape::kCylinder:
      return to_cylinder_m(fence, at_m);
    case FenceShape::kPlane:
      break;
  }
  return fence.offset_m - at_m.dot(fence.normal);
}

bool stands_on(const Fence& fence) {
  return fence.shape == FenceShape::kPlane && std::abs(fence.normal.z()) > 0.5;
}

}  // namespace

FenceTruth::FenceTruth(const plant::ExcavatorPlant& plant)
    : ahead_(heading(plant.swing_rad())), rocking_(plant.rocking()) {
  const plant::ExcavatorPlantProfile& profile = plant.profile();
  const ExcavatorGeometry& geometry = profile.machine.geometry;
  const ExcavatorBody& body = geometry.body;
  known_ = body.known();
  const plant::JointArray& joint = plant.joint_angles_rad();
  const double boom_rad = joint[kBoom];
  const double arm_rad = boom_rad + joint[kArm];
  const double bucket_rad = arm_rad + joint[kBucket];
  const Eigen::Vector2d foot_m = geometry.boom_foot_m;
  const Eigen::Vector2d bend_m = foot_m + plant::Rotation::by(boom_rad).apply(body.boom_bend_m);
  const Eigen::Vector2d arm_pin_m = foot_m + geometry.boom_length_m * heading(boom_rad);
  const Eigen::Vector2d bucket_pin_m = arm_pin_m + geometry.arm_length_m * heading(arm_rad);
  const Eigen::Vector2d edge_m = bucket_pin_m + geometry.bucket_length_m * heading(bucket_rad);
  if (!known_) {
    for (const Eigen::Vector2d& at_m : {arm_pin_m, bucket_pin_m, edge_m}) {
      links_.push_back({in_ground(at_m, 0.0), 0.0});
    }
    edge_.push_back(links_.back());
    return;
  }
  add_link(foot_m, bend_m, body.boom_radius_m);
  add_link(bend_m, arm_pin_m, body.boom_radius_m);
  add_link(arm_pin_m, bucket_pin_m, body.arm_radius_m);
  add_bucket(profile.bucket, bucket_pin_m, edge_m, std::atan2(0.0, -1.0) + bucket_rad);
  if (body.counterweight.known()) {
    add_counterweight(body.counterweight);
  }
}

double FenceTruth::left_m(const Fence& fence) const {
  double least_m = std::numeric_limits<double>::infinity();
  const auto look = [&](const std::vector<Ball>& balls) {
    for (const Ball& ball : balls) {
      least_m = std::min(least_m, distance_m(fence, ball.at_m) - ball.radius_m);
    }
  };
  if (fence.is_surface()) {
    return edge_over_m(
        [&](const Eigen::Vector2d& at_m) { return grid_height_m(*fence.surface, at_m); });
  }
  if (fence.guard == FenceGuard::kTeeth) {
    look(edge_);
    return least_m;
  }
  look(links_);
  if (!stands_on(fence)) {
    look(tail_);
  }
  return least_m;
}

double FenceTruth::edge_over_m(
    const std::function<double(const Eigen::Vector2d&)>& height_m) const {
  constexpr double kBeside_m = 0.01;
  double least_m = std::numeric_limits<double>::infinity();
  for (const Ball& ball : edge_) {
    const Eigen::Vector2d at_m = ball.at_m.head<2>();
    const double over_m = ball.at_m.z() - height_m(at_m);
    const auto slope = [&](const Eigen::Vector2d& way_m) {
      const double rise = (height_m(at_m + way_m) - height_m(at_m - way_m)) / (2.0 * kBeside_m);
      return std::isnan(rise) ? 0.0 : rise;
    };
    const double steep = std::hypot(slope({kBeside_m, 0.0}), slope({0.0, kBeside_m}));
    // Not a number leaves it.
    least_m = std::fmin(least_m, over_m / std::hypot(1.0, steep));
  }
  return least_m;
}

void FenceTruth::add_link(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m,
                          double radius_m) {
  for (int i = 0; i <= kAlong; ++i) {
    links_.push_back({in_ground(from_m + share(i, kAlong) * (to_m - from_m), 0.0), radius_m});
  }
}

void FenceTruth::add_bucket(const plant::BucketShape& bucket, const Eigen::Vector2d& pin_m,
                            const Eigen::Vector2d& edge_m, double attitude_rad) {
  const Eigen::Vector2d heel_m = edge_m + bucket.floor_m * heading(attitude_rad - bucket.floor_rad);
  for (int across = 0; across <= kAcross; ++across) {
    const double left_m = bucket.width_m * (share(across, kAcross) - 0.5);
    edge_.push_back({in_ground(edge_m, left_m), 0.0});
    for (int i = 0; i <= kTriangle; ++i) {
      for (int k = 0; k + i <= kTriangle; ++k) {
        const Eigen::Vector2d at_m = edge_m + share(i, kTriangle) * (heel_m - edge_m) +
                                     share(k, kTriangle) * (pin_m - edge_m);
        links_.push_back({in_ground(at_m, left_m), 0.0});
      }
    }
  }
}

void FenceTruth::add_counterweight(const Counterweight& weight) {
  const double aside_m = weight.half_width_m - weight.corner_m;
  const double from_axis_m = weight.radius_m - weight.corner_m;
  const double behind_m = std::sqrt(std::max(0.0, from_axis_m * from_axis_m - aside_m * aside_m));
  for (int i = 0; i <= kRear; ++i) {
    for (int k = 0; k <= kRearUp; ++k) {
      const double up_m = weight.low_m + share(k, kRearUp) * (weight.high_m - weight.low_m);
      const double left_m = aside_m * (2.0 * share(i, kRear) - 1.0);
      // Balls stay within its height.
      const double inside_m = std::min(up_m - weight.low_m, weight.high_m - up_m);
      const double radius_m = std::min(weight.corner_m, std::max(inside_m, 0.0));
      tail_.push_back({in_ground({-behind_m, up_m}, left_m), radius_m});
    }
  }
}

Eigen::Vector3d FenceTruth::in_ground(const Eigen::Vector2d& in_plane_m, double left_m) const {
  const Eigen::Vector2d at_m = rocking_ != nullptr ? rocking_->on_ground(in_plane_m) : in_plane_m;
  return {at_m.x() * ahead_.x() - left_m * ahead_.y(), at_m.x() * ahead_.y() + left_m * ahead_.x(),
          at_m.y()};
}

}  // namespace graben::runs
