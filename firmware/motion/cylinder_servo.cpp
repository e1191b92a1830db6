#include "firmware/motion/cylinder_servo.hpp"

#include <algorithm>
#include <cmath>

namespace graben {

ServoState next_servo(const ControlProfile& control, const ServoState& last,
                      const Eigen::Vector3d& asked_mps, const Eigen::Vector3d& strokes_m,
                      double period_s) {
  constexpr double kCycle_s = 0.01;
  ServoState next = last;
  next.newest = (last.newest + 1) % ServoState::kMostDelayed;
  next.asked_mps[static_cast<unsigned>(next.newest)] = asked_mps;
  const int delay = std::clamp(static_cast<int>(control.dead_time_s / kCycle_s + 0.5), 0,
                               ServoState::kMostDelayed - 1);
  const int due = (next.newest - delay + ServoState::kMostDelayed) % ServoState::kMostDelayed;
  const double share = 1.0 - std::exp(-period_s / (0.5 * control.response_s));
  next.lag_mps[0] += share * (next.asked_mps[static_cast<unsigned>(due)] - next.lag_mps[0]);
  next.lag_mps[1] += share * (next.lag_mps[0] - next.lag_mps[1]);
  next.under_way_m += period_s * (asked_mps - next.lag_mps[1]);
  next.owed_m += period_s * next.lag_mps[1] - (strokes_m - last.strokes_m);
  next.owed_m = next.owed_m.cwiseMax(-control.servo_most_m).cwiseMin(control.servo_most_m);
  const double calm = control.observer_s > 0.0 ? 1.0 - std::exp(-period_s / control.observer_s) : 1.0;
  next.calm_owed_m += calm * (next.owed_m - last.calm_owed_m);
  next.calm_strokes_m += period_s * next.lag_mps[1];
  next.calm_strokes_m += calm * (strokes_m - next.calm_strokes_m);
  next.strokes_m = strokes_m;
  return next;
}

ServoState servo_at_rest(const Eigen::Vector3d& strokes_m) {
  ServoState servo;
  servo.strokes_m = strokes_m;
  servo.calm_strokes_m = strokes_m;
  return servo;
}

Eigen::Vector3d strokes_then(const ExcavatorProfile& profile, const ServoState& servo) {
  Eigen::Vector3d then = servo.calm_strokes_m + servo.under_way_m;
  for (int i = 0; i < kAxisCount; ++i) {
    then[i] = std::clamp(then[i], 0.0,
                         profile.geometry.cylinder[static_cast<unsigned>(i)].stroke_m);
  }
  return then;
}

Eigen::Vector3d corrected_velocity(const ControlProfile& control,
                                   const Eigen::Vector3d& wanted_mps, ServoState& servo,
                                   const LoadState& load, double last_lambda) {
  if (wanted_mps.isZero(0.0)) {
    return wanted_mps;
  }
  Eigen::Vector3d v = wanted_mps + (control.servo_gain_ps * servo.calm_owed_m + damping_velocity(control, load)) / std::max(last_lambda, control.least_lambda);
  for (int i = 0; i < kAxisCount; ++i) {
    bool& moves = servo.moves[static_cast<unsigned>(i)];
    moves = std::abs(v[i]) > (moves ? 0.5 : 1.0) * control.speed_threshold_mps;
    if (!moves) v[i] = 0.0;
  }
  return v;
}

}  // namespace graben
