#pragma once
/// Something hard in the bucket's way that holds for a while and then lets go (Kim 5.2).

#include <Eigen/Core>

namespace graben::plant {

/// A rock as a stiff damped wall, with friction along it, from its first touch until it comes
/// loose.
struct ObstacleProfile {
  Eigen::Vector2d point_m = Eigen::Vector2d::Zero();  ///< A point of its face.
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< Out of the rock, towards the bucket.
  double stiffness_npm = 0.0;
  double damping_nspm = 0.0;  ///< On the way in only.
  double friction = 0.0;      ///< Of the force along the face to that across it.
  double size_m = 0.0;        ///< Along the face to each side of its point, and behind it.
  double hold_s = 0.0;        ///< From the first touch.
};

class Obstacle {
 public:
  Obstacle(const ObstacleProfile& profile, double step_s) : profile_(profile), step_s_(step_s) {}

  /// Force on the tip over the next step, N; to be called once a step.
  Eigen::Vector2d step(const Eigen::Vector2d& tip_m);

  [[nodiscard]] bool touched() const { return held_s_ > 0.0; }
  [[nodiscard]] bool gone() const { return held_s_ >= profile_.hold_s; }

 private:
  ObstacleProfile profile_;
  double step_s_;
  double held_s_ = 0.0;
  double last_depth_m_ = 0.0;
  double anchor_m_ = 0.0;  ///< Along the face: where the friction's spring is relaxed.
};

}  // namespace graben::plant
