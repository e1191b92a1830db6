// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A body whose motion is known, and what a gyro and an accelerometer on it show.

#include <algorithm>
#include <cmath>
#include <random>

#include "firmware/estimation/link_angle.hpp"

namespace graben::test::of_body {

inline constexpr double kPeriod_s = 0.01;
inline constexpr double kGravity = 9.80665;
inline constexpr AngleNoise kNoise{1.75e-3, 3.5e-3, 0.3};

inline Eigen::Vector2d turned(double x, double y, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * x - s * y, s * x + c * y};
}

/// A pendulum arm of 2 m about a fixed pin, the sensor at its end.
struct Body {
  double middle_rad = 0.3;
  double swing_rad = 0.0;
  double omega_radps = 3.0;
  double bias_radps = 0.0;
  double noise = 0.0;
  double offset_mps2 = 0.0;  ///< Of the accelerometer, across the arm.
  /// What its pin goes to and fro by, at 6 Hz, and nobody knows.
  Eigen::Vector2d sways_mps2 = Eigen::Vector2d::Zero();
  std::mt19937 engine{7};
  std::normal_distribution<double> normal{0.0, 1.0};

  /// It stands for a second, then goes to and fro.
  [[nodiscard]] double phase(double t) const { return omega_radps * std::max(0.0, t - 1.0); }
  [[nodiscard]] double angle(double t) const {
    return middle_rad + swing_rad * (1.0 - std::cos(phase(t)));
  }
  [[nodiscard]] double rate(double t) const { return swing_rad * omega_radps * std::sin(phase(t)); }
  [[nodiscard]] double change(double t) const {
    return t < 1.0 ? 0.0 : swing_rad * omega_radps * omega_radps * std::cos(phase(t));
  }
  [[nodiscard]] Eigen::Vector2d acceleration(double t) const {
    const Eigen::Vector2d arm = turned(2.0, 0.0, angle(t));
    return change(t) * Eigen::Vector2d(-arm.y(), arm.x()) - rate(t) * rate(t) * arm;
  }
  AngleReading reading(double t) {
    const Eigen::Vector2d force = acceleration(t) +
                                  std::sin(37.7 * std::max(0.0, t - 1.0)) * sways_mps2 +
                                  Eigen::Vector2d(0.0, kGravity);
    return {kPeriod_s, rate(t) + bias_radps + noise * kNoise.rate_radps * normal(engine),
            turned(force.x(), force.y(), -angle(t)) +
                noise * kNoise.force_mps2 * Eigen::Vector2d(normal(engine), normal(engine)) +
                Eigen::Vector2d(0.0, offset_mps2),
            0.0};
  }
};

/// Worst error after `from_s`, told `known` of the body's acceleration.
inline double worst_rad(Body body, double from_s, double to_s, bool at_rest, bool known,
                        LinkAngle& state) {
  double worst = 0.0;
  begin_angle(kNoise, body.reading(0.0), state);
  for (int i = 1; i * kPeriod_s < to_s; ++i) {
    const double t = i * kPeriod_s;
    carry_angle(kNoise, body.reading(t), at_rest, state);
    if (state.runs()) {
      correct_angle(
          kNoise,
          known ? body.acceleration(t - kPeriod_s) : Eigen::Vector2d(Eigen::Vector2d::Zero()),
          state);
    }
    if (t > from_s) {
      worst = std::max(worst, std::abs(state.angle_rad - body.angle(t)));
    }
  }
  return worst;
}

}  // namespace graben::test::of_body
