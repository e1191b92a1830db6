#pragma once
/// How a joint of a hydraulic machine answers its command, with the other joints on the same pumps.
///
/// command -> dead time -> pilot lag -> opening (monotone curve, one per direction)
///         -> flow (load by pose, shared with the other openings) -> oil and mass (one mode) ->
///         velocity
///
/// An angle measured against gravity also shows what the other joints' accelerations do to its
/// sensor: the machine rocks on its tracks (a slow mode), or the sensor itself takes acceleration
/// for tilt (a fast one).
///
/// It needs neither pressures nor a profile. Velocities are in rad/s, commands and openings are
/// ratios. Everything is a template of the scalar, so that Ceres differentiates it.

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

/// Where in the parameters of a joint which of them starts. 'Forward' is what a positive opening
/// does.
enum Parameter : std::size_t {
  kDeadTime = 0,                   ///< s
  kLagOpening,                     ///< s, of the pilot while the command grows
  kLagClosing,                     ///< s
  kForward,                        ///< rad/s, rises of the curve for commands > 0, each >= 0
  kBackward = kForward + kRises,   ///< rad/s, for commands < 0
  kModeRate = kBackward + kRises,  ///< rad/s, of oil and mass
  kDampingDriving,                 ///< 1/s, while the oil drives
  kDampingBraking,                 ///< 1/s, while the oil brakes
  kLoadForward,                    ///< 1/rad, by how much the pose speeds it up: one per joint
  kLoadBackward = kLoadForward + kJoints,
  kShare =
      kLoadBackward +
      kJoints,  ///< By how much another's opening slows it: per other, own direction, its direction
  kRockRate = kShare + 4 * kOthers,  ///< rad/s, of the machine on its tracks
  kRockDamping,                      ///< Ratio
  kRockForce,                        ///< Ratio of the rocking's acceleration to another joint's
  kParameters = kRockForce + kOthers,
};

/// Commands at which a curve may bend, increasing.
using Bends = std::array<double, kKnots>;

/// Of both curves of a joint.
struct Knots {
  Bends forward{};
  Bends backward{};
};

/// What one run says about a joint before its own parameters are known.
struct JointRun {
  const MotionRun* run = nullptr;
  std::vector<double> commanded_s;  ///< Integral of the command.
  /// Of the other joints in turn, from the last pass: opening (-1 .. 1) and velocity.
  std::array<std::vector<double>, kOthers> other_opening;
  std::array<std::vector<double>, kOthers> other_velocity_radps;
};

/// Number `at` of the joints that are not `joint`.
[[nodiscard]] inline std::size_t other_joint(std::size_t joint, std::size_t at) {
  return at < joint ? at : at + 1;
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

/// The command's integral at `time_s`, which may lie before the run.
template <class T>
T commanded_until(const JointRun& of, std::size_t joint, const T& time_s, std::size_t& row) {
  const std::vector<double>& time = of.run->time_s;
  while (row + 1 < time.size() && time[row + 1] <= time_s) {
    ++row;
  }
  return of.commanded_s[row] + of.run->command[joint][row] * (time_s - time[row]);
}

/// What opens after dead time and pilot lag, in rad/s of the unloaded joint; for each row of the
/// run.
template <class T>
std::vector<T> openings(const JointRun& of, std::size_t joint, const T* p, const Knots& knots) {
  using std::exp;
  const std::vector<double>& time = of.run->time_s;
  std::vector<T> open(time.size(), T(0.0));
  std::size_t row = 0;
  T pilot(of.run->command[joint][0]);
  T before = commanded_until(of, joint, T(time[0] - p[kDeadTime]), row);
  for (std::size_t at = 1; at < time.size(); ++at) {
    const double step_s = time[at] - time[at - 1];
    const T until = commanded_until(of, joint, T(time[at] - p[kDeadTime]), row);
    const T held = (until - before) / step_s;
    before = until;
    const bool opens = (held < 0.0 ? T(-held) : held) > (pilot < 0.0 ? T(-pilot) : pilot);
    pilot += (held - pilot) * (1.0 - exp(-step_s / p[opens ? kLagOpening : kLagClosing]));
    open[at] = pilot > 0.0 ? curve_at(p + kForward, knots.forward, pilot)
                           : T(-curve_at(p + kBackward, knots.backward, T(-pilot)));
  }
  return open;
}

/// Velocity that the flow through `opening` would hold, with the pose's load and the others' share.
template <class T>
T flow_velocity(const JointRun& of, std::size_t row, const T* p, const T& opening) {
  const bool forward = opening > 0.0;
  T load(1.0);
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    load += p[(forward ? kLoadForward : kLoadBackward) + joint] * of.run->angle_rad[joint][row];
  }
  T shared(1.0);
  for (std::size_t at = 0; at < kOthers; ++at) {
    const double other = of.other_opening[at][row];
    shared += p[kShare + 4 * at + (forward ? 0 : 2) + (other > 0.0 ? 0 : 1)] * std::abs(other);
  }
  // A load beyond what the pump lifts stops the joint; it does not turn it round.
  return load > 0.0 ? T(opening * load / shared) : T(0.0);
}

/// Velocity of the joint at each row of the run, rad/s, from the commands and the measured angles.
/// Positive in the direction of a positive command: the joint's sign is not in it.
template <class T>
std::vector<T> velocities(const JointRun& of, std::size_t joint, const T* p, const Knots& knots) {
  constexpr int kSteps = 5;  // Of the mode, within one row.
  const std::vector<double>& time = of.run->time_s;
  const std::vector<T> open = openings(of, joint, p, knots);
  std::vector<T> velocity(time.size(), T(0.0));
  T v(0.0);
  T pushed(0.0);  // Acceleration by the oil, rad/s^2.
  T tilt(0.0);    // Of the rocking machine, rad, and its rate.
  T rocks(0.0);
  const T stiffness = p[kModeRate] * p[kModeRate];
  const T rock_stiffness = p[kRockRate] * p[kRockRate];
  const T rock_damping = 2.0 * p[kRockDamping] * p[kRockRate];
  T flow_before(0.0);
  for (std::size_t at = 1; at < time.size(); ++at) {
    const T flow_after = flow_velocity(of, at, p, open[at]);
    const double step_s = (time[at] - time[at - 1]) / kSteps;
    T shoved(0.0);  // Change of the rocking rate within a step.
    for (std::size_t other = 0; other < kOthers; ++other) {
      shoved += p[kRockForce + other] *
                (of.other_velocity_radps[other][at] - of.other_velocity_radps[other][at - 1]) /
                double(kSteps);
    }
    for (int step = 0; step < kSteps; ++step) {
      const T flow = flow_before + (flow_after - flow_before) * ((step + 0.5) / kSteps);
      const T& damping = p[pushed * flow > 0.0 ? kDampingDriving : kDampingBraking];
      pushed = (pushed + step_s * stiffness * (flow - v)) /
               (1.0 + step_s * (damping + step_s * stiffness));
      v += step_s * pushed;
      rocks = (rocks + shoved - step_s * rock_stiffness * tilt) /
              (1.0 + step_s * (rock_damping + step_s * rock_stiffness));
      tilt += step_s * rocks;
    }
    flow_before = flow_after;
    velocity[at] = v + rocks;
  }
  return velocity;
}

}  // namespace graben::identify
