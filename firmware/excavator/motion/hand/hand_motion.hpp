// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Motion by the operator's levers: each drive by its own (Task::kJog), or the teeth in the plane
/// of the boom, with their attitude and the swing (Task::kCoordinated), or each drive until the arm
/// is to draw the edge along the design (Task::kAssist). Travels and velocities of the swing are
/// those at its lever (SwingProfile).

#include "firmware/drives/velocity_cap.hpp"
#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/motion/hand/assist_line.hpp"

namespace graben {

/// What the levers ask for, softly started and stopped: speeds of the drives, m/s, or, where the
/// teeth are led, theirs up and forward, m/s, of the attitude, rad/s, of the swing, m/s.
using HandSpeed = DriveVector;

/// State from cycle to cycle.
struct HandState {
  bool released = false;  ///< The levers have been at rest since the task began.
  bool leads = false;     ///< The teeth: Coordinated, and Assist while it holds.
  bool plans = false;     ///< So led, there is a place to be held to, as below.
  bool is_new = false;    ///< It is that of the teeth when they began to move.
  HandSpeed speed = HandSpeed::Zero();
  TipPose tip;  ///< Where the teeth should be once all that was asked for has arrived.
  DriveVector planned_m = DriveVector::Zero();  ///< The same of the drives.
  double pace_ratio = 1.0;                      ///< See TaskState.
  AssistState assist = AssistState::kNone;
  double stops_mps2 = 0.0;  ///< Of Assist, once its levers have come to rest; 0: they have not.
};

/// What it is reckoned from.
struct HandAsk {
  Task task = Task::kNone;
  std::array<double, kDriveCount> lever_ratio{};
  double speed_override_ratio = 0.0;
  double most_ratio = 1.0;  ///< That somebody outside leaves; it counts at once.
  AssistDesign design{};    ///< Of Assist,
  double mode_radps = 1.0;  ///< and the slower mode of boom and arm on their oil, see OilModes.
};

/// Wanted motion of the drives now.
struct HandWant {
  HandSpeed speed = HandSpeed::Zero();
  TipPose tip;
  DriveVector planned_m = DriveVector::Zero();
  DriveVector wanted_mps = DriveVector::Zero();  ///< V_L^d.
  bool leads = false;                            ///< See HandState.
  bool moves = false;                            ///< Something is asked for, or was until now.
  double error_m = 0.0;  ///< Of teeth that are led from where they should be by now.
  /// By what that is already slowed; of drives that are not led only the limit, of one of them.
  VelocityCap cap;
  AssistState assist = AssistState::kNone;
  double stops_mps2 = 0.0;  ///< See HandState.
};

/// Full lever is the fastest speed that the pump gives a drive, in Coordinated the speed of the
/// task along its path, of the attitude the field's fastest rate.
///
/// Jog: each drive slows before its own end, and no other with it. Coordinated: all slow before an
/// end, kLineEnds_m from it, for there cylinders are cushioned and a line would bend; where no pose
/// is to be had further on, all stand. Other ways are free. `servo` has this cycle's strokes.
///
/// Assist: within assist.window of the design the arm's lever draws the edge along it as fast as
/// that lever alone would move the arm, the attitude as it was, or turned by the bucket's lever;
/// the boom's downwards does nothing. Before a kink of a surface it is slowed, so that the edge
/// does not leave it there, and before the surface's border stopped. At rest it stops the edge
/// within half a period of that mode, or in more where it is fast. Upwards it ends that at once, as
/// the swing's does, until the arm's has come to rest. Elsewhere, and without the arm's lever, each
/// drive goes by its own.
[[nodiscard]] HandWant want_by_hand(const ExcavatorProfile& profile, DriveRows drives,
                                    const ExcavatorKinematics& kinematics,
                                    const KinematicState& now, const ExcavatorServo& servo,
                                    const HandAsk& ask, const HandState& state, double period_s);

/// The state after a cycle in which that was followed at `followed_ratio`: lambda and what slows
/// beside it.
[[nodiscard]] HandState next_by_hand(const LineProfile& line, const HandWant& want,
                                     const HandAsk& ask, const HandState& last,
                                     double followed_ratio, double period_s);

}  // namespace graben
