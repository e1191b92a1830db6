// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/field/dig_field.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// 0 at `from`, 1 at `to`, with zero slope at both.
double smooth_step(double value, double from, double to) {
  const double share = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return share * share * (3.0 - 2.0 * share);
}

}  // namespace

DigField::DigField(const ExcavatorProfile& profile, const ExcavatorKinematics& kinematics)
    : path_(profile.dig_path), speed_mps_(profile.dig_speed_mps), control_(profile.control) {
  for (int k = 0; k < kSamples; ++k) {
    const PathPoint point = path_.at_share(static_cast<double>(k) / kSamples);
    const TipPose pose = {point.position_m.x(), point.position_m.y(), point.attitude_rad};
    const StrokeResult strokes = kinematics.strokes_from_pose(pose);
    sample_strokes_m_[static_cast<unsigned>(k)] = strokes.strokes_m;
    if (strokes.status != ReachStatus::kOk && reach_ == ReachStatus::kOk) {
      reach_ = strokes.status;
      unreached_ = pose;
    }
  }
}

TipVelocity DigField::contour(const TipPose& pose) const {
  const Eigen::Vector2d tip(pose.x_m, pose.y_m);
  const PathPoint goal = path_.closest(tip);
  const Eigen::Vector2d to_goal = goal.position_m - tip;
  const double slowed = 1.0 / (1.0 + (to_goal / control_.slow_error_m).squaredNorm());
  const Eigen::Vector2d direction = slowed * goal.tangent + to_goal / control_.convergence_length_m;
  TipVelocity velocity;
  velocity.linear_mps = speed_mps_ * direction / std::max(1.0, direction.norm());
  const double error_rad = wrap_near(goal.attitude_rad - pose.attitude_rad, 0.0);
  const double wanted_radps = goal.attitude_slope_radpm * velocity.linear_mps.dot(goal.tangent) +
                              control_.attitude_gain_ps * error_rad;
  velocity.attitude_radps =
      std::clamp(wanted_radps, -control_.attitude_rate_max_radps, control_.attitude_rate_max_radps);
  return velocity;
}

Eigen::Vector3d DigField::approach(const KinematicState& state,
                                   const Eigen::Vector3d& to_nearest_m) const {
  const Eigen::Vector3d direction = to_nearest_m.normalized();
  const Eigen::Vector3d tip = state.jacobian * direction;
  // As fast as the slowest of the task's tip speed, the attitude's and the cylinder's own limit has
  // it.
  const double unit_time = std::max(
      {tip.head<2>().norm() / speed_mps_, std::abs(tip.z()) / control_.attitude_rate_max_radps,
       direction.cwiseAbs().maxCoeff() / control_.approach_speed_mps});
  return direction / unit_time;
}

Eigen::Vector3d DigField::wanted(const KinematicState& state, double speed_override_ratio) const {
  Eigen::Vector3d to_nearest_m = sample_strokes_m_[0] - state.strokes_m;
  for (const Eigen::Vector3d& sample : sample_strokes_m_) {
    const Eigen::Vector3d to_sample = sample - state.strokes_m;
    if (to_sample.squaredNorm() < to_nearest_m.squaredNorm()) {
      to_nearest_m = to_sample;
    }
  }
  const double far =
      smooth_step(to_nearest_m.norm(), control_.approach_inner_m, control_.approach_outer_m);

  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  if (far < 1.0) {
    const TipVelocity field = contour(state.tip);
    velocity_mps = (1.0 - far) * (state.jacobian_inverse * Eigen::Vector3d(field.linear_mps.x(),
                                                                           field.linear_mps.y(),
                                                                           field.attitude_radps));
  }
  if (far > 0.0) {
    velocity_mps += far * approach(state, to_nearest_m);
  }
  return speed_override_ratio * velocity_mps;
}

}  // namespace graben
