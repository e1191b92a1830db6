#include "firmware/dozer/dozer_controller.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/implement_flow.hpp"
#include "firmware/dozer/travel/track_speeds.hpp"

namespace graben {
namespace {

/// From a lower wanted speed to a slower machine: displacements, drive line, PI.
constexpr double kTravelLead_s = 0.2;

/// Straight ahead: the grade is followed along x.
constexpr double kHeading_radps = 0.0;

BladeSituation situation(const BladeKinematics& blade, const ValidDozerInputs& valid,
                         double available_flow_m3ps) {
  BladeSituation now;
  now.body.position_m = {valid.position_m, 0.0, valid.height_m};
  now.body.rotation = rotation_from_pitch(valid.pitch_rad);
  // Pitch is positive nose up, which is a turn about -y.
  now.body_velocity << valid.velocity_mps, 0.0, valid.climb_mps, 0.0, -valid.pitch_rate_radps, 0.0;
  now.angle_rad = blade.angle_rad(valid.blade_stroke_m);
  now.available_flow_m3ps = available_flow_m3ps;
  return now;
}

/// A track's speed. Where one of them is not that of its displacements, none is believed: feedback
/// of a wrong one would drive its track off.
double speed_of_track_mps(const HstProfile& hst, const ValidDozerInputs& valid, unsigned track) {
  return valid.degraded.has(Fault::kTrackSpeedDisagrees)
             ? track_speed_mps(hst, valid.engine_radps, valid.pump_ratio[track],
                               valid.motor_ratio[track])
             : valid.track_speed_mps[track];
}

/// What holds the commanded motion: the blade's reach before flow, transmission and what lies ahead
/// before a lost sensor.
Limit reason(const SpeedChoice& speed, bool at_end, const FaultSet& degraded) {
  if (at_end) {
    return {LimitKind::kStrokeEnd, 0};
  }
  if (speed.limit.kind != LimitKind::kNone) {
    return speed.limit;
  }
  return degraded.empty()
             ? Limit{}
             : Limit{LimitKind::kDegraded, static_cast<std::uint8_t>(degraded.first())};
}

void describe_motion(const DozerProfile& profile, const SpeedChoice& speed,
                     const BladeCommand& blade, const FaultSet& degraded, DozerStatus& status) {
  status.lambda = std::clamp(speed.state.speed_mps / profile.travel.speed_desired_mps, 0.0, 1.0);
  status.limit = reason(speed, blade.at_end, degraded);
  status.wanted_speed_mps = speed.state.speed_mps;
  status.speed_limit_mps = speed.allowed_mps;
  status.wanted_blade_mps = blade.velocity_mps;
  status.grade_error_m = blade.error_m;
}

}  // namespace

DozerSetup::DozerSetup(const DozerProfile& machine)
    : profile(machine), blade(profile.blade), design(profile.grade) {}

DozerController::DozerController(const DozerSetup& setup)
    : profile_(setup.profile),
      blade_(setup.blade),
      design_(setup.design),
      preview_(profile_, blade_) {}

Fault DozerController::memory_fault() const {
  return memory_.mode.intact() && memory_.speed_mps.intact() ? Fault::kNone : Fault::kMemoryCorrupt;
}

ValidDozerInputs DozerController::judge(const DozerInputs& inputs, double period_s, TimeUs now_us) {
  const ValidDozerInputs valid =
      validate(inputs, profile_, memory_.validation, memory_.cycle.moving, now_us);
  memory_.validation = valid.state;
  return watch(profile_, memory_.watch, memory_.cycle, valid, period_s);
}

void DozerController::observe(const ValidDozerInputs& valid, double period_s) {
  const bool placed =
      !valid.faults.has(Fault::kPoseMissing) && !valid.faults.has(Fault::kStrokeMissing);
  if (!placed) {
    return;
  }
  memory_.position =
      next_position(memory_.position, valid.position_m, valid.velocity_mps, period_s);
  const BladeSituation now = situation(blade_, valid, 0.0);
  const Eigen::Vector3d edge_m = edge_in_world_m(blade_, now.body, now.angle_rad);
  ground_.pass(edge_m.x(), edge_m.z(), design_, valid.position_m, valid.height_m,
               std::tan(valid.pitch_rad));
  preview_.look(ground_, design_, memory_.position.position_m, {valid.height_m, valid.pitch_rad});
}

SpeedChoice DozerController::choose_speed(const ValidDozerInputs& valid, const Wanted& wanted,
                                          double period_s) const {
  SpeedDemand demand;
  demand.desired_mps = profile_.travel.speed_desired_mps * valid.speed_override_ratio;
  demand.grade_error_m = wanted.blade.error_m;
  demand.measured_mps = valid.velocity_mps;
  demand.required_flow_m3ps = wanted.required_flow_m3ps;
  demand.available_flow_m3ps = wanted.available_flow_m3ps;
  demand.engine_radps = valid.engine_radps;
  demand.heading_radps = kHeading_radps;
  demand.blade_angle_rad = blade_.angle_rad(valid.blade_stroke_m);
  demand.ahead =
      preview_.limit(memory_.position.position_m, memory_.speed_mps.value(),
                     profile_.travel.flow_share * wanted.available_flow_m3ps, kTravelLead_s);
  // The speed itself from where it has a complement.
  SpeedState last = memory_.speed;
  last.speed_mps = memory_.speed_mps.value();
  return next_speed(profile_, last, demand, period_s);
}

DozerController::Wanted DozerController::want(const ValidDozerInputs& valid, double period_s) {
  Wanted wanted;
  wanted.available_flow_m3ps = available_flow_m3ps(profile_.implement, valid.engine_radps);
  wanted.blade = control_blade(profile_, blade_, design_, memory_.blade,
                               situation(blade_, valid, wanted.available_flow_m3ps), period_s);
  wanted.required_flow_m3ps = inflow_m3ps(profile_.blade, wanted.blade.feed_forward_mps);
  wanted.speed = choose_speed(valid, wanted, period_s);
  wanted.command.opening = opening_for(profile_, wanted.blade.velocity_mps);
  const std::array<double, kTrackCount> speeds_mps =
      track_speeds_mps(profile_.body, wanted.speed.state.speed_mps, kHeading_radps);
  for (unsigned i = 0; i < kTrackCount; ++i) {
    const TrackCommand track =
        control_track(profile_, memory_.track[i], speeds_mps[i],
                      speed_of_track_mps(profile_.hst, valid, i), valid.engine_radps, period_s);
    memory_.track[i] = track.state;
    wanted.command.pump_ratio[i] = track.displacements.pump_ratio;
    wanted.command.motor_ratio[i] = track.displacements.motor_ratio;
  }
  return wanted;
}

void DozerController::keep(const Wanted& wanted, bool active) {
  if (active) {
    memory_.blade = wanted.blade.state;
    memory_.speed = wanted.speed.state;
    memory_.speed_mps = wanted.speed.state.speed_mps;
    return;
  }
  memory_.blade = {};
  memory_.speed = {};
  memory_.speed_mps = 0.0;
  memory_.track = {};
}

DozerOutputs DozerController::step(const DozerInputs& inputs, TimeUs now_us) {
  const CycleWatchResult time = watch_cycle(memory_.time, now_us);
  const Fault memory = memory_fault();
  const ValidDozerInputs valid = judge(inputs, time.period_s, now_us);
  observe(valid, time.period_s);
  const Wanted wanted = want(valid, time.period_s);
  const ModeRequest request =
      mode_request(first_of({time.fault, memory, valid.fault}), valid,
                   spool_centred(profile_, valid), inputs.link.stop_requested);
  ModeState mode = next_mode(stored_mode(memory_.mode), request);
  const DozerGateResult command =
      gate(profile_, memory_.gate, mode.mode == EcuMode::kActive, wanted.command, time.period_s);
  if (command.fault != Fault::kNone) {
    mode = {EcuMode::kFault, command.fault};
  }
  const bool active = mode.mode == EcuMode::kActive;
  DozerOutputs outputs;
  outputs.enable = command.enable;
  outputs.blade_duty_ratio = command.duty_ratio;
  outputs.pump_ratio = command.pump_ratio;
  outputs.motor_ratio = command.motor_ratio;
  const PilotResult pressure = pilot(memory_.pilot, mode, valid.faults);
  outputs.pilot_cut = pressure.cut;
  outputs.pilot_known = pressure.state.known;
  memory_.brake = brake(memory_.brake, mode, valid, time.period_s);
  outputs.brake = memory_.brake.wanted;
  static_cast<MachineStatus&>(outputs.status) = describe(mode, request, valid);
  if (active) {
    describe_motion(profile_, wanted.speed, wanted.blade, valid.degraded, outputs.status);
    outputs.status.required_flow_m3ps = wanted.required_flow_m3ps;
    outputs.status.available_flow_m3ps = wanted.available_flow_m3ps;
  }
  keep(wanted, active);
  memory_.mode = mode;
  memory_.gate = command.state;
  memory_.cycle = {in_motion(mode.mode), command.enable,
                   command.duty_ratio,   command.pump_ratio,
                   command.motor_ratio,  active ? wanted.blade.velocity_mps : 0.0};
  memory_.pilot = pressure.state;
  memory_.time = time.state;
  return outputs;
}

}  // namespace graben
