// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Everything that slows a machine gives a cap: by how much, and why. The tightest of a kind
/// counts; of several kinds what is reported is the first of one table.

#include <initializer_list>

#include "firmware/core/codes.hpp"
#include "firmware/core/fault_set.hpp"
#include "firmware/drives/drive_servo.hpp"
#include "firmware/drives/tuning.hpp"

namespace graben {

/// A factor (0 .. 1) on the wanted velocity, all drives alike, so that its direction stays.
struct VelocityCap {
  double factor = 1.0;
  Limit limit;  ///< kNone: nothing slows.

  /// No faster than `allowed` what would go at `speed`.
  void tighten(double speed, double allowed, Limit why) {
    if (speed * factor > allowed) {
      factor = allowed / speed;
      limit = why;
    }
  }
};

/// The same as a speed, m/s.
struct SpeedCap {
  double speed_mps = 0.0;
  Limit limit;

  void tighten(double allowed_mps, Limit why) {
    if (allowed_mps < speed_mps) {
      speed_mps = allowed_mps;
      limit = why;
    }
  }
};

/// A limit at `distance` (slack included) lets the machine close at most at min(gain_ps * distance,
/// sqrt(2 * deceleration * distance)), not at all beyond; moving away is free.
void approach(double gain_ps, double deceleration, double distance, double closing, Limit limit,
              VelocityCap& cap);

/// Largest speed at which a drive that moves with `velocity_mps` may near the end of its travel:
/// stroke_end_gain_ps times what is left.
[[nodiscard]] double end_speed_mps(const DriveRow& drive, double stroke_m, double velocity_mps);

/// No drive nears the end of its travel faster than end_speed_mps().
void slow_at_ends(DriveRows drives, Span<const ValidDrive> seen, Span<const double> velocity_mps,
                  VelocityCap& cap);

/// As `approach`, of each drive with its own gain and deceleration. `then_m` is where it will be
/// when all that is under way has arrived (stroke_then_m): of a machine with dead time and lag,
/// that is what the velocity moves at once, so that nothing overshoots.
///
/// The ends stand `end_slack_m` behind those of the travel, so that a drive slows to nothing there
/// and not at the very place. At the place itself it may still close at stroke_end_gain times the
/// slack, which is what makes a move possible that ends where a cylinder does: it closes now and
/// then at the size of rounding or of a feedback's correction. With the limit at the place itself,
/// any of them would stop the whole machine, let it go and stop it again.
void approach_ends(DriveRows drives, Span<const double> then_m, Span<const double> velocity_mps,
                   VelocityCap& cap);

/// The limit to report of all that slow: the first in the table of priorities, and of equals the
/// first given. The valve's solution before ends and fences, before the dozer's travel speed,
/// before teeth that are behind their plan, before the rise of lambda, before a lost sensor.
[[nodiscard]] Limit held_by(std::initializer_list<Limit> limits);

/// kDegraded with the first of the faults; kNone without one.
[[nodiscard]] Limit degraded_limit(const FaultSet& degraded);

}  // namespace graben
