// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/motion/motion.hpp"

#include "firmware/dozer/tuning.hpp"

namespace graben {
namespace {

/// The blade now, and when the cylinders answer what is asked for now.
struct NowAndThen {
  BladeSituation now;
  BladeSituation then;
};

/// What the blade is to leave standing there.
BladeLift lift_at(const DozerModel& machine, const DozerEstimates& estimates,
                  const Preview& preview, const Driving& driving) {
  BladeLift lift{estimates.load.lift_m + estimates.pass.clear_m, 0.0,
                 estimates.load.rate_mps + estimates.pass.clear_mps};
  if (estimates.pass.phase != PassPhase::kCut) {
    return lift;
  }
  const BladeLift planned =
      preview.lift(driving.x_m, driving.speed_mps, lift_most_m(machine.profile));
  const bool falls = estimates.fall.lift_m > planned.height_m;
  lift.height_m += falls ? estimates.fall.lift_m : planned.height_m;
  lift.slope = falls ? 0.0 : planned.slope;
  lift.rate_mps += falls ? estimates.fall.rate_mps : 0.0;
  return lift;
}

BladeSituation foretold(const DozerModel& machine, const DozerValid& valid,
                        const DozerEstimates& estimates, const Preview& preview,
                        const DozerLastCycle& last, double lead_s, double stroke_m) {
  const Driving there = driven(machine, valid, estimates, last, lead_s);
  BladeSituation at = situation_of(machine, valid, estimates, there, lead_s, stroke_m);
  at.lift = lift_at(machine, estimates, preview, there);
  return at;
}

void move_lift(const DozerModel& machine, const NowAndThen& at, double period_s,
               const DozerLastCycle& last, const GradeProfile& design, const BladeState& state,
               BladeMotion& motion) {
  const DozerProfile& profile = machine.profile;
  // What the tilt took in the last cycle the lift has not; 0 of a blade without.
  const double for_lift_m3ps =
      motion.available_flow_m3ps - inflow_m3ps(profile.tilt, last.asked_mps[kBladeTilt]);
  motion.blade = control_blade(profile, machine.drives[kBladeLift], machine.blade, design, state,
                               at.now, at.then, for_lift_m3ps, period_s);
  motion.required_flow_m3ps = inflow_m3ps(profile.blade, motion.blade.feed_forward_mps);
  motion.opening[kBladeLift] = opening_for(profile, motion.blade.velocity_mps);
  motion.asked_mps[kBladeLift] =
      fed_mps(profile.blade, motion.blade.velocity_mps, motion.available_flow_m3ps);
}

void move_tilt(const DozerModel& machine, const DozerValid& valid, const NowAndThen& at,
               const DozerEstimates& estimates, double period_s, const DozerLastCycle& last,
               const TiltState& state, BladeMotion& motion) {
  const TiltProfile& tilt = machine.profile.tilt;
  const DriveRow& drive = machine.drives[kBladeTilt];
  const double stroke_m = stroke_then_m(drive, estimates.servo[kBladeTilt]);
  motion.tilt = control_tilt(tilt, drive, machine.tilt, estimates.design, state,
                             tilt_at(machine, at.now, valid.tilt().stroke_m),
                             tilt_at(machine, at.then, stroke_m), last.fed, period_s);
  motion.required_flow_m3ps += inflow_m3ps(tilt, motion.tilt.feed_forward_mps);
  motion.opening[kBladeTilt] = opening_for(tilt, motion.tilt.velocity_mps);
  motion.asked_mps[kBladeTilt] = motion.tilt.velocity_mps;
  const double asked_m3ps = inflow_m3ps(machine.profile.blade, motion.blade.velocity_mps) +
                            inflow_m3ps(tilt, motion.tilt.velocity_mps);
  motion.fed = asked_m3ps <= motion.available_flow_m3ps;
  if (!motion.fed) {
    const double share = motion.available_flow_m3ps / asked_m3ps;
    motion.asked_mps = {share * motion.blade.velocity_mps, share * motion.tilt.velocity_mps};
  }
}

/// Somebody outside stops: the blade too.
void stand(BladeMotion& motion) {
  motion.blade.velocity_mps = 0.0;
  motion.tilt.velocity_mps = 0.0;
  motion.opening = {};
  motion.asked_mps = {};
  motion.required_flow_m3ps = 0.0;
}

}  // namespace

double lift_most_m(const DozerProfile& profile) {
  return kGradeLiftShare * profile.grade.tolerance_m;
}

BladeMotion wanted_motion(const DozerModel& machine, const DozerValid& valid,
                          const DozerEstimates& estimates, const Preview& preview, double period_s,
                          const DozerLastCycle& last, const BladeMotionState& state) {
  const DozerProfile& profile = machine.profile;
  BladeMotion motion;
  motion.available_flow_m3ps = available_flow_m3ps(profile.implement, valid.engine_radps);
  const double latency_s = profile.control.pose_latency_s;
  const double lead_s = latency_s + profile.control.dead_time_s + profile.control.response_s;
  const double then_m = stroke_then_m(machine.drives[kBladeLift], estimates.servo[kBladeLift]);
  const NowAndThen at = {
      foretold(machine, valid, estimates, preview, last, latency_s, valid.blade().stroke_m),
      foretold(machine, valid, estimates, preview, last, lead_s, then_m)};
  move_lift(machine, at, period_s, last, estimates.design, state.blade, motion);
  if (profile.tilt.present) {
    move_tilt(machine, valid, at, estimates, period_s, last, state.tilt, motion);
  }
  if (valid.external.stops()) {
    stand(motion);
  }
  return motion;
}

void go_on(const BladeMotion& motion, bool active, BladeMotionState& state) {
  state.blade = active ? motion.blade.state : BladeState{};
  state.tilt = active ? motion.tilt.state : TiltState{};
}

}  // namespace graben
