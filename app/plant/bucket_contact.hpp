// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Forces on the bucket: the ground (Kim 5.1), and something hard in its way (Kim 5.2).

#include <Eigen/Core>
#include <cstdint>

#include "app/plant/random.hpp"

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

/// The rock of a profile, in time.
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

/// Resistance in the direction of +x and +y wherever the tip is below ground.
struct SoilProfile {
  double ground_y_m = 0.0;
  Eigen::Vector2d bias_n = Eigen::Vector2d::Zero();
  double ramp_m = 0.0;      ///< Depth at which the resistance is whole; grows linearly to it.
  double sine_ratio = 0.0;  ///< Amplitude of the sinusoid, of the bias.
  double sine_hz = 0.0;
  double random_ratio = 0.0;  ///< Standard deviation of the random part, of the bias.
  double random_hz = 0.0;     ///< Corner of its first-order spectrum.
};

/// Random part: one Ornstein-Uhlenbeck process for both directions, on a raster of its own, so that
/// the simulation's step does not change it.
class Soil {
 public:
  Soil(const SoilProfile& profile, std::uint64_t seed, double step_s);

  /// Force on the tip over the next step, N; to be called once a step.
  Eigen::Vector2d step(const Eigen::Vector2d& tip_m);

 private:
  SoilProfile profile_;
  Random random_;
  double step_s_;
  double decay_;
  double kick_;
  double noise_;
  long steps_ = 0;
  long ticks_ = 0;  ///< Of the raster.
};

}  // namespace graben::plant
