#include "app/plant/soil.hpp"

#include <algorithm>
#include <cmath>

#include "app/plant/turn.hpp"

namespace graben::plant {
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
