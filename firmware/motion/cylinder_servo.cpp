#include "firmware/motion/cylinder_servo.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// What was asked for one dead time ago.
const Eigen::Vector3d& due(const ServoState& servo, double dead_time_s) {
  const int cycles = static_cast<int>(
      std::clamp(dead_time_s / ServoState::kCycle_s + 0.5, 0.0, ServoState::kMostDelayed - 1.0));
  const int place = servo.newest - cycles;
  return servo
      .asked_mps[static_cast<unsigned>(place < 0 ? place + ServoState::kMostDelayed : place)];
}

}  // namespace

ServoState servo_at_rest(const Eigen::Vector3d& strokes_m) {
  ServoState servo;
  servo.strokes_m = strokes_m;
  return servo;
}

ServoState next_servo(const ControlProfile& control, const ServoState& last,
                      const Eigen::Vector3d& asked_mps, const Eigen::Vector3d& strokes_m,
                      double period_s) {
  ServoState next = last;
  next.newest = (last.newest + 1) % ServoState::kMostDelayed;
  next.asked_mps[static_cast<unsigned>(next.newest)] = asked_mps;
  const double newest = 1.0 - std::exp(-period_s / (0.5 * control.response_s));
  next.lag_mps[0] += newest * (due(next, control.dead_time_s) - last.lag_mps[0]);
  next.lag_mps[1] += newest * (next.lag_mps[0] - last.lag_mps[1]);
  const Eigen::Vector3d expected_m = period_s * next.lag_mps[1];
  next.under_way_m += period_s * asked_mps - expected_m;
  next.owed_m += expected_m - (strokes_m - last.strokes_m);
  next.owed_m = next.owed_m.cwiseMax(-control.servo_most_m).cwiseMin(control.servo_most_m);
  next.strokes_m = strokes_m;
  return next;
}

Eigen::Vector3d strokes_then(const ExcavatorProfile& profile, const ServoState& servo) {
  Eigen::Vector3d then = servo.strokes_m + servo.under_way_m;
  for (int i = 0; i < kAxisCount; ++i) {
    const double most_m = profile.geometry.cylinder[static_cast<unsigned>(i)].stroke_m;
    then[i] = std::clamp(then[i], 0.0, most_m);
  }
  return then;
}

Eigen::Vector3d corrected_velocity(const ControlProfile& control, const Eigen::Vector3d& wanted_mps,
                                   const ServoState& servo, double last_lambda) {
  if (wanted_mps.isZero(0.0)) {
    return wanted_mps;
  }
  const double lambda = std::max(last_lambda, control.servo_least_lambda);
  return wanted_mps + control.servo_gain_ps / lambda * servo.owed_m;
}

}  // namespace graben
