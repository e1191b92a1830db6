// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Velocity field of the digging task: which way the bucket should move at each pose, (1) and (3).

#include <Eigen/Core>
#include <array>

#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/excavator/motion/field/rounded_rectangle.hpp"

namespace graben {

/// v_b^d of (1): tip velocity and attitude rate.
struct TipVelocity {
  Eigen::Vector2d linear_mps = Eigen::Vector2d::Zero();
  double attitude_radps = 0.0;
};

/// Near the path a contour field in task space; far from it a straight approach in stroke space.
///
/// The contour field is the task's speed along the path, halved at a distance of slow_error, plus
/// distance / convergence_length of it towards the path; never more than the task's speed in all.
/// The attitude follows the path's. It is blind to the
/// edge of the work space. The approach is not: it heads for the nearest of kSamples path poses in
/// stroke space, where the work space is a box and so every straight line between two of its points
/// stays inside. Moving straight at the nearest sample keeps it the nearest, so the approach always
/// arrives, from any pose. Between approach_inner_m and approach_outer_m of stroke distance the two
/// are blended smoothly.
class DigField {
 public:
  /// Poses of the path that the approach may head for. [-; size: of the table of strokes]
  static constexpr int kSamples = 96;

  DigField(const ExcavatorProfile& profile, const ExcavatorKinematics& kinematics);

  /// kOk if every sample of the path lies in the work space; else what stands in the way of the
  /// first that doesn't.
  [[nodiscard]] ReachStatus reach() const { return reach_; }
  /// Tip of the sample that `reach` speaks of.
  [[nodiscard]] const TipPose& unreached() const { return unreached_; }

  /// The contour field alone; defined at every pose.
  [[nodiscard]] TipVelocity contour(const TipPose& pose) const;

  /// The whole field at a state whose status is kOk: V_L^d of (3), per cylinder. Speed is that of
  /// the task times `speed_override_ratio` (0 .. 1).
  [[nodiscard]] Eigen::Vector3d wanted(const KinematicState& state,
                                       double speed_override_ratio) const;

  [[nodiscard]] const RoundedRectangle& path() const { return path_; }

 private:
  [[nodiscard]] Eigen::Vector3d approach(const KinematicState& state,
                                         const Eigen::Vector3d& to_nearest_m) const;

  RoundedRectangle path_;
  double speed_mps_;
  ControlProfile control_;
  ReachStatus reach_ = ReachStatus::kOk;
  TipPose unreached_;
  std::array<Eigen::Vector3d, kSamples> sample_strokes_m_;
};

}  // namespace graben
