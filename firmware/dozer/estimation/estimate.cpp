// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/estimation/estimate.hpp"

#include <cmath>

#include "firmware/dozer/estimation/situation.hpp"
#include "firmware/dozer/travel/tracks.hpp"

namespace graben {
namespace {

void tell_servos(const DozerModel& machine, const DozerValid& valid, const Cycle& cycle,
                 const DozerLastCycle& last, std::array<ServoState, kBladeCount>& servo) {
  for (int i = 0; i < machine.drives.count(); ++i) {
    const auto n = static_cast<unsigned>(i);
    servo_after(machine.drives[i], cycle.last_mode, last.asked_mps[n], valid.drive[n].stroke_m,
                cycle.elapsed_s, servo[n]);
  }
}

FlowSituation flow_now(const DozerValid& valid, const DozerLastCycle& last,
                       const std::array<ServoState, kBladeCount>& servo) {
  return {{due_mps(servo[kBladeLift]), due_mps(servo[kBladeTilt])},
          {valid.blade().stroke_m, valid.tilt().stroke_m},
          last.commands.drives.moving ? valid.engine_radps : 0.0};
}

/// Follows what happens if the ground before the blade lets go of it.
void watch_fall(const DozerModel& machine, const DozerValid& valid, double period_s,
                const DozerLastCycle& last, DozerEstimates& state) {
  const DozerProfile& profile = machine.profile;
  const double raise_mps = profile.travel.flow_share *
                           available_flow_m3ps(profile.implement, valid.engine_radps) /
                           profile.blade.rod_area_m2();
  const DozerControl& control = profile.control;
  // From where the first of what is asked for now arrives: what is under way is no fall.
  const double asked_mps = last.asked_mps[kBladeLift];
  const double stroke_m = valid.blade().stroke_m + control.dead_time_s * asked_mps;
  const double lead_s = control.pose_latency_s + control.dead_time_s;
  const FallSituation now{driven(machine, valid, state, last, lead_s), stroke_m, asked_mps,
                          control.response_s, raise_mps};
  state.fall =
      next_fall(profile, machine.blade, state.ground, state.design, state.fall, now, period_s);
}

/// How far the pass has come with the edge there, `now`, and what it has cut.
void tell_pass(const DozerModel& machine, const DozerValid& valid, const BladeSituation& now,
               const Stand& stand, double period_s, DozerEstimates& state) {
  const DozerProfile& profile = machine.profile;
  const Eigen::Vector3d edge_m = edge_in_world_m(machine.blade, now.body, now.angle_rad);
  const double edge_height_m = edge_m.z() - now.aside_m;
  double error_m = grade_error_m(machine.design, edge_m.x(), edge_height_m);
  if (profile.tilt.present) {
    error_m += at_ends_m(machine,
                         cross_error(machine.design, tilt_at(machine, now, valid.tilt().stroke_m)));
  }
  state.in_pass = {edge_m.x(), error_m, valid.velocity_mps,
                   state.load.push_n / profile.travel.push_max_n, state.load.lift_m};
  const PassState pass = next_pass(profile.grade, state.pass, state.in_pass, period_s);
  if (pass.pass != state.pass.pass) {
    state.ground.turn_back(edge_m.x());
    state.design.set_floor(pass_floor_m(profile.grade, pass));
  }
  state.pass = pass;
  state.ground.pass(edge_m.x(), edge_height_m, state.design, now.body.position_m.x(),
                    stand.height_m, std::tan(stand.pitch_rad), !state.pass.down);
}

}  // namespace

DozerEstimates::DozerEstimates(const GradeProfile& whole, const GradeDesign& grade)
    : design(whole) {
  design.set_floor(pass_floor_m(grade, pass));
}

void estimate(const DozerModel& machine, const DozerValid& valid, const Cycle& cycle,
              const DozerLastCycle& last, DozerEstimates& state, Preview& preview) {
  const DozerProfile& profile = machine.profile;
  const double period_s = cycle.period_s;
  if (!valid.faults.has(Fault::kPoseMissing) && !valid.faults.has(Fault::kStrokeMissing)) {
    state.position = next_position(state.position, valid.position_m, valid.velocity_mps, period_s);
    state.load = state.pass.phase == PassPhase::kCut
                     ? next_load(profile, state.load, valid, period_s)
                     : PushState{};
    next_foretelling(profile.body, state.ground, state.design, driving_of(machine, valid, state),
                     period_s, state.foretelling);
    if (profile.control.learns) {
      state.flow =
          next_flow_share(profile, state.flow, flow_now(valid, last, state.servo), period_s);
    }
    watch_fall(machine, valid, period_s, last, state);
    const double latency_s = profile.control.pose_latency_s;
    const BladeSituation now =
        situation_of(machine, valid, state, driven(machine, valid, state, last, latency_s),
                     latency_s, valid.blade().stroke_m);
    const Stand stand{now.body.position_m.z() - raised_m(valid, state, valid.position_m),
                      now.pitch_rad};
    tell_pass(machine, valid, now, stand, period_s, state);
    preview.look(state.ground, state.design,
                 state.position.position_m + latency_s * valid.velocity_mps, stand,
                 planned_share(profile.travel, state.load) * state.flow.share *
                     available_flow_m3ps(profile.implement, valid.engine_radps),
                 track_speed_max_mps(profile.hst, valid.engine_radps));
  }
  tell_servos(machine, valid, cycle, last, state.servo);
}

void estimates_after(const GradeDesign& grade, bool active, DozerEstimates& state) {
  if (!active || state.pass.phase != PassPhase::kCut) {
    state.fall = {};
  }
  if (active) {
    return;
  }
  state.load = {};
  if (state.pass.pass > 1) {
    state.design.set_floor(pass_floor_m(grade, PassState{}));
  }
  state.pass = {};
}

}  // namespace graben
