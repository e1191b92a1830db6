// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/status/status.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/status/tuning.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

/// It is laid around a path or a plan.
bool has_tube(Task task) {
  return is_by_field(task) || task == Task::kProgram || task == Task::kCoordinated ||
         task == Task::kAssist;
}

/// Teeth less a place of the ground frame, as the links look: outwards, to the left, up.
Eigen::Vector3d off_place_m(const TeethPlace& teeth, const Eigen::Vector3d& place_m) {
  const double cosine = std::cos(teeth.swing_rad);
  const double sine = std::sin(teeth.swing_rad);
  return {teeth.out_m - place_m.x() * cosine - place_m.y() * sine,
          place_m.x() * sine - place_m.y() * cosine, teeth.up_m - place_m.z()};
}

}  // namespace

void tell_seen(const ExcavatorModel& machine, const InputState& inputs,
               const EstimationState& estimates, ExcavatorStatus& status) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    const DriveRow& drive = machine.drives[axis];
    const LearntValve& valve = inputs.watch.drives.learnt[k];
    status.edges[k] = {{is_edge_known(valve.extend), learnt_edge_ratio(drive, valve, true)},
                       {is_edge_known(valve.retract), learnt_edge_ratio(drive, valve, false)}};
  }
  status.tip_load = estimates.load_observer.told;
  status.joints = inputs.joints;
}

void check_touches(const ExcavatorModel& machine, const TaskBook& book, const ExcavatorValid& valid,
                   const KinematicState& pose, const Signal<TouchWord>& touch, double turning_radps,
                   TimeUs now_us, double elapsed_s, LastCycle& last, ExcavatorStatus& status) {
  const ExcavatorProfile& profile = machine.profile;
  SiteState& site = last.site;
  MarkSeen seen;
  read_touch(touch, now_us, seen);
  seen.by_hand = valid.by_hand();
  seen.at_rest = spools_centred(machine.drives, valid.drive);
  seen.known = is_place_known(valid.faults) && pose.status == ReachStatus::kOk;
  const double swing_rad =
      profile.has_swing() ? valid.drive[kSwing].stroke_m / profile.swing.lever_m : 0.0;
  begin_site(book.site, swing_rad, site);
  if (profile.imu.has_body() && profile.has_swing()) {
    watch_tracks(turning_radps, swing_rad, elapsed_s, site);
  }
  const Eigen::Vector2d& foot_m = profile.geometry.boom_foot_m;
  TeethPlace teeth = {foot_m.x() + pose.tip.x_m, swing_rad, foot_m.y() + pose.tip.y_m};
  seen.off_m = off_place_m(
      teeth, profile.mark.known() ? profile.mark.place_m : Eigen::Vector3d(kNoMark_m, 0.0, 0.0));
  const FenceSet& fences = book.chosen(valid.task_number).fences;
  MarkTold& told = last.mark.told;
  if (next_mark(profile.mark, seen, elapsed_s, last.mark)) {
    // Without what that check has shown them off.
    teeth.out_m -= told.off_m.x();
    teeth.up_m -= told.off_m.z();
    told.touch = next_site(book.site, fences, seen.kind, teeth, site);
  }
  status.mark = told;
  status.site = static_cast<std::uint8_t>(has_design(fences) ? site.known : SiteKnown::kNone);
}

void tell_site(const TaskBook& book, const SiteState& site, ExcavatorValid& valid) {
  if (!has_design(book.chosen(valid.task_number).fences)) {
    return;
  }
  if (site.is_lost()) {
    warn(Fault::kFrameUnknown, valid);
  }
  if (valid.task == Task::kProgram && (site.is_lost() || site.placed)) {
    FaultSet faults;
    faults.add(Fault::kFrameUnknown);
    stop(faults, valid);
  }
}

void tell_motion(const ExcavatorModel& machine, const InputState& inputs, const Motion& motion,
                 const Followed& followed, const CommonValid& valid, ExcavatorStatus& status) {
  const McvSolution& solution = followed.solution;
  const bool waits = motion.task.pace_ratio < kPlanWaitsPace;
  const bool rises =
      !motion.tries && solution.status == SolveStatus::kOk && followed.of_way() < 1.0;
  status.lambda =
      motion.tries ? 1.0 : motion.cap.factor * motion.hand.cap.factor * followed.of_way();
  status.limit =
      held_by({valid.external.limit(),
               blocked_limit(inputs.watch.drives.blocked),
               solution.limit,
               motion.tries ? tried_limit(machine.drives, inputs.commission) : motion.cap.limit,
               {waits ? LimitKind::kOffPath : LimitKind::kNone, 0},
               {rises ? LimitKind::kRise : LimitKind::kNone, 0},
               degraded_limit(valid.degraded)});
  status.path_error_m = motion.path_error_m;
  std::copy_n(motion.wanted_mps.data(), kDriveCount, status.wanted_velocity_mps.begin());
  status.swings = machine.profile.has_swing();
  status.swing_wanted_radps = swing_of(drives_of(machine.profile, motion.wanted_mps));
  status.progress = motion.task.progress;
  status.assist = motion.hand.assist;
  std::copy_n(solution.point.pump_pressure_pa.begin(), kPumpCount, status.pump_pressure_pa.begin());
}

void remember(const ExcavatorModel& machine, const ExcavatorValid& valid, const InputState& inputs,
              const Motion& motion, const Followed& followed, const ModeDecision& decision,
              const OutputState& output, const SentDuties& sent, bool enable, double period_s,
              LastCycle& last) {
  const McvPoint& point = followed.solution.point;
  const bool active = decision.active();
  const double of_way = active ? followed.of_way() : 0.0;
  const double asked = active ? followed.all() : 0.0;
  const DriveVector asked_mps =
      asked * motion.cap.factor * (followed.as_wanted ? motion.wanted_mps : motion.corrected_mps);
  last.commands = {
      in_motion(decision.mode.mode), enable,          sent.duty_ratio,        {},    {}, {},
      last.commands.line_pa,         sent.lead_ratio, active && motion.tries, active};
  std::copy_n(asked_mps.data(), kDriveCount, last.commands.asked_mps.begin());
  for (int i = 0; i < machine.drives.count(); ++i) {
    const auto k = static_cast<unsigned>(i);
    last.commands.towards_mps[k] = motion.towards_mps[i];
    last.commands.opening[k] = output.opening[k];
    if (point.lambda > 0.0) {
      last.commands.line_pa[k] =
          point.pump_pressure_pa[static_cast<unsigned>(machine.valve.actuator[k].pump)];
    }
  }
  last.swash_ratio = output.pumps.swash_ratio;
  last.flow.lambda = active ? followed.lambda : 0.0;
  last.flow.of_corrected = active ? followed.of_corrected : 1.0;
  last.flow.line_pa = point.pump_pressure_pa;
  last.flow.yield_mpsn = {point.yield_mpsn[kBoom], point.yield_mpsn[kArm]};
  last.expected_mps = of_way * motion.cap.factor * motion.wanted_mps;
  last.swing_wanted_mps = swing_of(motion.task.wanted_mps);
  const bool by_lever = active && is_by_lever(valid.task);
  last.jogs = by_lever && !motion.hand.leads;
  const SafetyProfile& safety = machine.profile.safety;
  next_tube(active && has_tube(valid.task), motion.off_m, safety.tube_m, last.tube);
  // A plan that waits for its drives asks for motion though it wants none now.
  const bool plans = motion.task.holds && !motion.task.bides && valid.speed_override_ratio > 0.0;
  const bool blocked = any_blocked(inputs.watch.drives.blocked);
  // A lever that is held against an end or a fence is no stall.
  const double allowed = by_lever ? 1.0 : motion.cap.factor;
  next_stall(active, plans || !motion.wanted_mps.isZero(),
             blocked || motion.task.astray ? 0.0 : of_way * allowed * motion.task.pace_ratio,
             safety.stall_s, period_s, last.stall);
}

}  // namespace graben
