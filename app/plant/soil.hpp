#pragma once
/// What the ground does to the bucket tip (Kim 5.1).

#include <Eigen/Core>
#include <cstdint>

#include "app/plant/random.hpp"

namespace graben::plant {

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
