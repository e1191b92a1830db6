// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A ramp of any way in time, and moves straight in drive space, from strokes and swing to strokes
/// and swing: Zhang's joint space method. Such a move can't leave the box of strokes and swing that
/// both its ends are in; what the teeth do on the way is no line.

#include "firmware/excavator/excavator_profile.hpp"

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
  /// At this share of the way at most: what the peak's acceleration can have made of it by there.
  [[nodiscard]] double most_rate_ps(double share) const;
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

/// Limits of each drive, all above 0: m/s and m/s^2, the swing rad/s and rad/s^2.
struct DriveLimits {
  DriveVector speed_out = DriveVector::Zero();  ///< Extending; swing to the left.
  DriveVector speed_in = DriveVector::Zero();   ///< Retracting; swing to the right.
  DriveVector acceleration = DriveVector::Zero();
};

/// Of the profile: a cylinder's speed is what a spool's section lets through over its area, or its
/// pump's whole flow if that is less; the swing's is its own limit, or what that flow gives its
/// motor.
[[nodiscard]] DriveLimits drive_limits(const ExcavatorProfile& profile);

/// Pace of a move of the drives. Both hold: the longer of the two rules.
struct DrivePace {
  double limit_ratio = 1.0;  ///< Of the drives' limits of speed and acceleration, above 0, up to 1.
  double duration_s = 0.0;   ///< At least; 0: as short as the limits have it.
};

/// All that stays of a move. Evaluated where it is wanted, like a LinePlan.
struct DrivePlan {
  DriveVector from = DriveVector::Zero();    ///< Strokes m, swing rad.
  DriveVector change = DriveVector::Zero();  ///< To the move's end.
  SineRamp ramp;                             ///< Without duration where there is nothing to move.
};

/// A move at one moment.
struct DriveState {
  Progress progress;
  DriveVector value = DriveVector::Zero();
  DriveVector velocity = DriveVector::Zero();
  DriveVector acceleration = DriveVector::Zero();
};

/// All drives in proportion, by one sine ramp: the drive that needs longest sets the pace. Closed
/// form, cheap enough for a control cycle. `limits` all above 0.
[[nodiscard]] DrivePlan plan_drives(const DriveLimits& limits, const DriveVector& from,
                                    const DriveVector& to, const DrivePace& pace);

/// At a time from the start; before and after it stands at the ends.
[[nodiscard]] DriveState drive_state(const DrivePlan& plan, double time_s);

}  // namespace graben
