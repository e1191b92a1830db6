#pragma once
/// The blade on the grade: feed-forward of the body's motion and of the design ahead, and feedback.

#include "firmware/dozer/grade_profile.hpp"
#include "firmware/dozer/mobile_jacobian.hpp"

namespace graben {

/// State from cycle to cycle.
struct BladeState {
  double integral_mps = 0.0;
  double carried_mps = 0.0;        ///< Vertical velocity of the edge that the body alone gives it.
  double carried_rate_mps2 = 0.0;  ///< Its rate of change, low-passed.
  bool has_last = false;
};

/// Where the machine is, measured.
struct BladeSituation {
  BodyPose body;
  Vector6d body_velocity = Vector6d::Zero();  ///< x_V-dot.
  double angle_rad = 0.0;                     ///< theta_1
  double available_flow_m3ps = 0.0;
};

struct BladeCommand {
  double velocity_mps = 0.0;      ///< Of the blade cylinders; extension is positive.
  double feed_forward_mps = 0.0;  ///< What the grade alone asks for now: (5), (6).
  double error_m = 0.0;           ///< Cutting edge above the grade, along its normal.
  bool at_end = false;            ///< Slowed by the end of the stroke.
  BladeState state;
};

/// (5) with the velocity along the grade's normal that takes the error back, then (6). Both what
/// the body does and what the design asks for are taken as they will be when the cylinders answer,
/// `response_s` and the dead time later. The integral stands still while the pump can give no more.
/// Towards the ends of the blade's reach the cylinders slow
/// down. `last` is that of a cycle ago; a default one where there was none.
[[nodiscard]] BladeCommand control_blade(const DozerProfile& profile, const DriveRow& drive,
                                         const BladeKinematics& blade, const GradeProfile& design,
                                         const BladeState& last, const BladeSituation& now,
                                         double period_s);

}  // namespace graben
