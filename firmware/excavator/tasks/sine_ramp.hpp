#pragma once
/// Sine acceleration, uniform speed, sine deceleration along a way: (7) of Zhang et al.

namespace graben {

/// How far along a way (0 .. 1), and how it goes on, by time.
struct Progress {
  double share = 0.0;
  double rate_ps = 0.0;
  double rate_change_ps2 = 0.0;
};

/// The whole in two figures: with w = pi / t_1 the speed rises by a sine half wave of acceleration
/// until t_1, stays, and falls in the same way from t_2 = T - t_1. In the paper's (7) the last
/// line's range has to be t_2 <= t <= T. At t_1 = T / 2 the speed never is uniform: a short trip.
struct SineRamp {
  double duration_s = 0.0;  ///< T
  double ramp_s = 0.0;      ///< t_1, above 0 and at most T / 2.

  /// Before 0 and after T at rest at the ends.
  [[nodiscard]] Progress at(double time_s) const;
  /// Of the uniform speed, or the highest; 2 a / w of (7), in shares a second.
  [[nodiscard]] double peak_rate_ps() const { return 1.0 / (duration_s - ramp_s); }
  /// a of (7), in shares.
  [[nodiscard]] double peak_rate_change_ps2() const;
  /// The same in `factor` times the time: rates fall by it, their changes by its square.
  [[nodiscard]] SineRamp slowed(double factor) const {
    return {factor * duration_s, factor * ramp_s};
  }
};

/// A way in a given time, never accelerating more: the least speed that does it. Where the time is
/// too short for the acceleration it takes the shortest that is not.
[[nodiscard]] SineRamp ramp_for_duration(double way_m, double duration_s, double acceleration_mps2);
/// A way at up to a given speed; a short one ends before the speed is reached.
[[nodiscard]] SineRamp ramp_for_speed(double way_m, double speed_mps, double acceleration_mps2);

}  // namespace graben
