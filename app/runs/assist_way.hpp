// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The way of an operator's edge along a design that is tried, in the plane of the boom.

#include <Eigen/Core>
#include <memory>

#include "app/runs/assist_run.hpp"
#include "firmware/excavator/fences/fence.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"

namespace graben::runs {

/// From the boom foot's pin. On a plane by its length, on another ground by its level length.
struct Way {
  Eigen::Vector2d near_m;
  Eigen::Vector2d far_m;
  double attitude_rad = 0.0;
  Fence fence;
  std::shared_ptr<const AssistGround> ground;  ///< Null: a plane.
  Eigen::Vector2d foot_m = Eigen::Vector2d::Zero();
  double half_edge_m = 0.0;

  [[nodiscard]] double length_m() const { return (far_m - near_m).norm(); }
  [[nodiscard]] Eigen::Vector2d along() const { return (far_m - near_m) / length_m(); }
  /// With the edge's middle so high that none of its corners is under the true ground.
  [[nodiscard]] TipPose at(double out_m) const;
  /// Outwards, along the ground, of length 1.
  [[nodiscard]] Eigen::Vector2d tangent(double out_m) const;
};

/// With the bucket held so that the cylinders' ends are farthest all along it. Throws
/// std::runtime_error where the machine can't hold its bucket there.
[[nodiscard]] Way way_of(const ExcavatorProfile& profile, const AssistOptions& options);

/// Fastest, by `length_m`, along the way that drives and pumps allow with the arm's lever at
/// `lever`, 1: full. What regenerates takes no flow from its pump.
[[nodiscard]] double fastest_mps(const ExcavatorProfile& profile,
                                 const ExcavatorKinematics& kinematics, const Way& way,
                                 double out_m, double lever);

}  // namespace graben::runs
