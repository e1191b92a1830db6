#include "firmware/excavator/safety/excavator_watch.hpp"

namespace graben {

WatchResult watch(const ExcavatorProfile& profile, WatchState& state, const LastCycle& cycle,
                  const ValidInputs& inputs, double period_s) {
  WatchResult result;
  result.inputs = inputs;
  if (!profile.bus.spool_feedback) {
    result.inputs.spool_ratio = cycle.sent.duty_ratio;
  }

  const FaultSet spools = watch_spools(profile, state.spool, cycle.sent, inputs);
  FaultSet stops;
  if (spools.has(Fault::kValveNotFollowing)) {
    stops.add(Fault::kValveNotFollowing);
  }
  state.closing = cycle.moving || still_closing(state.closing, spools_centred(profile, inputs),
                                                Fault::kSpoolMissing, inputs);
  if (state.closing && spools.has(Fault::kSpoolStuck)) {
    stops.add(Fault::kSpoolStuck);
  }
  std::array<double, kPumpCount> flow_swash_ratio = inputs.swash_ratio;
  // Without their strokes and spools the cylinders cannot be judged, and the fault is there anyway.
  if (cycle.moving && inputs.fault == Fault::kNone) {
    const MotionWatchResult motion =
        watch_motion(profile, state.motion, result.inputs, cycle.asked_mps, period_s);
    state.motion = motion.state;
    stops.add(motion.faults);
    const PressureWatchResult pressures =
        watch_pressures(profile, state.pressure, result.inputs, period_s);
    state.pressure = pressures.state;
    for (unsigned i = 0; i < static_cast<unsigned>(profile.drive_count); ++i) {
      if (pressures.wrong[i]) {
        result.inputs.load_known[i] = false;
        degrade(Fault::kPressureImplausible, result.inputs);
      }
    }
    const SwashWatchResult swash =
        watch_swash(profile, state.swash, cycle.sent.enable, inputs.swash_ratio, period_s);
    state.swash = swash.state;
    flow_swash_ratio = swash.flow_swash_ratio;
    if (swash.disagrees) {
      degrade(Fault::kSwashDisagrees, result.inputs);
    }
  } else {
    state.motion = {};
    state.pressure = {};
    state.swash = {};
  }
  stop(stops, result.inputs);
  state.slowing = slow_down(profile.safety.degraded_speed_ratio, state.slowing, cycle.moving,
                            period_s, result.inputs);
  result.pump_flow_m3ps = pump_flow_m3ps(profile, inputs.engine_radps, flow_swash_ratio);
  return result;
}

}  // namespace graben
