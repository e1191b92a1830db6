// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The way of an operator's edge along a design that is tried, in the plane of the boom.

#include <Eigen/Core>
#include <array>
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

/// Fastest along a way that the machine's hydraulics allow while the arm's lever stands still: the
/// lever's own speed of the arm, or less where a pump's flow, less what its bypass and its leak
/// take at the pressure that the hardest load needs, or a fully open spool lets no more through.
/// Loads are those of the true machine at rest in each place; there is no reserve and no
/// acceleration.
class FastestByFlow {
 public:
  /// `lever`: of the arm, above 0, 1: full; both ways along are looked at.
  FastestByFlow(const machines::SimulatedExcavator& machine, const Way& way, double lever);

  /// By `length_m`; `inwards`: to the machine.
  [[nodiscard]] double mps(double out_m, bool inwards) const;

 private:
  static constexpr std::size_t kPlaces = 24;
  double step_m_ = 0.0;
  std::array<std::array<double, kPlaces + 1>, 2> mps_{};
};

}  // namespace graben::runs
