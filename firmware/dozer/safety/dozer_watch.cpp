#include "firmware/dozer/safety/dozer_watch.hpp"

namespace graben {
namespace {

/// The spool against its duty, the valve's echo against our enable.
FaultSet watch_valve(const DozerProfile& profile, const DozerLastCycle& cycle,
                     const ValidDozerInputs& inputs, DozerWatchState& state) {
  const bool received = !inputs.faults.has(Fault::kSpoolMissing);
  const bool stuck =
      profile.bus.spool_feedback &&
      follow_spool(
          {profile.control.dead_time_s, profile.safety.settle_s, profile.safety.spool_tolerance},
          state.spool, cycle.blade_duty_ratio, received, inputs.blade_spool_ratio);
  state.echo_cycles = received && profile.bus.valve_echo
                          ? echo_cycles(state.echo_cycles, cycle.enable, inputs.valve_enabled)
                          : 0;
  state.closing = cycle.moving || still_closing(state.closing, spool_centred(profile, inputs),
                                                Fault::kSpoolMissing, inputs);
  FaultSet stops;
  if (state.closing && stuck) {
    stops.add(Fault::kSpoolStuck);
  }
  if (state.echo_cycles >= kEchoCycles) {
    stops.add(Fault::kValveNotFollowing);
  }
  return stops;
}

FaultSet watch_blade(const DozerProfile& profile, const DozerLastCycle& cycle,
                     const ValidDozerInputs& inputs, double period_s, DozerWatchState& state) {
  const bool measured = profile.bus.spool_feedback;
  const double unseen_s =
      measured ? 0.0 : spool_arrives_s(profile.control.dead_time_s, profile.safety.settle_s);
  const CylinderWatchResult blade = watch_cylinder(
      {profile.implement.spool_to_duty.y_first(), profile.safety.uncommanded_m,
       profile.safety.stuck_m, kCylinderSettle_s + unseen_s},
      state.blade,
      {inputs.blade_stroke_m, measured ? inputs.blade_spool_ratio : cycle.blade_duty_ratio,
       cycle.asked_mps},
      period_s);
  state.blade = blade.state;
  FaultSet stops;
  if (blade.uncommanded) {
    stops.add(Fault::kUncommandedMotion);
  }
  if (blade.stuck) {
    stops.add(Fault::kStrokeStuck);
  }
  return stops;
}

DisplacementTask displacement_task(bool returning, const DozerLastCycle& cycle,
                                   const ValidDozerInputs& inputs) {
  if (!returning || inputs.faults.has(Fault::kTransmissionMissing)) {
    return DisplacementTask::kNone;
  }
  return cycle.moving ? DisplacementTask::kFollow : DisplacementTask::kReturn;
}

}  // namespace

ValidDozerInputs watch(const DozerProfile& profile, DozerWatchState& state,
                       const DozerLastCycle& cycle, const ValidDozerInputs& inputs,
                       double period_s) {
  ValidDozerInputs watched = inputs;
  FaultSet stops = watch_valve(profile, cycle, inputs, state);
  // Without stroke and spool the blade cannot be judged, and the fault is there anyway.
  if (cycle.moving && inputs.fault == Fault::kNone) {
    stops.add(watch_blade(profile, cycle, inputs, period_s, state));
  } else {
    state.blade = {};
  }
  state.returning = cycle.moving || still_closing(state.returning, pumps_neutral(profile, inputs),
                                                  Fault::kTransmissionMissing, inputs);
  const TransmissionWatchResult transmission =
      watch_transmission(profile, state.transmission, {cycle.pump_ratio, cycle.motor_ratio},
                         displacement_task(state.returning, cycle, inputs), inputs, period_s);
  stops.add(transmission.stops);
  if (transmission.tracks_disagree) {
    degrade(Fault::kTrackSpeedDisagrees, watched);
  }
  stop(stops, watched);
  state.slowing = slow_down(profile.safety.degraded_speed_ratio, state.slowing, cycle.moving,
                            period_s, watched);
  return watched;
}

bool spool_centred(const DozerProfile& profile, const ValidDozerInputs& valid) {
  return !profile.bus.spool_feedback ||
         spool_centred(valid.blade_spool_ratio, profile.safety.spool_tolerance);
}

}  // namespace graben
