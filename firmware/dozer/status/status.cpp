// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/status/status.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/estimation/situation.hpp"
#include "firmware/dozer/travel/tracks.hpp"
#include "firmware/dozer/tuning.hpp"
#include "firmware/drives/velocity_cap.hpp"

namespace graben {
namespace {

/// How far the edge is out of where it may be: above the ground it is where it is meant to be if it
/// is on its lift; below it nothing excuses.
double unexcused_m(const DozerModel& machine, const BladeMotion& motion) {
  const double error_m = motion.blade.error_m;
  const double excused_m = error_m > 0.0 ? std::max(0.0, motion.blade.off_m) : error_m;
  return excused_m + std::copysign(at_ends_m(machine, motion.tilt.error), excused_m);
}

/// Going slower than it is asked to, but for where it turns anyway.
void watch_stall(const DozerModel& machine, const DozerValid& valid, PassPhase phase,
                 const Travel& travel, bool active, double period_s, StallState& stall) {
  const double desired_mps = machine.profile.travel.speed_desired_mps * valid.speed_override_ratio;
  const double got_mps =
      std::min(std::abs(travel.speed.state.speed_mps), std::abs(valid.velocity_mps));
  const bool turning = phase == PassPhase::kStop || phase == PassPhase::kTurn;
  next_stall(active, valid.speed_override_ratio > 0.0 && !turning, got_mps / desired_mps,
             machine.profile.safety.stall_s, period_s, stall);
}

}  // namespace

void check_mark(const DozerModel& machine, const DozerValid& valid, const DozerEstimates& estimates,
                const Signal<TouchWord>& touch, TimeUs now_us, double elapsed_s, MarkState& state,
                DozerStatus& status) {
  const MarkProfile& mark = machine.profile.mark;
  if (!mark.known()) {
    return;
  }
  MarkSeen seen;
  read_touch(touch, now_us, seen);
  seen.by_hand = valid.by_hand();
  seen.at_rest = spools_centred(machine.drives, valid.drive) && tracks_at_rest(valid);
  seen.known = is_place_known(valid.faults);
  const BladeSituation now =
      situation_of(machine, valid, estimates, driving_of(machine, valid, estimates), 0.0,
                   valid.blade().stroke_m);
  // Of the edge's middle, and on a track that curves beside it.
  seen.off_m = edge_in_world_m(machine.blade, now.body, now.angle_rad) - mark.place_m;
  seen.off_m.y() = valid.course.offset_m - mark.place_m.y();
  next_mark(mark, seen, elapsed_s, state);
  status.mark = state.told;
}

void tell_motion(const DozerModel& machine, const PassState& pass, const BladeMotion& motion,
                 const Travel& travel, const CommonValid& valid, DozerStatus& status) {
  const SpeedChoice& speed = travel.speed;
  status.lambda =
      std::clamp(speed.state.speed_mps / machine.profile.travel.speed_desired_mps, 0.0, 1.0);
  const Limit at_end = motion.blade.at_end ? machine.drives[kBladeLift].control.at_end : Limit{};
  const Limit tilt_at_end =
      motion.tilt.at_end ? machine.drives[kBladeTilt].control.at_end : Limit{};
  status.limit = held_by(
      {valid.external.limit(), at_end, tilt_at_end, speed.limit, degraded_limit(valid.degraded)});
  status.wanted_speed_mps = speed.state.speed_mps;
  status.speed_limit_mps = speed.allowed_mps;
  status.wanted_blade_mps = motion.blade.velocity_mps;
  status.wanted_tilt_mps = motion.tilt.velocity_mps;
  status.grade_error_m = motion.blade.error_m;
  status.cross_error = motion.tilt.error;
  status.off_track_m = travel.off_track_m;
  status.pass = pass.pass;
  status.cutting = pass.phase == PassPhase::kCut;
  status.ground_left = pass.left;
  status.graded = pass.finished;
  status.required_flow_m3ps = motion.required_flow_m3ps;
  status.available_flow_m3ps = motion.available_flow_m3ps;
}

void tell_tried(const TriedCommand& tried, const CommonValid& valid, DozerStatus& status) {
  status.limit = held_by({valid.external.limit(), tried.limit, degraded_limit(valid.degraded)});
}

void remember(const DozerModel& machine, const DozerValid& valid, const DozerEstimates& estimates,
              const BladeMotion& motion, const Travel& travel, const TriedCommand& tried,
              const ModeDecision& decision, const DozerOutputs& outputs, double period_s,
              DozerLastCycle& last) {
  // What is tried is on no design, and nobody knows what comes of it.
  const bool active = decision.active() && !tried.tries;
  const PassPhase phase = estimates.pass.phase;
  next_tube_above(active && phase == PassPhase::kCut, unexcused_m(machine, motion),
                  machine.profile.safety.tube_m, last.tube);
  next_tube(active && estimates.design.curves(), std::abs(travel.off_track_m), kMostOffTrack_m,
            last.off_track);
  watch_stall(machine, valid, phase, travel, active, period_s, last.stall);
  last.asked_mps = active ? motion.asked_mps : std::array<double, kBladeCount>{};
  last.fed = motion.fed;
  last.commands = {
      {in_motion(decision.mode.mode),
       outputs.enable,
       {outputs.blade_duty_ratio, outputs.tilt_duty_ratio},
       {active ? motion.blade.velocity_mps : 0.0, active ? motion.tilt.velocity_mps : 0.0}},
      {outputs.pump_ratio, outputs.motor_ratio},
      active ? travel.speed.state.speed_mps : 0.0};
  last.commands.drives.active = decision.active();
  if (decision.active() && tried.tries) {
    last.commands.drives.tried = true;
    last.commands.speed_mps =
        track_speed_mps(machine.profile.hst, valid.engine_radps, outputs.pump_ratio[kLeft],
                        outputs.motor_ratio[kLeft]);
  }
}

}  // namespace graben
