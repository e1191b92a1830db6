// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the simulated machine's outline truly is before a task's fences: points all over it, by
/// the plant's joints. Shares no formula with the controller's fences.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "app/plant/excavator_plant.hpp"
#include "firmware/excavator/fences/fence.hpp"

namespace graben::runs {

class FenceTruth {
 public:
  /// As the plant stands now. The outline is that of the profile (ExcavatorBody), the bucket the
  /// plant's own.
  explicit FenceTruth(const plant::ExcavatorPlant& plant);

  /// Least distance of any point to the fence, m; negative: beyond it, or in it. Of a design
  /// surface that of the edge; of heights on a grid only where it has some, else infinite. The
  /// counterweight counts before walls, boxes and cylinders.
  [[nodiscard]] double left_m(const Fence& fence) const;

  /// Least distance of any point of the edge over heights of the ground frame, across them; not a
  /// number counts as none there.
  [[nodiscard]] double edge_over_m(
      const std::function<double(const Eigen::Vector2d&)>& height_m) const;

 private:
  /// A ball of the outline.
  struct Ball {
    Eigen::Vector3d at_m;
    double radius_m;
  };

  void add_link(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, double radius_m);
  void add_bucket(const plant::BucketShape& bucket, const Eigen::Vector2d& pin_m,
                  const Eigen::Vector2d& edge_m, double attitude_rad);
  void add_counterweight(const Counterweight& weight);
  /// x ahead of the swing axis, y above the ground, and to the left of the machine's plane.
  [[nodiscard]] Eigen::Vector3d in_ground(const Eigen::Vector2d& in_plane_m, double left_m) const;

  Eigen::Vector2d ahead_;              ///< Where the swing is turned, in plan.
  const plant::RockingBase* rocking_;  ///< Of the plant; null: firm ground.
  bool known_;  ///< The controller knows the outline; else teeth and pins are all that counts.
  std::vector<Ball> edge_;
  std::vector<Ball> links_;  ///< With the bucket.
  std::vector<Ball> tail_;
};

}  // namespace graben::runs
