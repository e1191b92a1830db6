#include "app/runs/path_progress.hpp"

#include <cmath>

#include "firmware/excavator/kinematics/excavator_kinematics.hpp"

namespace graben::runs {
namespace {
constexpr double kReached_m = 0.02;
constexpr double kReached_rad = 0.07;
constexpr TimeUs kReachedFor_us = 500 * kMillisecondUs;
}  // namespace

bool near_path(const RoundedRectangle& path, const Eigen::Vector2d& tip_m, double attitude_rad) {
  const PathPoint closest = path.closest(tip_m);
  const double turn_rad = wrap_near(closest.attitude_rad - attitude_rad, 0.0);
  return (closest.position_m - tip_m).norm() <= kReached_m && std::abs(turn_rad) <= kReached_rad;
}

void PathProgress::update(const Eigen::Vector2d& tip_m, bool near, TimeUs now_us) {
  if (!on_path_) {
    near_since_us_ = near ? near_since_us_ : now_us;
    on_path_ = now_us - near_since_us_ >= kReachedFor_us;
  } else {
    travelled_m_ += (tip_m - last_tip_m_).dot(path_.closest(tip_m).tangent);
  }
  last_tip_m_ = tip_m;
}

double PathProgress::share() const { return travelled_m_ / (loops_ * path_.length_m()); }

}  // namespace graben::runs
