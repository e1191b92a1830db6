// SPDX-License-Identifier: Apache-2.0
#include "app/plant/bucket_contact.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben::plant {

Eigen::Vector2d Obstacle::step(const Eigen::Vector2d& tip_m) {
  if (touched()) {
    held_s_ += step_s_;
  }
  const Eigen::Vector2d along_face(-profile_.normal.y(), profile_.normal.x());
  const Eigen::Vector2d from_point = tip_m - profile_.point_m;
  const double depth_m = -from_point.dot(profile_.normal);
  const double along_m = from_point.dot(along_face);
  const double sinking_mps = (depth_m - last_depth_m_) / step_s_;
  last_depth_m_ = depth_m;
  const bool inside =
      depth_m > 0.0 && depth_m < profile_.size_m && std::abs(along_m) < profile_.size_m;
  if (gone() || !inside) {
    anchor_m_ = along_m;
    return Eigen::Vector2d::Zero();
  }
  held_s_ = std::max(held_s_, step_s_);
  const double across_n =
      profile_.stiffness_npm * depth_m + profile_.damping_nspm * std::max(0.0, sinking_mps);
  // A spring along the face, whose anchor slips where the force would be more than friction holds.
  const double most_m = profile_.friction * across_n / profile_.stiffness_npm;
  anchor_m_ = std::clamp(anchor_m_, along_m - most_m, along_m + most_m);
  return across_n * profile_.normal + profile_.stiffness_npm * (anchor_m_ - along_m) * along_face;
}

namespace {
constexpr double kTick_s = 1e-3;
}  // namespace

Soil::Soil(const SoilProfile& profile, std::uint64_t seed, double step_s)
    : profile_(profile),
      random_(seed, Draw::kSoil),
      step_s_(step_s),
      decay_(std::exp(-kTwoPi * profile.random_hz * kTick_s)),
      kick_(std::sqrt(1.0 - decay_ * decay_)),
      noise_(random_.normal()) {}

Eigen::Vector2d Soil::step(const Eigen::Vector2d& tip_m) {
  const double time_s = static_cast<double>(++steps_) * step_s_;
  // Half a step more, so that rounding does not decide at a tick.
  for (; static_cast<double>(ticks_) * kTick_s < time_s - 0.5 * step_s_; ++ticks_) {
    noise_ = decay_ * noise_ + kick_ * random_.normal();
  }
  const double depth_m = profile_.ground_y_m - tip_m.y();
  if (depth_m <= 0.0) {
    return Eigen::Vector2d::Zero();
  }
  const double share = profile_.ramp_m > 0.0 ? std::min(1.0, depth_m / profile_.ramp_m) : 1.0;
  const double swing = 1.0 + profile_.sine_ratio * std::sin(kTwoPi * profile_.sine_hz * time_s) +
                       profile_.random_ratio * noise_;
  return share * std::max(0.0, swing) * profile_.bias_n;
}

}  // namespace graben::plant
