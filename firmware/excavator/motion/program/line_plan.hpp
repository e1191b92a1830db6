// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A straight line of the bucket's teeth planned in time before anything moves (Zhang et al., 4):
/// where the machine can't follow it is refused, where it can't as fast it is slowed as a whole.

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/motion/program/drive_plan.hpp"
#include "firmware/excavator/motion/program/line.hpp"

namespace graben {

/// Exactly one of duration and speed above 0; the other is found.
struct LineRequest {
  TeethPose from;
  TeethPose to;
  double acceleration_mps2 = 0.0;  ///< Along the way, at most.
  double duration_s = 0.0;
  double speed_mps = 0.0;  ///< Along the way, at most.
};

/// All that stays of a plan, whatever its length. An executor that scales its speed by lambda
/// advances the time at which it evaluates it by lambda times the period: path and proportions
/// stay.
struct LinePlan {
  TeethLine line;
  SineRamp ramp;
  double way_m = 0.0;  ///< See way_m() of the line.
};

/// A plan at one moment.
struct PlanState {
  Progress progress;
  TeethPose teeth;
  Eigen::Vector3d teeth_velocity_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d teeth_acceleration_mps2 = Eigen::Vector3d::Zero();
  DriveMotion by_share;  ///< Drives, with their derivatives by the share of the line.
  DriveVector velocity = DriveVector::Zero();
  DriveVector acceleration = DriveVector::Zero();
};

/// At a time from the start; before and after it stands at the ends.
[[nodiscard]] PlanState plan_state(const SwingKinematics& kinematics, const LinePlan& plan,
                                   double time_s);

/// The highest of each drive over a whole plan, as magnitudes, and the most of what the limits
/// allow.
struct PlanPeaks {
  DriveVector speed = DriveVector::Zero();
  DriveVector acceleration = DriveVector::Zero();
  DriveVector speed_ratio = DriveVector::Zero();  ///< Of the limit in its direction.
  DriveVector acceleration_ratio = DriveVector::Zero();
};

/// Steps in which each of a plan's three periods is looked at. [-; size: of the walk]
inline constexpr int kPeakSteps = 64;

/// Walks a plan that meets no blind spot in 3 kPeakSteps steps of time, with a parabola through
/// each highest pose and its neighbours: some 1e-5 off at most where a drive's speed changes
/// smoothly.
[[nodiscard]] PlanPeaks plan_peaks(const SwingKinematics& kinematics, const DriveLimits& limits,
                                   const LinePlan& plan);

/// Why there is no plan.
enum class PlanRefusal : std::uint8_t {
  kNone = 0,
  kBadRequest = 1,  ///< A number is not finite, a limit not above 0, or not one of the two paces.
  kNoWay = 2,       ///< Both ends are the same.
  kBlindSpot = 3,   ///< The machine can't be at `blind`, or can't move from there.
};

/// Reasons for a plan to be slower than asked for.
enum class PlanLimit : std::uint8_t {
  kNone = 0,
  kTeethAcceleration = 1,  ///< The duration is too short for it.
  kSpeed = 2,              ///< Of `drive`.
  kAcceleration = 3,       ///< Of `drive`.
};

struct PlanResult {
  PlanRefusal refusal = PlanRefusal::kBadRequest;
  BlindPlace blind;
  LinePlan plan;
  PlanPeaks peaks;  ///< Of the plan as it is.
  PlanLimit slowed_by = PlanLimit::kNone;
  int drive = 0;              ///< Whose limit.
  double slowed_ratio = 1.0;  ///< Duration over that without limits of the drives, 1 or more.
};

/// A plan that is valid from end to end and keeps all limits, or why there is none and where. Costs
/// a bounded number of poses, see first_blind_place and plan_peaks: some 350 where all is well.
[[nodiscard]] PlanResult plan_line(const SwingKinematics& kinematics, const DriveLimits& limits,
                                   const LineRequest& request);

}  // namespace graben
