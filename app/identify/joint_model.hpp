// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a joint of a hydraulic machine answers its command, with the other joints on the same pumps.
///
/// command -> dead time -> pilot lag -> opening (monotone curve, one per direction)
///         -> flow (load by gravity, linkage, shared with the other openings) -> pump lag
///         -> oil and mass (one mode, inertia by pose) -> motion -> sensor lag -> measured velocity
///
/// A measured angle also shows what accelerations, its joint's own and the others', do to what
/// carries it: the machine rocks and twists on its tracks (a slow mode), or the sensor itself takes
/// acceleration for tilt (a fast one). The angle is what is measured at once, the velocity comes
/// late.
///
/// It needs neither pressures nor a profile. Velocities are in rad/s, commands and openings are
/// ratios. Everything is a template of the scalar, so that Ceres differentiates it. The motion
/// that a flow makes: joint_motion.hpp.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "app/identify/motion_runs.hpp"

namespace graben::identify {

inline constexpr std::size_t kKnots = 9;           ///< Of a curve; the first has no opening.
inline constexpr std::size_t kRises = kKnots - 1;  ///< From knot to knot.
inline constexpr std::size_t kOthers = kJoints - 1;
inline constexpr std::size_t kWays = 2;     ///< Positive and negative opening.
inline constexpr std::size_t kLinkage = 7;  ///< Places of the linkage's curve, even.
inline constexpr std::size_t kMiddle = kLinkage / 2;
/// Sine and cosine of boom, arm and bucket against the horizon, and the swing.
inline constexpr std::size_t kPose = 7;
inline constexpr std::size_t kCosines = 3;  ///< Of the pose: boom, arm, bucket.

/// Where in the parameters of a joint which of them starts. 'Forward' is what a positive opening
/// does. A pair of lags is for growing and for falling.
enum Parameter : std::size_t {
  kDeadTime = 0,                       ///< s
  kPilotLag,                           ///< s, a pair for forward, a pair for backward
  kForward = kPilotLag + 4,            ///< rad/s, rises of the curve for commands > 0, each >= 0
  kBackward = kForward + kRises,       ///< rad/s, for commands < 0
  kFlowLag = kBackward + kRises,       ///< s, of the pump's flow, as kPilotLag
  kModeRate = kFlowLag + 4,            ///< rad/s, of oil and mass
  kDampingDriving,                     ///< 1/s, while the oil drives
  kDampingBraking,                     ///< 1/s, while the oil brakes
  kInertia,                            ///< By how much the pose makes it heavier, ratio per cosine
  kLoadForward = kInertia + kCosines,  ///< By how much the pose speeds it up, ratio per part of it
  kLoadBackward = kLoadForward + kPose,
  /// Velocity per flow along the joint's own travel, ratio to that at kMiddle, which is left out
  kLinkageRatio = kLoadBackward + kPose,
  /// By how much another's opening slows it: per other, own direction, its direction
  kShare = kLinkageRatio + kLinkage - 1,
  kRockRate = kShare + 4 * kOthers,  ///< rad/s, of the machine on its tracks
  kRockDamping,                      ///< Ratio
  kRockForce,                        ///< Ratio of the rocking's acceleration to another joint's
  kRockOwn = kRockForce + kOthers,   ///< The same of its own
  kSensorLag,                        ///< s, of the measured velocity behind the angle
  kParameters,
};

/// Commands at which a curve may bend, increasing.
using Bends = std::array<double, kKnots>;

using Pose = std::array<double, kPose>;

/// Angles of all joints at one time, rad.
using Angles = std::array<double, kJoints>;

/// To what a joint's parameters refer: not fitted, set from the recording.
struct Grid {
  Bends forward{};
  Bends backward{};
  double least_rad = 0.0;  ///< Of the joint's own travel.
  double most_rad = 1.0;
  Pose usual{};  ///< At which the load is 1.
};

/// What one run says about a joint before its own parameters are known.
struct JointRun {
  const MotionRun* run = nullptr;
  double command_before = 0.0;      ///< What held until the first row.
  std::vector<double> commanded_s;  ///< Integral of the command.
  std::vector<Pose> pose;           ///< As measured.
  /// Of the other joints in turn, from the last pass: opening (-1 .. 1) and velocity.
  std::array<std::vector<double>, kOthers> other_opening;
  std::array<std::vector<double>, kOthers> other_velocity_radps;
};

/// Number `at` of the joints that are not `joint`.
[[nodiscard]] inline std::size_t other_joint(std::size_t joint, std::size_t at) {
  return at < joint ? at : at + 1;
}

[[nodiscard]] inline Angles angles_at(const MotionRun& run, std::size_t row) {
  return {run.angle_rad[0][row], run.angle_rad[1][row], run.angle_rad[2][row],
          run.angle_rad[3][row]};
}

/// How gravity pulls at the links: an arm's angle counts from its boom, a bucket's from its arm.
[[nodiscard]] inline Pose pose_of(const Angles& angles) {
  const double boom = angles[0];
  const double arm = boom + angles[1];
  const double bucket = arm + angles[2];
  return {std::sin(boom),   std::cos(boom),   std::sin(arm), std::cos(arm),
          std::sin(bucket), std::cos(bucket), angles[3]};
}

/// Value at `u` >= 0 of a curve of straight pieces: 0 up to the first knot, then higher by each of
/// `rises` from knot to knot.
template <class T>
T curve_at(const T* rises, const Bends& knots, const T& u) {
  T value(0.0);
  for (std::size_t at = 0; at < kRises; ++at) {
    if (u >= knots[at + 1]) {
      value += rises[at];
    } else {
      if (u > knots[at]) {
        value += rises[at] * (u - knots[at]) / (knots[at + 1] - knots[at]);
      }
      break;
    }
  }
  return value;
}

/// The lag of a pair that applies to what is `from` and shall be `to`.
template <class T>
const T& lag_of(const T* lags, const T& from, const T& to) {
  const bool forward = from == 0.0 ? to > 0.0 : from > 0.0;
  const bool grows = forward ? to > from : to < from;
  return lags[(forward ? 0 : 2) + (grows ? 0 : 1)];
}

/// The command's integral at `time_s`, which may lie before the run.
template <class T>
T commanded_until(const JointRun& of, std::size_t joint, const T& time_s, std::size_t& row) {
  const std::vector<double>& time = of.run->time_s;
  while (row + 1 < time.size() && time[row + 1] <= time_s) {
    ++row;
  }
  if (time_s < time[0]) {
    return of.command_before * (time_s - time[0]);
  }
  return of.commanded_s[row] + of.run->command[joint][row] * (time_s - time[row]);
}

/// What opens after dead time and pilot lag, in rad/s of the unloaded joint; for each row of the
/// run.
template <class T>
std::vector<T> openings(const JointRun& of, std::size_t joint, const T* p, const Grid& grid) {
  using std::exp;
  const std::vector<double>& time = of.run->time_s;
  std::vector<T> open(time.size(), T(0.0));
  std::size_t row = 0;
  T pilot(of.command_before);
  T before = commanded_until(of, joint, T(time[0] - p[kDeadTime]), row);
  for (std::size_t at = 1; at < time.size(); ++at) {
    const double step_s = time[at] - time[at - 1];
    const T until = commanded_until(of, joint, T(time[at] - p[kDeadTime]), row);
    const T held = (until - before) / step_s;
    before = until;
    pilot += (held - pilot) * (1.0 - exp(-step_s / lag_of(p + kPilotLag, pilot, held)));
    open[at] = pilot > 0.0 ? curve_at(p + kForward, grid.forward, pilot)
                           : T(-curve_at(p + kBackward, grid.backward, T(-pilot)));
  }
  return open;
}

/// Velocity per flow at one of the linkage's places.
template <class T>
T ratio_at(const T* ratios, std::size_t place) {
  return place == kMiddle ? T(1.0) : ratios[place < kMiddle ? place : place - 1];
}

/// Velocity per flow at `angle_rad` of the joint's travel: straight from place to place.
template <class T>
T linkage_at(const T* ratios, const Grid& grid, double angle_rad) {
  const double share = (angle_rad - grid.least_rad) / (grid.most_rad - grid.least_rad);
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(kLinkage - 1);
  const std::size_t before = std::min(static_cast<std::size_t>(place), kLinkage - 2);
  const double part = place - static_cast<double>(before);
  return ratio_at(ratios, before) * (1.0 - part) + ratio_at(ratios, before + 1) * part;
}

/// Velocity that the flow through `opening` would hold, with the load of `pose`, the linkage at
/// `angle_rad` and the others' share.
template <class T>
T flow_velocity(const JointRun& of, std::size_t row, const T* p, const Grid& grid, const Pose& pose,
                double angle_rad, const T& opening) {
  const bool forward = opening > 0.0;
  const T* loads = p + (forward ? kLoadForward : kLoadBackward);
  T load(1.0);
  for (std::size_t part = 0; part < kPose; ++part) {
    load += loads[part] * (pose[part] - grid.usual[part]);
  }
  // A load beyond what the pump lifts stops the joint; it does not turn it round.
  if (!(load > 0.0)) {
    return T(0.0);
  }
  T shared(1.0);
  for (std::size_t at = 0; at < kOthers; ++at) {
    const double other = of.other_opening[at][row];
    shared += p[kShare + 4 * at + (forward ? 0 : 2) + (other > 0.0 ? 0 : 1)] * std::abs(other);
  }
  return opening * load * linkage_at(p + kLinkageRatio, grid, angle_rad) / shared;
}

/// Mass that the oil moves in a pose, ratio to that in the usual one.
template <class T>
T inertia_of(const T* p, const Grid& grid, const Pose& pose) {
  T inertia(1.0);
  for (std::size_t at = 0; at < kCosines; ++at) {
    inertia += p[kInertia + at] * (pose[2 * at + 1] - grid.usual[2 * at + 1]);
  }
  if (!(inertia > 0.2)) {
    return T(0.2);
  }
  return inertia;
}

}  // namespace graben::identify
