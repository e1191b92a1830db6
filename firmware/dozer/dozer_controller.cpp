// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/dozer_controller.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/travel/body_roll.hpp"
#include "firmware/dozer/travel/tracks.hpp"
#include "firmware/dozer/tuning.hpp"
#include "firmware/drives/velocity_cap.hpp"

namespace graben {
namespace {

/// A track's speed. Where one of them is not that of its displacements, none is believed, and one
/// that is outvoted never: feedback of a wrong one would drive its track off.
double speed_of_track_mps(const HstProfile& hst, const DozerValid& valid, unsigned track) {
  return valid.degraded.has(Fault::kTrackSpeedDisagrees) || valid.track_outvoted[track]
             ? track_speed_mps(hst, valid.engine_radps, valid.pump_ratio[track],
                               valid.motor_ratio[track])
             : valid.track_speed_mps[track];
}

}  // namespace

DozerSetup::DozerSetup(const DozerProfile& machine)
    : profile(machine),
      bank(dozer_bank(profile)),
      blade(profile.blade),
      tilt(profile.tilt),
      design(profile.grade) {}

DozerController::DozerController(const DozerSetup& setup)
    : setup_(setup), profile_(setup.profile), memory_(setup), preview_(profile_, setup.blade) {}

DozerController::Memory::Memory(const DozerSetup& setup) : design(setup.design) {
  design.set_floor(pass_floor_m(setup.profile.grade, pass));
}

DozerOutputs DozerController::step(const DozerInputs& inputs, TimeUs now_us) {
  const bool intact = memory_.unseal(setup_);
  const Cycle cycle = begin_cycle(memory_->cycle, intact, now_us);
  const DozerValid valid = validate_and_watch(inputs, cycle, now_us);
  estimate(valid, cycle.period_s);
  for (int i = 0; i < drives().count(); ++i) {
    const auto n = static_cast<unsigned>(i);
    servo_after(drives()[i], cycle.last_mode, memory_->asked_mps[n], valid.drive[n].stroke_m,
                cycle.elapsed_s, memory_->servo[n]);
  }
  const Motion motion = flow_limited(valid, cycle.period_s);
  ModeDecision decision =
      decide_mode(memory_->cycle, cycle, valid, Fault::kNone, spools_centred(drives(), valid.drive),
                  inputs.link.stop_requested);
  const DozerGateResult gated = gate_dozer(profile_, drives(), decision.active(), motion.command,
                                           cycle.period_s, memory_->gate);
  take_refusal(gated.fault, decision);
  memory_->brake = brake(memory_->brake, decision.mode, valid, cycle.period_s);
  DozerOutputs outputs;
  outputs.enable = gated.enable;
  outputs.blade_duty_ratio = gated.duty_ratio[kBladeLift];
  outputs.tilt_duty_ratio = gated.duty_ratio[kBladeTilt];
  outputs.tilts = profile_.tilt.present;
  outputs.pump_ratio = gated.pump_ratio;
  outputs.motor_ratio = gated.motor_ratio;
  outputs.brake = memory_->brake.wanted;
  end_cycle(decision, valid, memory_->cycle, outputs, outputs.status);
  if (decision.active()) {
    describe_motion(motion, valid.degraded, outputs.status);
  }
  remember(valid, motion, decision, gated, cycle.period_s);
  memory_.seal();
  return outputs;
}

DozerValid DozerController::validate_and_watch(const DozerInputs& inputs, const Cycle& cycle,
                                               TimeUs now_us) {
  DozerValid valid = validate(profile_, drives(), inputs, memory_->last.drives.moving, now_us,
                              memory_->validation);
  watch(profile_, drives(), memory_->last, cycle.elapsed_s, memory_->watch, valid);
  tell_stall(memory_->stall, profile_.safety.stall_s, valid);
  tell_tube(memory_->tube, valid);
  tell_tube(memory_->off_track, valid);
  choose_task(valid, cycle.period_s);
  return valid;
}

void DozerController::choose_task(DozerValid& valid, double period_s) {
  const bool at_rest = spools_centred(drives(), valid.drive) && tracks_at_rest(valid);
  const std::array<double, kBladeCount> stroke_m = {valid.blade().stroke_m, valid.tilt().stroke_m};
  const TaskChoice task = task_after_change(memory_->change, {valid.task, valid.task_number},
                                            memory_->last.drives.moving, at_rest,
                                            {stroke_m.data(), drives().count()}, period_s);
  valid.task = task.task;
}

void DozerController::estimate(const DozerValid& valid, double period_s) {
  if (valid.faults.has(Fault::kPoseMissing) || valid.faults.has(Fault::kStrokeMissing)) {
    return;
  }
  memory_->position =
      next_position(memory_->position, valid.position_m, valid.velocity_mps, period_s);
  memory_->load = memory_->pass.phase == PassPhase::kCut
                      ? next_load(profile_, memory_->load, valid, period_s)
                      : PushState{};
  next_foretelling(profile_.body, memory_->ground, memory_->design, driving_of(valid), period_s,
                   memory_->foretelling);
  memory_->flow = next_flow_share(profile_, memory_->flow, flow_now(valid), period_s);
  watch_fall(valid, period_s);
  const double latency_s = profile_.control.pose_latency_s;
  const BladeSituation now = foretold(valid, latency_s, valid.blade().stroke_m);
  const Eigen::Vector3d edge_m = edge_in_world_m(setup_.blade, now.body, now.angle_rad);
  const double edge_height_m = edge_m.z() - now.aside_m;
  const Stand stand{now.body.position_m.z() - raised_m(valid, valid.position_m), now.pitch_rad};
  double error_m = grade_error_m(setup_.design, edge_m.x(), edge_height_m);
  if (profile_.tilt.present) {
    error_m += at_ends_m(cross_error(setup_.design, tilt_at(now, valid.tilt().stroke_m)));
  }
  memory_->in_pass = {edge_m.x(), error_m, valid.velocity_mps,
                      memory_->load.push_n / profile_.travel.push_max_n, memory_->load.lift_m};
  const PassState pass = next_pass(profile_.grade, memory_->pass, memory_->in_pass, period_s);
  if (pass.pass != memory_->pass.pass) {
    memory_->ground.turn_back(edge_m.x());
    memory_->design.set_floor(pass_floor_m(profile_.grade, pass));
  }
  memory_->pass = pass;
  memory_->ground.pass(edge_m.x(), edge_height_m, memory_->design, now.body.position_m.x(),
                       stand.height_m, std::tan(stand.pitch_rad), !memory_->pass.down);
  preview_.look(memory_->ground, memory_->design,
                memory_->position.position_m + latency_s * valid.velocity_mps, stand,
                planned_share(profile_.travel, memory_->load) * memory_->flow.share *
                    available_flow_m3ps(profile_.implement, valid.engine_radps),
                track_speed_max_mps(profile_.hst, valid.engine_radps));
}

Driving DozerController::driven(const DozerValid& valid, double lead_s) const {
  return drive_on(profile_.body, memory_->ground, memory_->design, driving_of(valid),
                  {memory_->speed.speed_mps, kTravelLead_s}, lead_s, memory_->foretelling.bias);
}

void DozerController::watch_fall(const DozerValid& valid, double period_s) {
  const double raise_mps = profile_.travel.flow_share *
                           available_flow_m3ps(profile_.implement, valid.engine_radps) /
                           profile_.blade.rod_area_m2();
  const DozerControl& control = profile_.control;
  // From where the first of what is asked for now arrives: what is under way is no fall.
  const double asked_mps = memory_->asked_mps[kBladeLift];
  const double stroke_m = valid.blade().stroke_m + control.dead_time_s * asked_mps;
  const FallSituation now{driven(valid, control.pose_latency_s + control.dead_time_s), stroke_m,
                          asked_mps, control.response_s, raise_mps};
  memory_->fall = next_fall(profile_, setup_.blade, memory_->ground, memory_->design, memory_->fall,
                            now, period_s);
}

BladeSituation DozerController::foretold(const DozerValid& valid, double lead_s,
                                         double stroke_m) const {
  const DozerBody& body = profile_.body;
  const Driving driving = driven(valid, lead_s);
  const Stand stand = stand_of(body, driving.motion);
  BladeSituation at;
  at.body.position_m = {driving.x_m, 0.0, stand.height_m + raised_m(valid, driving.x_m)};
  at.body.rotation = rotation_from_pitch(stand.pitch_rad);
  at.pitch_rad = stand.pitch_rad;
  // Pitch is positive nose up, which is a turn about -y.
  at.body_velocity << driving.speed_mps, 0.0, origin_climb_mps(body, driving.motion), 0.0,
      -driving.motion.pitch_rate_radps, 0.0;
  at.angle_rad = setup_.blade.angle_rad(stroke_m);
  if (profile_.tilt.present) {
    const BodyRoll rolled =
        roll_after(body, memory_->design, {valid.roll_rad, valid.roll_rate_radps}, valid.position_m,
                   driving.x_m, driving.speed_mps, lead_s);
    at.body.rotation = rotation_from_pitch_and_roll(stand.pitch_rad, rolled.roll_rad);
    at.roll_rate_radps = rolled.rate_radps;
    at.body_velocity.tail<3>() +=
        rolled.rate_radps *
        Eigen::Vector3d(std::cos(stand.pitch_rad), 0.0, std::sin(stand.pitch_rad));
  }
  if (memory_->design.curves()) {
    place_on_curve(valid, lead_s, at);
  }
  at.lift = lift_at(driving);
  return at;
}

BladeLift DozerController::lift_at(const Driving& driving) const {
  BladeLift lift{memory_->load.lift_m + memory_->pass.clear_m, 0.0,
                 memory_->load.rate_mps + memory_->pass.clear_mps};
  if (memory_->pass.phase != PassPhase::kCut) {
    return lift;
  }
  const BladeLift planned = preview_.lift(driving.x_m, driving.speed_mps, lift_most_m());
  const bool falls = memory_->fall.lift_m > planned.height_m;
  lift.height_m += falls ? memory_->fall.lift_m : planned.height_m;
  lift.slope = falls ? 0.0 : planned.slope;
  lift.rate_mps += falls ? memory_->fall.rate_mps : 0.0;
  return lift;
}

void DozerController::place_on_curve(const DozerValid& valid, double lead_s,
                                     BladeSituation& at) const {
  const double x_m = at.body.position_m.x();
  const double reach_m = edge_in_world_m(setup_.blade, at.body, at.angle_rad).x() - x_m;
  const Course course =
      course_after(memory_->design, valid.course, valid.position_m, valid.velocity_mps, lead_s);
  const EdgeCourse edge = edge_course(memory_->design, x_m, course, reach_m);
  // What follows is of the edge: its station is what counts.
  at.body.position_m.x() += edge.ahead_m - reach_m;
  at.aside_m = memory_->design.cross_at(x_m + edge.ahead_m).slope * edge.offset_m;
  at.askew_rad = edge.heading_rad;
  at.askew_rate_radps =
      course.yaw_rate_radps - memory_->design.curvature_at(x_m + edge.ahead_m) * valid.velocity_mps;
}

TiltSituation DozerController::tilt_at(const BladeSituation& at, double stroke_m) const {
  TiltSituation tilt;
  tilt.body_rotation = at.body.rotation;
  tilt.roll_rate_radps = at.roll_rate_radps;
  tilt.blade_angle_rad = at.angle_rad;
  tilt.tilt_rad = setup_.tilt.angle_rad(stroke_m);
  tilt.edge_x_m = edge_in_world_m(setup_.blade, at.body, at.angle_rad).x();
  tilt.speed_mps = at.body_velocity[0];
  tilt.askew_rad = at.askew_rad;
  tilt.askew_rate_radps = at.askew_rate_radps;
  return tilt;
}

void DozerController::move_tilt(const DozerValid& valid, const BladeSituation& now,
                                const BladeSituation& then, double period_s, Motion& motion) const {
  const TiltProfile& tilt = profile_.tilt;
  const double stroke_m = stroke_then_m(drives()[kBladeTilt], memory_->servo[kBladeTilt]);
  motion.tilt = control_tilt(tilt, drives()[kBladeTilt], setup_.tilt, memory_->design,
                             memory_->tilt, tilt_at(now, valid.tilt().stroke_m),
                             tilt_at(then, stroke_m), memory_->fed, period_s);
  motion.required_flow_m3ps += inflow_m3ps(tilt, motion.tilt.feed_forward_mps);
  motion.command.opening[kBladeTilt] = opening_for(tilt, motion.tilt.velocity_mps);
  motion.asked_mps[kBladeTilt] = motion.tilt.velocity_mps;
  const double asked_m3ps = inflow_m3ps(profile_.blade, motion.blade.velocity_mps) +
                            inflow_m3ps(tilt, motion.tilt.velocity_mps);
  motion.fed = asked_m3ps <= motion.available_flow_m3ps;
  if (!motion.fed) {
    const double share = motion.available_flow_m3ps / asked_m3ps;
    motion.asked_mps = {share * motion.blade.velocity_mps, share * motion.tilt.velocity_mps};
  }
}

void DozerController::move_blade(const DozerValid& valid, double period_s, Motion& motion) const {
  const double latency_s = profile_.control.pose_latency_s;
  const double lead_s = latency_s + profile_.control.dead_time_s + profile_.control.response_s;
  const BladeSituation now = foretold(valid, latency_s, valid.blade().stroke_m);
  const BladeSituation then =
      foretold(valid, lead_s, stroke_then_m(drives()[kBladeLift], memory_->servo[kBladeLift]));
  // What the tilt took in the last cycle the lift has not; 0 of a blade without.
  const double for_lift_m3ps =
      motion.available_flow_m3ps - inflow_m3ps(profile_.tilt, memory_->asked_mps[kBladeTilt]);
  motion.blade = control_blade(profile_, drives()[kBladeLift], setup_.blade, memory_->design,
                               memory_->blade, now, then, for_lift_m3ps, period_s);
  motion.required_flow_m3ps = inflow_m3ps(profile_.blade, motion.blade.feed_forward_mps);
  motion.command.opening[kBladeLift] = opening_for(profile_, motion.blade.velocity_mps);
  motion.asked_mps[kBladeLift] =
      fed_mps(profile_.blade, motion.blade.velocity_mps, motion.available_flow_m3ps);
  if (profile_.tilt.present) {
    move_tilt(valid, now, then, period_s, motion);
  }
}

DozerController::Motion DozerController::flow_limited(const DozerValid& valid,
                                                      double period_s) const {
  Motion motion;
  motion.available_flow_m3ps = available_flow_m3ps(profile_.implement, valid.engine_radps);
  move_blade(valid, period_s, motion);
  if (memory_->design.curves()) {
    motion.off_track_m = edge_now(valid).offset_m;
    motion.steering = steer(
        memory_->design, memory_->steering,
        {valid.position_m, reach_m(), memory_->speed.speed_mps, valid.velocity_mps, valid.course},
        period_s);
  }
  motion.speed = choose_speed(valid, motion, period_s);
  const double speed_mps = motion.speed.state.speed_mps;
  std::array<double, kTrackCount> speeds_mps = {speed_mps, speed_mps};
  if (memory_->design.curves()) {
    speeds_mps = steered_mps(profile_.body, speed_mps,
                             {speed_of_track_mps(profile_.hst, valid, kLeft),
                              speed_of_track_mps(profile_.hst, valid, kRight)},
                             period_s, motion.steering);
  }
  for (unsigned i = 0; i < kTrackCount; ++i) {
    const TrackCommand track =
        control_track(profile_, memory_->track[i], speeds_mps[i],
                      speed_of_track_mps(profile_.hst, valid, i), valid.engine_radps, period_s);
    motion.track[i] = track.state;
    motion.command.pump_ratio[i] = track.displacements.pump_ratio;
    motion.command.motor_ratio[i] = track.displacements.motor_ratio;
  }
  return motion;
}

SpeedChoice DozerController::return_speed(double desired_mps, double period_s) const {
  const TravelProfile& travel = profile_.travel;
  const double wanted_mps = pass_speed_mps(memory_->pass, memory_->in_pass, desired_mps,
                                           0.5 * travel.deceleration_max_mps2);
  SpeedChoice choice;
  const double last_mps = memory_->speed.speed_mps;
  const bool slower = std::abs(wanted_mps) < std::abs(last_mps);
  const double step_mps =
      (slower ? travel.deceleration_max_mps2 : travel.acceleration_max_mps2) * period_s;
  choice.state.speed_mps = last_mps + std::clamp(wanted_mps - last_mps, -step_mps, step_mps);
  choice.allowed_mps = std::abs(wanted_mps);
  return choice;
}

SpeedChoice DozerController::choose_speed(const DozerValid& valid, const Motion& motion,
                                          double period_s) const {
  if (memory_->pass.phase != PassPhase::kCut) {
    return return_speed(profile_.travel.speed_desired_mps * valid.speed_override_ratio, period_s);
  }
  SpeedDemand demand;
  demand.desired_mps = profile_.travel.speed_desired_mps * valid.speed_override_ratio;
  demand.off_m = std::abs(motion.blade.off_m) + at_ends_m(motion.tilt.error);
  demand.measured_mps = valid.velocity_mps;
  demand.required_flow_m3ps = motion.required_flow_m3ps;
  demand.available_flow_m3ps = motion.available_flow_m3ps;
  demand.engine_radps = valid.engine_radps;
  demand.heading_radps = motion.steering.curvature_pm * memory_->speed.speed_mps;
  demand.blade_angle_rad = setup_.blade.angle_rad(valid.blade().stroke_m);
  demand.ahead = preview_.limit(
      memory_->position.position_m + profile_.control.pose_latency_s * valid.velocity_mps,
      memory_->speed.speed_mps, lift_most_m(), kTravelLead_s);
  demand.ahead.speed_mps = std::min(demand.ahead.speed_mps, memory_->fall.speed_mps);
  return next_speed(profile_, memory_->speed, demand, period_s);
}

void DozerController::describe_motion(const Motion& motion, const FaultSet& degraded,
                                      DozerStatus& status) const {
  const SpeedChoice& speed = motion.speed;
  status.lambda = std::clamp(speed.state.speed_mps / profile_.travel.speed_desired_mps, 0.0, 1.0);
  const Limit at_end = motion.blade.at_end ? drives()[kBladeLift].control.at_end : Limit{};
  const Limit tilt_at_end = motion.tilt.at_end ? drives()[kBladeTilt].control.at_end : Limit{};
  status.limit = held_by({at_end, tilt_at_end, speed.limit, degraded_limit(degraded)});
  status.wanted_speed_mps = speed.state.speed_mps;
  status.speed_limit_mps = speed.allowed_mps;
  status.wanted_blade_mps = motion.blade.velocity_mps;
  status.wanted_tilt_mps = motion.tilt.velocity_mps;
  status.grade_error_m = motion.blade.error_m;
  status.cross_error = motion.tilt.error;
  status.off_track_m = motion.off_track_m;
  status.pass = memory_->pass.pass;
  status.cutting = memory_->pass.phase == PassPhase::kCut;
  status.ground_left = memory_->pass.left;
  status.graded = memory_->pass.finished;
  status.required_flow_m3ps = motion.required_flow_m3ps;
  status.available_flow_m3ps = motion.available_flow_m3ps;
}

void DozerController::remember(const DozerValid& valid, const Motion& motion,
                               const ModeDecision& decision, const DozerGateResult& gated,
                               double period_s) {
  const bool active = decision.active();
  const bool cuts = active && memory_->pass.phase == PassPhase::kCut;
  // Above the ground it is where it is meant to be if it is on its lift; below it nothing excuses.
  const double error_m = motion.blade.error_m;
  const double excused_m = error_m > 0.0 ? std::max(0.0, motion.blade.off_m) : error_m;
  next_tube_above(cuts, excused_m + std::copysign(at_ends_m(motion.tilt.error), excused_m),
                  profile_.safety.tube_m, memory_->tube);
  next_tube(active && memory_->design.curves(), std::abs(motion.off_track_m), kMostOffTrack_m,
            memory_->off_track);
  const double got_mps =
      std::min(std::abs(motion.speed.state.speed_mps), std::abs(valid.velocity_mps));
  const PassPhase phase = memory_->pass.phase;
  const bool turning = phase == PassPhase::kStop || phase == PassPhase::kTurn;
  next_stall(active, valid.speed_override_ratio > 0.0 && !turning,
             got_mps / (profile_.travel.speed_desired_mps * valid.speed_override_ratio),
             profile_.safety.stall_s, period_s, memory_->stall);
  memory_->blade = active ? motion.blade.state : BladeState{};
  memory_->tilt = active ? motion.tilt.state : TiltState{};
  memory_->load = active ? memory_->load : PushState{};
  memory_->fall = cuts ? memory_->fall : FallState{};
  if (!active && memory_->pass.pass > 1) {
    memory_->design.set_floor(pass_floor_m(profile_.grade, PassState{}));
  }
  memory_->pass = active ? memory_->pass : PassState{};
  memory_->asked_mps = motion.asked_mps;
  memory_->fed = motion.fed;
  memory_->steering = active ? motion.steering : SteeringState{};
  memory_->speed = active ? motion.speed.state : SpeedState{};
  memory_->track = active ? motion.track : std::array<TrackState, kTrackCount>{};
  memory_->last = {
      {in_motion(decision.mode.mode),
       gated.enable,
       gated.duty_ratio,
       {active ? motion.blade.velocity_mps : 0.0, active ? motion.tilt.velocity_mps : 0.0}},
      {gated.pump_ratio, gated.motor_ratio}};
}

}  // namespace graben
