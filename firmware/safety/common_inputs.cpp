// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/common_inputs.hpp"

#include <algorithm>

#include "firmware/safety/fault_table.hpp"
#include "firmware/safety/tuning.hpp"

namespace graben {
namespace {

void read_driver(const OperatorInputs& driver, const Freshness& fresh, CommonValid& valid) {
  valid.enable = fresh.holds(driver.enable) && driver.enable.value;
  if (!fresh.holds(driver.enable) || !fresh.holds(driver.mode) || !fresh.holds(driver.task) ||
      !fresh.number(driver.speed_override_ratio)) {
    valid.faults.add(Fault::kOperatorMissing);
    return;
  }
  valid.automatic = driver.mode.value == OperatorMode::kAutomatic;
  valid.task = driver.task.value;
  valid.task_number = fresh.holds(driver.task_number) ? driver.task_number.value : -1;
  valid.speed_override_ratio = std::clamp(driver.speed_override_ratio.value, 0.0, 1.0);
}

void read_bus(const LinkInputs& link, CommonValid& valid) {
  valid.faults.add(link.message_faults);
  if (link.bus != BusState::kActive) {
    valid.faults.add(link.bus == BusState::kOff       ? Fault::kBusOff
                     : link.bus == BusState::kPassive ? Fault::kBusPassive
                                                      : Fault::kBusDown);
  }
  if (link.dropped_cycles >= 2) {
    valid.faults.add(Fault::kTransmitFailed);
  }
  if (link.out_of_range) {
    valid.faults.add(Fault::kValueOutOfRange);
  }
}

void read_identity(const Signal<bool>& same_machine, TimeUs now_us, CommonValid& valid) {
  const Freshness known(kIdentityTimeout_s, now_us);
  if (!known.holds(same_machine) || !same_machine.value) {
    valid.faults.add(Fault::kIdentityMismatch);
  }
}

}  // namespace

void read_machine(const BusCapabilities& bus, const MachineInputs& inputs,
                  const EngineRange& engine, const Freshness& fresh, TimeUs now_us,
                  CommonValid& valid) {
  read_driver(inputs.driver, fresh, valid);
  if (bus.identity) {
    read_identity(inputs.same_machine, now_us, valid);
  }
  read_bus(inputs.link, valid);
  const Signal<double>& speed = inputs.engine_speed_radps;
  const bool known =
      fresh.number(speed) && speed.value <= kEngineMostOverspeed * engine.rated_radps;
  valid.idle_radps = engine.idle_radps;
  valid.engine_radps = known ? speed.value : engine.idle_radps;
  if (!known) {
    valid.faults.add(Fault::kEngineSpeedMissing);
  } else if (speed.value < kRunningShare * engine.idle_radps) {
    valid.faults.add(Fault::kEngineStopped);
  }
  valid.stand_in = bus.lacks_any() || inputs.link.cannot_answer;
  const bool echoed = bus.valve_echo && fresh.holds(inputs.valve_enabled);
  valid.valve_enabled = echoed && inputs.valve_enabled.value;
  if (bus.valve_echo && !echoed) {
    valid.faults.add(Fault::kSpoolMissing);
  }
}

void sort_faults(bool moving, std::initializer_list<Bridge> bridges, CommonValid& valid) {
  FaultSet bridged;
  for (const Bridge& bridge : bridges) {
    if (!valid.faults.has(bridge.missing)) {
      bridged.add(bridge.jump);
    }
  }
  for (Fault fault = valid.faults.first(); fault != Fault::kNone;
       fault = valid.faults.after(fault)) {
    const bool slows = fault_row(fault).reaction == Reaction::kDegrade || bridged.has(fault);
    if (moving && slows) {
      valid.degraded.add(fault);
    } else if (valid.fault == Fault::kNone) {
      valid.fault = fault;
    }
  }
}

namespace {

/// A lower speed counts at once, a higher one after the last lower one has been long ago.
void hold_override(double asked_ratio, double period_s, SlowingState& state) {
  state.override_for_s = std::max(0.0, state.override_for_s - period_s);
  if (asked_ratio <= state.override_ratio) {
    state.override_ratio = asked_ratio;
    state.override_for_s = kOverrideAfter_s;
  } else if (state.override_for_s <= 0.0) {
    state.override_ratio = asked_ratio;
  }
}

}  // namespace

void stop(const FaultSet& faults, CommonValid& inputs) {
  inputs.faults.add(faults);
  if (inputs.fault == Fault::kNone) {
    inputs.fault = faults.first();
  }
}

void degrade(Fault fault, CommonValid& inputs) {
  inputs.faults.add(fault);
  inputs.degraded.add(fault);
}

void warn(Fault fault, CommonValid& inputs) { inputs.warned.add(fault); }

void tell_unknown(const UnknownDrives& unknown, CommonValid& inputs) {
  const double left_ratio = unknown.left_ratio(inputs.task, inputs.task_number);
  inputs.speed_override_ratio *= left_ratio;
  if (!(left_ratio > 0.0)) {
    FaultSet refused;
    refused.add(Fault::kTaskUnknown);
    stop(refused, inputs);
  }
}

SlowingState slow_down(double speed_ratio, const SlowingState& last, bool moving, double period_s,
                       CommonValid& inputs) {
  if (!moving) {
    return {};
  }
  SlowingState state = last;
  if (inputs.task == Task::kNone) {
    state.override_ratio = 1.0;
    state.override_for_s = 0.0;
  } else {
    hold_override(inputs.speed_override_ratio, period_s, state);
    inputs.speed_override_ratio = state.override_ratio;
  }
  if (!inputs.degraded.empty()) {
    state.faults.add(inputs.degraded);
    state.for_s = kSlowAfter_s;
  } else {
    state.for_s = std::max(0.0, last.for_s - period_s);
    if (state.for_s <= 0.0) {
      state.faults = {};
    }
  }
  inputs.degraded = state.faults;
  if (inputs.degraded.has(Fault::kEngineSpeedMissing)) {
    inputs.engine_radps = std::min(inputs.engine_radps, inputs.idle_radps);
  }
  if (!inputs.degraded.empty()) {
    inputs.speed_override_ratio *= speed_ratio;
  }
  return state;
}

bool still_closing(bool last, bool centred, Fault unknown, const CommonValid& inputs) {
  const bool closed = !inputs.faults.has(unknown) && centred;
  const bool by_hand = !inputs.faults.has(Fault::kOperatorMissing) && !inputs.automatic;
  return last && !closed && !by_hand;
}

}  // namespace graben
