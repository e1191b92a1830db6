#pragma once
/// Inputs that every machine kind reads alike: operator, bus, identity, engine; and the reactions
/// to the faults that were found.

#include <initializer_list>

#include "firmware/safety/freshness.hpp"
#include "firmware/signals/bus_capabilities.hpp"
#include "firmware/signals/machine_signals.hpp"

namespace graben {

/// Common to the inputs that may be used. With a fault, only `enable` and the faults themselves
/// mean anything.
struct CommonValid {
  Fault fault = Fault::kNone;  ///< First thing that stops.
  FaultSet faults;             ///< All that is missing or implausible.
  FaultSet degraded;           ///< Those of them that slow and do not stop.
  bool enable = false;         ///< Fresh, valid and given.
  bool automatic = false;
  bool stand_in = false;  ///< The bus lacks something that the profile replaces.
  Task task = Task::kNone;
  int task_number = -1;  ///< Of Task::kProgram; below 0 none was given.
  double speed_override_ratio = 0.0;
  bool valve_enabled = false;
  double engine_radps = 0.0;  ///< The profile's idle where the measured one is lost.
};

/// The machine names itself every second; it may miss one time.
inline constexpr double kIdentityTimeout_s = 2.5;

/// Bounds of an engine's speed.
struct EngineRange {
  double rated_radps = 0.0;
  double idle_radps = 0.0;  ///< At its slowest.
};

/// Operator, bus, identity, the valve's echo (missing: no feedback of the valve), as far as the bus
/// carries them, and the engine's speed. That frame is the one without protection, and a flow that
/// is not there would let the machine go faster: missing, or above the rated speed by more than any
/// engine, it is idle's.
void read_machine(const BusCapabilities& bus, const MachineInputs& inputs,
                  const EngineRange& engine, const Freshness& fresh, TimeUs now_us,
                  CommonValid& valid);

/// A jump whose last accepted value is still in time is not there yet; `missing` comes with its
/// end.
struct Bridge {
  Fault jump = Fault::kNone;
  Fault missing = Fault::kNone;
};

/// Sorts the faults into those that stop and those that only slow: in motion those that the table
/// says, and jumps that are bridged. Outside motion everything stops.
void sort_faults(bool moving, std::initializer_list<Bridge> bridges, CommonValid& valid);

}  // namespace graben
