#include "firmware/safety/common_inputs.hpp"

#include <algorithm>

#include "firmware/safety/fault_table.hpp"

namespace graben {
namespace {

/// Over its rated speed an engine runs by a few per cent, downhill by some more.
constexpr double kMostOverspeed = 1.2;

}  // namespace

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

void read_bus(const BusCapabilities& bus, const LinkInputs& link, CommonValid& valid) {
  valid.stand_in = bus.lacks_any();
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

void read_identity(const BusCapabilities& bus, const Signal<bool>& same_machine, TimeUs now_us,
                   CommonValid& valid) {
  if (!bus.identity) {
    return;
  }
  const Freshness known(kIdentityTimeout_s, now_us);
  if (!known.holds(same_machine) || !same_machine.value) {
    valid.faults.add(Fault::kIdentityMismatch);
  }
}

bool read_echo(const BusCapabilities& bus, const Signal<bool>& valve_enabled,
               const Freshness& fresh, FaultSet& faults) {
  if (!bus.valve_echo) {
    return false;
  }
  if (!fresh.holds(valve_enabled)) {
    faults.add(Fault::kSpoolMissing);
    return false;
  }
  return valve_enabled.value;
}

double engine_speed_radps(const Signal<double>& measured_radps, double rated_radps,
                          double idle_radps, const Freshness& fresh, FaultSet& faults) {
  if (fresh.number(measured_radps) && measured_radps.value <= kMostOverspeed * rated_radps) {
    return measured_radps.value;
  }
  faults.add(Fault::kEngineSpeedMissing);
  return idle_radps;
}

double bounded_stroke_m(double stroke_m, double stroke_max_m, FaultSet& faults) {
  if (stroke_m < -kStrokeMargin_m || stroke_m > stroke_max_m + kStrokeMargin_m) {
    faults.add(Fault::kStrokeImplausible);
  }
  return std::clamp(stroke_m, 0.0, stroke_max_m);
}

void judge(bool moving, std::initializer_list<Bridge> bridges, CommonValid& valid) {
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

}  // namespace graben
