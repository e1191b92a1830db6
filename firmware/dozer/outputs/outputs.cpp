// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/outputs/outputs.hpp"

#include <algorithm>

namespace graben {
namespace {

/// A limit from outside counts at once: the lead of a speed that falls so fast must not turn a
/// track round, and one that is to stand has no displacement.
double held_ratio(double track_mps, double pump_ratio) {
  const double along = track_mps < 0.0 ? -1.0 : 1.0;
  return track_mps == 0.0 ? 0.0 : along * std::max(0.0, along * pump_ratio);
}

/// Blade and tracks a cycle on, before the gate.
DozerCommand commanded(const DozerProfile& profile, const DozerValid& valid,
                       const BladeMotion& motion, const Travel& travel, double period_s,
                       std::array<TrackState, kTrackCount>& state) {
  DozerCommand command;
  command.opening = motion.opening;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    const TrackCommand track =
        control_track(profile, state[i], travel.track_mps[i],
                      believed_track_mps(profile.hst, valid, i), valid.engine_radps, period_s);
    state[i] = track.state;
    command.pump_ratio[i] = valid.external.speed_ratio < 1.0
                                ? held_ratio(travel.track_mps[i], track.displacements.pump_ratio)
                                : track.displacements.pump_ratio;
    command.motor_ratio[i] = track.displacements.motor_ratio;
  }
  return command;
}

/// What is tried, as it is.
DozerCommand as_tried(const TriedCommand& tried) {
  DozerCommand command;
  command.tries = true;
  command.tried_ratio = tried.duty_ratio;
  command.pump_ratio = {tried.pump_ratio, tried.pump_ratio};
  command.motor_ratio = {tried.motor_ratio, tried.motor_ratio};
  return command;
}

}  // namespace

void put_out(const DozerModel& machine, const DozerValid& valid, const BladeMotion& motion,
             const Travel& travel, const TriedCommand& tried, double period_s,
             ModeDecision& decision, DozerOutputState& state, DozerOutputs& outputs) {
  const DozerProfile& profile = machine.profile;
  const DozerCommand command =
      tried.tries ? as_tried(tried)
                  : commanded(profile, valid, motion, travel, period_s, state.track);
  const DozerGateResult gated =
      gate_dozer(profile, machine.drives, decision.active(), command, period_s, state.gate);
  take_refusal(gated.fault, decision);
  if (!decision.active() || tried.tries) {
    state.track = {};
  }
  state.brake = brake(state.brake, decision.mode, valid, period_s);
  outputs.enable = gated.enable;
  outputs.blade_duty_ratio = gated.duty_ratio[kBladeLift];
  outputs.tilt_duty_ratio = gated.duty_ratio[kBladeTilt];
  outputs.tilts = profile.tilt.present;
  outputs.pump_ratio = gated.pump_ratio;
  outputs.motor_ratio = gated.motor_ratio;
  outputs.brake = state.brake.wanted;
}

}  // namespace graben
