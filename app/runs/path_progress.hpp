// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Place of a run on its path.

#include <cmath>

#include "firmware/core/time.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/excavator/motion/field/rounded_rectangle.hpp"

namespace graben::runs {

/// The pose is on the path, attitude and all, because an approach may cross the path long before it
/// has arrived. Not a number is not on it.
[[nodiscard]] inline bool near_path(const RoundedRectangle& path, const Eigen::Vector2d& tip_m,
                                    double attitude_rad) {
  constexpr double kReached_m = 0.02;
  constexpr double kReached_rad = 0.07;
  const PathPoint closest = path.closest(tip_m);
  const double turn_rad = wrap_near(closest.attitude_rad - attitude_rad, 0.0);
  return (closest.position_m - tip_m).norm() <= kReached_m && std::abs(turn_rad) <= kReached_rad;
}

/// The path counts as reached when the pose has stayed near for half a second and 0.2 m of it: at a
/// twentieth of the speed the last 20 mm of an approach take seconds. From there on the way along
/// it adds up.
class PathProgress {
 public:
  /// `path` must outlive this.
  PathProgress(const RoundedRectangle& path, double loops) : path_(path), loops_(loops) {}

  void update(const Eigen::Vector2d& tip_m, bool near, TimeUs now_us) {
    travelled_m_ += begun_ ? (tip_m - last_tip_m_).dot(path_.closest(tip_m).tangent) : 0.0;
    begun_ = true;
    last_tip_m_ = tip_m;
    if (on_path_) {
      return;
    }
    if (!near) {
      near_since_us_ = now_us;
      travelled_m_ = 0.0;
    }
    if (now_us - near_since_us_ >= kReachedFor_us && travelled_m_ >= kReachedWay_m) {
      on_path_ = true;
      travelled_m_ = 0.0;
    }
  }
  [[nodiscard]] bool on_path() const { return on_path_; }
  /// Of all loops together.
  [[nodiscard]] double share() const { return travelled_m_ / (loops_ * path_.length_m()); }

 private:
  static constexpr TimeUs kReachedFor_us = 500 * kMillisecondUs;
  static constexpr double kReachedWay_m = 0.2;

  const RoundedRectangle& path_;
  double loops_;
  bool begun_ = false;
  bool on_path_ = false;
  TimeUs near_since_us_ = 0;
  double travelled_m_ = 0.0;
  Eigen::Vector2d last_tip_m_ = Eigen::Vector2d::Zero();
};

}  // namespace graben::runs
