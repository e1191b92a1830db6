// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/hand/hand_motion.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/hand/tuning.hpp"
#include "firmware/excavator/motion/program/drive_plan.hpp"
#include "firmware/excavator/swing.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

/// Lever that raises teeth that are led. [-; standard: BoomOrUp is the first of OperatorAxes]
constexpr int kUp = 0;
/// Lever that moves them forward. [-; standard: ArmOrForward is the second of OperatorAxes]
constexpr int kForward = 1;
/// Lever that turns them. [-; standard: BucketOrAttitude is the third of OperatorAxes]
constexpr int kAttitude = 2;

/// Speed with full levers, and its change in a second.
struct HandRange {
  HandSpeed most = HandSpeed::Zero();
  HandSpeed change_ps = HandSpeed::Zero();
  double arm_mps = 0.0;  ///< Of the arm by its own lever.
};

HandRange hand_range(const ExcavatorProfile& profile, bool leads, bool assists) {
  const DriveLimits limits = drive_limits(profile);
  HandRange range{travel_of(profile, limits.speed_out), travel_of(profile, limits.acceleration)};
  range.arm_mps = range.most[kArm];
  if (leads) {
    const double tip_mps = assists ? kAssistFastest_mps : profile.dig_speed_mps;
    const double attitude_radps = profile.control.attitude_rate_max_radps;
    const double tip_mps2 = (assists ? 1.0 : kHandBrisk) * profile.line.acceleration_mps2;
    range.most.head<3>() << tip_mps, tip_mps, attitude_radps;
    range.change_ps.head<3>() << tip_mps2, tip_mps2, attitude_radps / kHandAttitudeRise_s;
  }
  return range;
}

/// Up and forward change together, so that a way that begins or ends is straight.
HandSpeed softened(const HandRange& range, bool leads, const HandSpeed& target, HandSpeed last,
                   double period_s) {
  last = last.cwiseMin(range.most).cwiseMax(-range.most);
  HandSpeed change = target - last;
  int first = 0;
  if (leads) {
    const double most = range.change_ps[kUp] * period_s;
    const double wanted = change.head<2>().norm();
    change.head<2>() *= wanted > most ? most / wanted : 1.0;
    first = kAttitude;
  }
  for (int i = first; i < kDriveCount; ++i) {
    const double most = range.change_ps[i] * period_s;
    change[i] = std::clamp(change[i], -most, most);
  }
  return last + change;
}

/// Deceleration at which the edge stands soon and its links ring little.
double stops_mps2(double mode_radps, double speed_mps) {
  const double radians = kAssistStopPeriods * kTwoPi;
  return std::max(mode_radps * std::min(speed_mps / radians, kAssistStop_mps),
                  speed_mps / kAssistStopMost_s);
}

/// One factor on all, so that the direction stays.
void hold_outside(const HandRange& range, bool leads, const HandAsk& ask, HandSpeed& speed) {
  if (ask.most_ratio >= 1.0) {
    return;
  }
  VelocityCap cap;
  if (leads) {
    cap.tighten(speed.head<2>().norm(), ask.most_ratio * range.most[kUp], {});
  }
  for (int i = 0; i < kDriveCount; ++i) {
    cap.tighten(std::abs(speed[i]), ask.most_ratio * range.most[i], {});
  }
  speed *= cap.factor;
}

HandSpeed levers_of(const HandAsk& ask, bool released) {
  return released ? HandSpeed(HandSpeed(ask.lever_ratio.data()).cwiseMin(1.0).cwiseMax(-1.0))
                  : HandSpeed(HandSpeed::Zero());
}

HandSpeed target_of(const HandRange& range, bool leads, const HandAsk& ask, bool released) {
  HandSpeed levers = levers_of(ask, released);
  const double both = levers.head<2>().norm();
  if (leads && both > 1.0) {
    levers.head<2>() /= both;
  }
  return ask.speed_override_ratio * range.most.cwiseProduct(levers);
}

AssistState assist_of(const AssistProfile& assist, const HandAsk& ask, const KinematicState& now,
                      const HandState& state) {
  if (ask.task == Task::kAssist && ask.design.lost) {
    return AssistState::kAway;
  }
  if (ask.task != Task::kAssist || !ask.design.present) {
    return AssistState::kNone;
  }
  if (ask.design.beyond()) {
    return AssistState::kBeyond;
  }
  const bool was_near = state.assist > AssistState::kAway && state.assist < AssistState::kBeyond;
  const double most_m = assist.window_m * (was_near ? kAssistKeeps : 1.0);
  if (now.status != ReachStatus::kOk || !(std::abs(ask.design.now.height_m(now.tip)) <= most_m)) {
    return AssistState::kAway;
  }
  const HandSpeed levers = levers_of(ask, state.released);
  const bool pulls = levers[kArm] != 0.0;
  if (levers[kBoom] > 0.0 || levers[kSwing] != 0.0 ||
      (pulls && state.assist == AssistState::kLetGo)) {
    return AssistState::kLetGo;
  }
  return pulls || state.plans ? AssistState::kHolds : AssistState::kNear;
}

/// Along the design as fast as the arm's lever alone moves the arm, and onto it the faster, the
/// farther off the edge still is. `tip` is where it will be.
HandSpeed along_design(const HandRange& range, const HandAsk& ask, const KinematicState& now,
                       const TipPose& tip, bool released, VelocityCap& cap) {
  const HandSpeed levers = ask.speed_override_ratio * levers_of(ask, released);
  const AssistLine& design = ask.design.at;
  const Eigen::Vector2d along = design.along();
  const double arm = now.jacobian_inverse.row(kArm).head<2>().dot(along);
  // Extending, the arm draws in.
  double speed_mps =
      -levers[kArm] * range.arm_mps / std::max(std::abs(arm), range.arm_mps / range.most[kForward]);
  VelocityCap ahead;
  ahead.tighten(std::abs(speed_mps), ask.design.ahead.speed_mps, ask.design.ahead.limit);
  speed_mps *= ahead.factor;
  cap.limit = ahead.limit;
  const double off =
      std::clamp(design.height_m(tip) / kAssistOnto_m, -kAssistSteepest, kAssistSteepest);
  const Eigen::Vector2d tip_mps = speed_mps * along - std::abs(speed_mps) * off * design.up;
  HandSpeed target = HandSpeed::Zero();
  target.head<3>() << tip_mps.y(), tip_mps.x(), -levers[kBucket] * range.most[kAttitude];
  return target;
}

/// Before the end of a drive, or so far from it.
void slow_at_end(const DriveRow& drive, double then_m, double speed_mps, double margin_m,
                 VelocityCap& cap) {
  const double left_m =
      speed_mps > 0.0 ? drive.most_travel_m - then_m : then_m - drive.least_travel_m;
  approach(drive.control.stroke_end_gain_ps, drive.control.deceleration_mps2, left_m - margin_m,
           std::abs(speed_mps), drive.control.at_end, cap);
}

/// Each drive by itself; what it may have less is its end's.
void slow_each(DriveRows drives, const DriveVector& then_m, HandWant& want) {
  want.wanted_mps.setZero();
  for (int i = 0; i < drives.count(); ++i) {
    VelocityCap cap;
    slow_at_end(drives[i], then_m[i], want.speed[i], 0.0, cap);
    want.wanted_mps[i] = cap.factor * want.speed[i];
    want.cap.limit = cap.limit.kind == LimitKind::kNone ? want.cap.limit : cap.limit;
  }
  want.speed = want.wanted_mps;
}

TipPose moved(const TipPose& tip, const HandSpeed& speed, double time_s) {
  return {tip.x_m + time_s * speed[kForward], tip.y_m + time_s * speed[kUp],
          tip.attitude_rad + time_s * speed[kAttitude]};
}

/// Whose end it is that there is no pose.
int axis_of(const PathMotion& motion) {
  switch (motion.status) {
    case ReachStatus::kBoomStroke:
      return kBoom;
    case ReachStatus::kBucketStroke:
    case ReachStatus::kLinkageOpen:
      return kBucket;
    case ReachStatus::kSingular:
      return motion.axis;
    default:
      return kArm;
  }
}

double distance_m(const TipPose& one, const TipPose& other) {
  return std::hypot(one.x_m - other.x_m, one.y_m - other.y_m);
}

/// Teeth where all that has arrived by now should have brought them; before a design only off it.
double error_m(DriveRows drives, const ExcavatorKinematics& kinematics, const KinematicState& now,
               const ExcavatorServo& servo, const AssistLine& design,
               const DriveVector& planned_m) {
  DriveVector due_m = planned_m - servo.under_way_m();
  for (int i = 0; i < kAxisCount; ++i) {
    due_m[i] = std::clamp(due_m[i], drives[i].least_travel_m, drives[i].most_travel_m);
  }
  const KinematicState due = kinematics.state(due_m.head<kAxisCount>());
  if (due.status != ReachStatus::kOk) {
    return 0.0;
  }
  return design.known ? std::abs(design.height_m(due.tip) - design.height_m(now.tip))
                      : distance_m(due.tip, now.tip);
}

void lead_teeth(DriveRows drives, const ExcavatorKinematics& kinematics, const KinematicState& now,
                const ExcavatorServo& servo, const AssistLine& design, const HandState& state,
                HandWant& want) {
  want.tip = state.plans ? state.tip : now.tip;
  want.planned_m = state.plans ? state.planned_m : servo.strokes_m();
  want.moves = !want.speed.isZero(0.0);
  if (!want.moves || now.status != ReachStatus::kOk) {
    return;
  }
  want.error_m =
      state.plans ? error_m(drives, kinematics, now, servo, design, want.planned_m) : 0.0;
  const TipPose rate = moved({}, want.speed, 1.0);
  const PathMotion here = kinematics.motion_from_pose(want.tip, rate, {});
  const PathMotion ahead =
      kinematics.motion_from_pose(moved(want.tip, want.speed, kHandAhead_s), rate, {});
  const PathMotion& blind = here.status == ReachStatus::kOk ? ahead : here;
  if (blind.status != ReachStatus::kOk) {
    want.cap.limit = drives[axis_of(blind)].control.at_end;
    want.speed.setZero();
    return;
  }
  want.planned_m.head<kAxisCount>() = here.strokes_m;
  want.wanted_mps = with_swing(want.wanted_mps, want.speed[kSwing]);
  want.wanted_mps.head<kAxisCount>() = here.strokes_rate;
  want.wanted_mps *= state.pace_ratio;
  for (int i = 0; i < kAxisCount; ++i) {
    slow_at_end(drives[i], want.planned_m[i], want.wanted_mps[i], kLineEnds_m, want.cap);
  }
  // Corrections stay whole: they keep the line straight while it ends.
  want.wanted_mps *= want.cap.factor;
}

}  // namespace

HandWant want_by_hand(const ExcavatorProfile& profile, DriveRows drives,
                      const ExcavatorKinematics& kinematics, const KinematicState& now,
                      const ExcavatorServo& servo, const HandAsk& ask, const HandState& state,
                      double period_s) {
  HandWant want;
  want.assist = assist_of(profile.assist, ask, now, state);
  const bool assists = want.assist == AssistState::kHolds;
  want.leads = assists || ask.task == Task::kCoordinated;
  HandRange range = hand_range(profile, want.leads, assists);
  // Teeth that begin or end to be led do so from rest: boom up counts at once.
  const HandSpeed last = state.leads == want.leads ? state.speed : HandSpeed(HandSpeed::Zero());
  const HandSpeed target = assists
                               ? along_design(range, ask, now, state.plans ? state.tip : now.tip,
                                              state.released, want.cap)
                               : target_of(range, want.leads, ask, state.released);
  if (assists) {
    if (target.head<2>().isZero(0.0)) {
      want.stops_mps2 = state.stops_mps2 > 0.0 ? state.stops_mps2
                                               : stops_mps2(ask.mode_radps, last.head<2>().norm());
      range.change_ps[kUp] = want.stops_mps2;
    } else {
      range.change_ps[kUp] += kAssistGrows_ps * last.head<2>().norm();
    }
  }
  want.speed = softened(range, want.leads, target, last, period_s);
  hold_outside(range, want.leads, ask, want.speed);
  if (!profile.has_swing()) {
    want.speed = with_swing(want.speed, 0.0);
  }
  if (want.leads) {
    lead_teeth(drives, kinematics, now, servo, ask.design.at, state, want);
  } else {
    slow_each(drives, strokes_then_m(drives, servo), want);
    want.moves = !want.wanted_mps.isZero(0.0);
  }
  return want;
}

HandState next_by_hand(const LineProfile& line, const HandWant& want, const HandAsk& ask,
                       const HandState& last, double followed_ratio, double period_s) {
  HandState next;
  const auto rests = [](double ratio) { return ratio == 0.0; };
  next.released =
      last.released || std::all_of(ask.lever_ratio.begin(), ask.lever_ratio.end(), rests);
  next.speed = want.speed;
  next.leads = want.leads;
  next.assist = want.assist;
  if (!want.leads || !want.moves) {
    return next;
  }
  const bool assists = want.assist == AssistState::kHolds;
  next.stops_mps2 = want.stops_mps2;
  next.plans = true;
  next.is_new = !last.plans;
  const double by_s = last.pace_ratio * want.cap.factor * followed_ratio * period_s;
  next.tip = moved(want.tip, want.speed, by_s);
  next.planned_m = want.planned_m + followed_ratio * period_s * want.wanted_mps;
  const double slow_m =
      assists ? kAssistSlow_m : line.slow_error_m + line.slow_error_s * want.speed.head<2>().norm();
  const double off = want.error_m / slow_m;
  const double rise = (assists ? kAssistPace_ps : line.pace_rate_ps) * period_s;
  const double fall = assists ? 1.0 : rise;
  next.pace_ratio =
      std::clamp(1.0 / (1.0 + off * off), last.pace_ratio - fall, last.pace_ratio + rise);
  return next;
}

}  // namespace graben
