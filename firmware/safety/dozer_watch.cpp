#include "firmware/safety/dozer_watch.hpp"

namespace graben {
namespace {

/// The spool against its duty, the valve's echo against our enable.
FaultSet watch_valve(const DozerProfile& profile, const DozerWatchState& last,
                     const DozerLastCycle& cycle, const ValidDozerInputs& inputs,
                     DozerWatchState& state) {
  const bool received = !inputs.faults.has(Fault::kSpoolMissing);
  const SpoolFollowResult spool = follow_spool(
      {profile.control.dead_time_s, profile.safety.settle_s, profile.safety.spool_tolerance},
      last.spool, cycle.blade_duty_ratio, received, inputs.blade_spool_ratio);
  state.spool = spool.state;
  if (received) {
    state.echo_cycles = echo_cycles(last.echo_cycles, cycle.enable, inputs.valve_enabled);
  }
  state.closing = cycle.moving || still_closing(last.closing, spool_centred(profile, inputs),
                                                Fault::kSpoolMissing, inputs);
  FaultSet stops;
  if (state.closing && spool.stuck) {
    stops.add(Fault::kSpoolStuck);
  }
  if (state.echo_cycles >= kEchoCycles) {
    stops.add(Fault::kValveNotFollowing);
  }
  return stops;
}

FaultSet watch_blade(const DozerProfile& profile, const DozerWatchState& last,
                     const DozerLastCycle& cycle, const ValidDozerInputs& inputs, double period_s,
                     DozerWatchState& state) {
  const CylinderWatchResult blade = watch_cylinder(
      {profile.implement.spool_to_duty.y_first(), profile.safety.uncommanded_m,
       profile.safety.stuck_m},
      last.blade, {inputs.blade_stroke_m, inputs.blade_spool_ratio, cycle.asked_mps}, period_s);
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

DozerWatchResult watch(const DozerProfile& profile, const DozerWatchState& last,
                       const DozerLastCycle& cycle, const ValidDozerInputs& inputs,
                       double period_s) {
  // Afresh but for the histories, which would be filled for nothing.
  DozerWatchResult result{inputs, {last.spool, 0, {}, last.transmission, {}, false, false}};
  DozerWatchState& state = result.state;
  FaultSet stops = watch_valve(profile, last, cycle, inputs, state);
  // Without stroke and spool the blade cannot be judged, and the fault is there anyway.
  if (cycle.moving && inputs.fault == Fault::kNone) {
    stops.add(watch_blade(profile, last, cycle, inputs, period_s, state));
  }
  state.returning = cycle.moving || still_closing(last.returning, pumps_neutral(profile, inputs),
                                                  Fault::kTransmissionMissing, inputs);
  const TransmissionWatchResult transmission =
      watch_transmission(profile, last.transmission, {cycle.pump_ratio, cycle.motor_ratio},
                         displacement_task(state.returning, cycle, inputs), inputs, period_s);
  state.transmission = transmission.state;
  stops.add(transmission.stops);
  if (transmission.tracks_disagree) {
    degrade(Fault::kTrackSpeedDisagrees, result.inputs);
  }
  stop(stops, result.inputs);
  state.slowing = slow_down(profile.safety.degraded_speed_ratio, last.slowing, cycle.moving,
                            period_s, result.inputs);
  return result;
}

bool spool_centred(const DozerProfile& profile, const ValidDozerInputs& valid) {
  return spool_centred(valid.blade_spool_ratio, profile.safety.spool_tolerance);
}

}  // namespace graben
