#include "firmware/safety/watch.hpp"

#include <algorithm>

namespace graben {
namespace {

constexpr double kSlowAfter_s = 0.5;

/// What was degraded a moment ago still is: a value that comes and goes must not make the machine
/// jerk.
void slow_down(const ExcavatorProfile& profile, const WatchState& last, bool moving,
               double period_s, WatchResult& result) {
  if (!moving) {
    return;
  }
  WatchState& state = result.state;
  ValidInputs& inputs = result.inputs;
  state.slowing = last.slowing;
  if (!inputs.degraded.empty()) {
    state.slowing.add(inputs.degraded);
    state.slow_for_s = kSlowAfter_s;
  } else {
    state.slow_for_s = std::max(0.0, last.slow_for_s - period_s);
    if (state.slow_for_s <= 0.0) {
      state.slowing = {};
    }
  }
  inputs.degraded = state.slowing;
  if (!inputs.degraded.empty()) {
    inputs.speed_override_ratio *= profile.safety.degraded_speed_ratio;
  }
}

/// Whether the spools have still to close after motion. What is not known does not end it.
bool still_closing(const ExcavatorProfile& profile, bool last, const ValidInputs& inputs) {
  const bool centred = !inputs.faults.has(Fault::kSpoolMissing) && spools_centred(profile, inputs);
  const bool by_hand = !inputs.faults.has(Fault::kOperatorMissing) && !inputs.automatic;
  return last && !centred && !by_hand;
}

void stop(const FaultSet& faults, ValidInputs& inputs) {
  inputs.faults.add(faults);
  if (inputs.fault == Fault::kNone) {
    inputs.fault = faults.first();
  }
}

void degrade(Fault fault, ValidInputs& inputs) {
  inputs.faults.add(fault);
  inputs.degraded.add(fault);
}

}  // namespace

WatchResult watch(const ExcavatorProfile& profile, const WatchState& last, const LastCycle& cycle,
                  const ValidInputs& inputs, double period_s) {
  WatchResult result;
  result.inputs = inputs;
  WatchState& state = result.state;

  SpoolWatchResult spools = watch_spools(profile, last.spool, cycle.sent, inputs);
  state.spool = spools.state;
  FaultSet stops;
  if (spools.faults.has(Fault::kValveNotFollowing)) {
    stops.add(Fault::kValveNotFollowing);
  }
  state.closing = cycle.moving || still_closing(profile, last.closing, inputs);
  if (state.closing && spools.faults.has(Fault::kSpoolStuck)) {
    stops.add(Fault::kSpoolStuck);
  }
  std::array<double, kPumpCount> flow_swash_ratio = inputs.swash_ratio;
  // Without their strokes and spools the cylinders cannot be judged, and the fault is there anyway.
  if (cycle.moving && inputs.fault == Fault::kNone) {
    const MotionWatchResult motion =
        watch_motion(profile, last.motion, inputs, cycle.asked_mps, period_s);
    state.motion = motion.state;
    stops.add(motion.faults);
    const PressureWatchResult pressures = watch_pressures(profile, last.pressure, inputs, period_s);
    state.pressure = pressures.state;
    for (unsigned i = 0; i < kAxisCount; ++i) {
      if (pressures.wrong[i]) {
        result.inputs.load_known[i] = false;
        degrade(Fault::kPressureImplausible, result.inputs);
      }
    }
    const SwashWatchResult swash =
        watch_swash(profile, last.swash, cycle.sent.enable, inputs.swash_ratio, period_s);
    state.swash = swash.state;
    flow_swash_ratio = swash.flow_swash_ratio;
    if (swash.disagrees) {
      degrade(Fault::kSwashDisagrees, result.inputs);
    }
  }
  stop(stops, result.inputs);
  slow_down(profile, last, cycle.moving, period_s, result);
  result.pump_flow_m3ps = pump_flow_m3ps(profile, inputs.engine_radps, flow_swash_ratio);
  return result;
}

}  // namespace graben
