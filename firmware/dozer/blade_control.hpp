// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The blade on the grade: feed-forward of the body's motion and of the design ahead, and feedback.

#include "firmware/dozer/grade_profile.hpp"
#include "firmware/dozer/mobile_jacobian.hpp"

namespace graben {

/// State from cycle to cycle.
struct BladeState {
  double integral_mps = 0.0;
};

/// How far above the design the edge is to be, m, and how that changes along x.
struct BladeLift {
  double height_m = 0.0;
  double slope = 0.0;
  double rate_mps = 0.0;  ///< And in time.
};

/// Where the machine is, measured or foretold.
struct BladeSituation {
  BodyPose body;
  double pitch_rad = 0.0;
  Vector6d body_velocity = Vector6d::Zero();  ///< x_V-dot.
  double angle_rad = 0.0;                     ///< theta_1
  double roll_rate_radps = 0.0;               ///< 0 where the blade has no tilt.
  BladeLift lift;
  double aside_m = 0.0;    ///< So much higher is the design there than on the track beside it.
  double askew_rad = 0.0;  ///< Heading against the track at the edge, to the left.
  double askew_rate_radps = 0.0;
};

struct BladeCommand {
  double velocity_mps = 0.0;      ///< Of the blade cylinders; extension is positive.
  double feed_forward_mps = 0.0;  ///< What the grade alone asks for now: (5), (6).
  double error_m = 0.0;           ///< Cutting edge above the grade, along its normal.
  double off_m = 0.0;             ///< Above where it is meant to be: its lift over the grade.
  bool at_end = false;            ///< Slowed by the end of the stroke.
  bool sinks = false;             ///< On its way down to the design, no faster than it may.
  BladeState state;
};

/// (5) with the velocity along the grade's normal that takes the error back, then (6), for `then`:
/// the moment at which the cylinders answer, all that is under way to them having arrived. The
/// error is the one that there will be, so that what is already asked for is not asked for twice;
/// `now` is measured, and what stays of it is integrated. The integral stands still while the pump
/// can give no more.
///
/// What is too deep is taken back at once, what is too high within the tolerance over some way: an
/// edge that goes down steeply rides on the ground instead of cutting it, and on a crest that rocks
/// the body back and forth. Such an error is not integrated. Towards the ends of the blade's reach
/// the cylinders slow down. `last` is that of a cycle ago; a default one where there was none.
[[nodiscard]] BladeCommand control_blade(const DozerProfile& profile, const DriveRow& drive,
                                         const BladeKinematics& blade, const GradeProfile& design,
                                         const BladeState& last, const BladeSituation& now,
                                         const BladeSituation& then, double available_flow_m3ps,
                                         double period_s);

}  // namespace graben
