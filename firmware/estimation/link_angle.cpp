// SPDX-License-Identifier: Apache-2.0
#include "firmware/estimation/link_angle.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/estimation/tuning.hpp"
#include "firmware/numeric/constants.hpp"
#include "firmware/numeric/triangle.hpp"

namespace graben {
namespace {

double square(double value) { return value * value; }

Eigen::Vector2d turned_by(const Eigen::Vector2d& v, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

double direction(const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); }

/// A measured error of the bias, of the angle or of both: what each state takes of it.
void take(double error, double of_angle, double of_bias, double variance, LinkAngle& state) {
  const double to_angle = state.angle_variance * of_angle + state.covariance * of_bias;
  const double to_bias = state.covariance * of_angle + state.bias_variance * of_bias;
  const double whole = of_angle * to_angle + of_bias * to_bias + variance;
  state.angle_rad += to_angle / whole * error;
  state.bias_radps += to_bias / whole * error;
  state.angle_variance -= to_angle * to_angle / whole;
  state.covariance -= to_angle * to_bias / whole;
  state.bias_variance -= to_bias * to_bias / whole;
}

}  // namespace

double LinkAngle::ahead_rad(double time_s) const {
  // By the rate alone: of what shakes faster than it can be foretold the acceleration makes more.
  return angle_rad + (last.rate_radps - bias_radps) * time_s;
}

double LinkAngle::sd_rad(double time_s) const {
  const double variance =
      angle_variance - 2.0 * covariance * time_s + bias_variance * time_s * time_s;
  return std::sqrt(std::max(0.0, variance));
}

bool LinkAngle::contradicts() const {
  return jump_held_s > 0.0 || std::abs(off_rad) > kAngleContradicts_rad;
}

void begin_angle(const AngleNoise& noise, const AngleReading& reading, LinkAngle& state) {
  // What is known of the gyro stays true.
  const double bias_radps = state.bias_radps;
  const double bias_variance = state.bias_variance;
  const double jump_held_s = state.jump_held_s;
  state = {};
  state.jump_held_s = jump_held_s;
  state.bias_radps = bias_radps;
  state.bias_variance = bias_variance > 0.0 ? bias_variance : square(noise.bias_radps);
  if (!(reading.force_mps2.norm() > kAngleLeastForce_mps2)) {
    return;
  }
  state.readings = 1;
  state.angle_rad = wrap_near(0.5 * kPi - direction(reading.force_mps2), 0.0);
  state.angle_variance = square(noise.force_mps2 / kStandardGravity_mps2);
  state.last = reading;
}

void carry_angle(const AngleNoise& noise, const AngleReading& reading, bool at_rest,
                 LinkAngle& state) {
  const double period_s = reading.period_s;
  const AngleReading last = state.last;
  const double before_rad = state.angle_rad;
  state.angle_rad += (0.5 * (last.rate_radps + reading.rate_radps) - state.bias_radps) * period_s;
  state.angle_variance += period_s * (period_s * state.bias_variance - 2.0 * state.covariance) +
                          square(noise.rate_radps * period_s);
  state.covariance -= period_s * state.bias_variance;
  state.bias_variance += square(kGyroBiasWander) * period_s;
  const double most_radps = kRestMostDeviations * std::hypot(noise.rate_radps, noise.bias_radps);
  if (at_rest && std::abs(reading.rate_radps) < most_radps) {
    take(reading.rate_radps - state.bias_radps, 0.0, 1.0, square(noise.rate_radps), state);
  }
  state.readings = std::min(state.readings + 1, 3);
  state.then = {before_rad, last.rate_radps - state.bias_radps,
                (reading.rate_radps - state.before_radps) / (period_s + last.period_s),
                last.force_mps2, last.turning_radps};
  state.before_radps = last.rate_radps;
  state.last = reading;
}

void watch_gyro(const AngleNoise& noise, const Eigen::Vector2d& at_m,
                const Eigen::Vector2d& acceleration_mps2, LinkAngle& state) {
  const double lever_m = at_m.norm();
  if (!(lever_m > kGyroLeastLever_m)) {
    return;
  }
  const Eigen::Vector2d expected = turned_by(
      acceleration_mps2 + Eigen::Vector2d(0.0, kStandardGravity_mps2), -state.then.angle_rad);
  const Eigen::Vector2d across(-at_m.y() / lever_m, at_m.x() / lever_m);
  const double whole_mps2 = across.dot(expected - state.then.force_mps2);
  const double period_s = state.last.period_s;
  // An accelerometer's offset stays; a jump does not. The mean of what there is, until it is long.
  state.steady_s = std::min(state.steady_s + period_s, kGyroSteadyTime_s);
  state.steady_mps2 += std::min(1.0, period_s / state.steady_s) * (whole_mps2 - state.steady_mps2);
  const double more_mps2 = whole_mps2 - state.steady_mps2;
  state.jumps_radps += period_s * more_mps2 / lever_m -
                       std::min(1.0, period_s / kGyroJumpTime_s) * state.jumps_radps;
  state.jumped_radps +=
      std::min(1.0, period_s / kGyroShakeTime_s) * (state.jumps_radps - state.jumped_radps);
  // A gyro's jump is two readings of what it is not like; what hits the link goes on.
  const double shaken = std::max(square(noise.force_mps2), state.shaken);
  state.shaken = shaken + std::min(1.0, period_s / kGyroShakenTime_s) *
                              (std::min(square(more_mps2), kGyroShakenMost * shaken) - shaken);
  const double noise_radps = std::sqrt(0.5 * shaken * period_s * kGyroJumpTime_s) / lever_m;
  const double most_radps = std::max(kGyroJump_radps, kGyroJumpDeviations * noise_radps);
  // Whether it still is off shows only by what it turns meanwhile: held until that has shown.
  state.jump_held_s = std::abs(state.jumped_radps) > most_radps
                          ? kGyroJumpHeld_s
                          : std::max(0.0, state.jump_held_s - period_s);
}

void correct_angle(const AngleNoise& noise, const Eigen::Vector2d& acceleration_mps2,
                   LinkAngle& state) {
  const Eigen::Vector2d& shown = state.then.force_mps2;
  const Eigen::Vector2d expected = acceleration_mps2 + Eigen::Vector2d(0.0, kStandardGravity_mps2);
  const double least = std::min(shown.norm(), expected.norm());
  if (!(least > kAngleLeastForce_mps2)) {
    return;
  }
  const double angle_rad = direction(expected) - direction(shown);
  const double error_rad = wrap_near(angle_rad - state.then.angle_rad, 0.0);
  // Whatever hits the link is in the force and in no rate. How much the size of the force is not as
  // expected tells how wrong its direction may be.
  const double noise_mps2 = square(noise.force_mps2);
  const double wrong_mps2 = square(kLinkAccelerationOff * acceleration_mps2.norm());
  const double hit_mps2 = square(shown.norm() - expected.norm());
  const double calm = std::max(kAngleLeastWeight,
                               noise_mps2 / (noise_mps2 + wrong_mps2 + kAngleHitWeight * hit_mps2));
  state.off_rad +=
      calm * std::min(1.0, state.last.period_s / kAngleOffTime_s) * (error_rad - state.off_rad);
  // What the body stands on is shaken too, which nobody knows. Were each reading weighed by its own
  // hit, one half of every swing would count more than the other: they weigh alike, and only what
  // is far beyond them is a blow.
  const double force2 = square(least);
  const double sway = std::max(noise_mps2 / force2, state.sway);
  const double off = square(error_rad - state.off_rad) + hit_mps2 / force2;
  state.sway = sway + std::min(1.0, state.last.period_s / kAngleSwayTime_s) *
                          (std::min(off, kAngleSwayMost * sway) - sway);
  const double blow = std::max(0.0, hit_mps2 / force2 - kAngleBlow * sway);
  take(error_rad, 1.0, 0.0, wrong_mps2 / force2 + blow + sway, state);
}

}  // namespace graben
