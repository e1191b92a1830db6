// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Angle of a body against the horizontal, in a plane, by a gyro and an accelerometer on it.
///
/// A Kalman filter of two states, angle and bias of the gyro. The gyro carries the angle from
/// reading to reading; the direction of the specific force corrects it, once the caller has said
/// what of that force is the body's own acceleration. At rest the gyro shows its bias.
///
/// The acceleration needs the rate's derivative, which two readings either side give best: the
/// correction is that of the reading before the newest one, whose error the newest one shares.

#include <Eigen/Core>

namespace graben {

/// Standard deviations of one reading, and of the bias before anything is known of it.
struct AngleNoise {
  double rate_radps = 0.0;
  double bias_radps = 0.0;
  double force_mps2 = 0.0;
};

/// A reading in the body's own axes. Counter-clockwise is positive.
struct AngleReading {
  double period_s = 0.0;  ///< Since the one before.
  double rate_radps = 0.0;
  Eigen::Vector2d force_mps2 = Eigen::Vector2d::Zero();  ///< Specific: 1 g upwards at rest.
  double turning_radps = 0.0;                            ///< Of the whole plane about the vertical.
};

/// Motion of the body at the reading before the newest one.
struct AngleMotion {
  double angle_rad = 0.0;
  double rate_radps = 0.0;
  double acceleration_radps2 = 0.0;
  Eigen::Vector2d force_mps2 = Eigen::Vector2d::Zero();  ///< As it was shown.
  double turning_radps = 0.0;
};

/// From reading to reading. Nothing is known before begin_angle().
struct LinkAngle {
  int readings = 0;        ///< Since it began, counted no further than it matters.
  double angle_rad = 0.0;  ///< At the newest reading.
  double bias_radps = 0.0;
  /// Of the errors of angle and bias.
  double angle_variance = 0.0;
  double covariance = 0.0;
  double bias_variance = 0.0;
  AngleReading last;
  double before_radps = 0.0;  ///< Rate of the reading before `last`.
  AngleMotion then;           ///< At the reading before `last`.
  /// Low-passed: the force's direction against the angle; what hits the link counts little.
  double off_rad = 0.0;
  double sway = 0.0;  ///< Mean square of what a reading is off by, of either kind, rad^2.
  /// Low-passed: the force across the lever that neither gyro nor gravity explains.
  double steady_mps2 = 0.0;
  double steady_s = 0.0;  ///< Since when, no longer than it matters.
  /// What the gyro's rate has changed more than the force says that the link was turned, lately.
  double jumps_radps = 0.0;
  double jumped_radps = 0.0;  ///< The same, low-passed: what shakes goes to and fro.
  double shaken = 0.0;       ///< Mean square of the force that the gyro does not explain, (m/s2)^2.
  double jump_held_s = 0.0;  ///< How long yet a jump that was seen counts; 0: none was.

  /// Rate and its derivative are known either side.
  [[nodiscard]] bool runs() const { return readings > 2; }
  /// Where it will be so long after the newest reading, rad; it goes on at its rate.
  [[nodiscard]] double ahead_rad(double time_s) const;
  /// Standard deviation of the angle, so long after the newest reading.
  [[nodiscard]] double sd_rad(double time_s) const;
  /// Gyro and gravity contradict each other: one of them is wrong.
  [[nodiscard]] bool contradicts() const;
};

/// Starts from a reading's force alone, as of a body that stands. A bias that is known stays, and
/// so does a jump that is held: the gyro is the same.
void begin_angle(const AngleNoise& noise, const AngleReading& reading, LinkAngle& state);

/// Goes on to the next reading by its rate; sets `then` once it runs. `at_rest`: nothing can move
/// it, its gyro shows the bias.
void carry_angle(const AngleNoise& noise, const AngleReading& reading, bool at_rest,
                 LinkAngle& state);

/// Compares what the gyro's rate changes with the force across `at_m`, the sensor's place from the
/// pin that its link turns about: a link that is turned faster takes its sensor along, a gyro that
/// jumps does not. `acceleration_mps2` as for correct_angle().
void watch_gyro(const AngleNoise& noise, const Eigen::Vector2d& at_m,
                const Eigen::Vector2d& acceleration_mps2, LinkAngle& state);

/// Corrects it by the force of the reading before the newest one; `acceleration_mps2` is that of
/// the sensor's place then, over the ground, y up. Nothing where the force is too small to have a
/// direction.
void correct_angle(const AngleNoise& noise, const Eigen::Vector2d& acceleration_mps2,
                   LinkAngle& state);

}  // namespace graben
