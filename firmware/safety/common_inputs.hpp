// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Inputs that every machine kind reads alike: operator, bus, identity, engine; and the reactions
/// to the faults that were found.

#include <initializer_list>

#include "firmware/machine/unknown_drives.hpp"
#include "firmware/safety/plausibility.hpp"
#include "firmware/signals/bus_capabilities.hpp"
#include "firmware/signals/machine_signals.hpp"

namespace graben {

/// What somebody outside leaves of the speed, see external_limit.hpp.
struct ExternalCap {
  double speed_ratio = 1.0;  ///< Most share of the task's full speed.
  bool holds = false;        ///< The operator would have it faster.
  std::uint8_t source = 0;

  [[nodiscard]] bool stops() const { return speed_ratio <= 0.0; }
  [[nodiscard]] Limit limit() const {
    return holds ? Limit{LimitKind::kExternalLimit, source} : Limit{};
  }
};

/// Common to the inputs that may be used. With a fault, only `enable` and the faults themselves
/// mean anything.
struct CommonValid {
  Fault fault = Fault::kNone;  ///< First thing that stops.
  FaultSet faults;             ///< All that is missing or implausible.
  FaultSet degraded;           ///< Those of them that slow and do not stop.
  FaultSet warned;             ///< Said; nothing else comes of them.
  bool enable = false;         ///< Fresh, valid and given.
  bool automatic = false;
  bool stand_in = false;  ///< The bus, or a station, lacks something that is checked elsewhere.
  Task task = Task::kNone;
  int task_number = -1;  ///< Of Task::kProgram; below 0 none was given.
  double speed_override_ratio = 0.0;
  ExternalCap external;  ///< Already in the speed.
  bool valve_enabled = false;
  double engine_radps = 0.0;  ///< The profile's idle where the measured one is lost.
  double idle_radps = 0.0;    ///< The profile's.

  /// The operator has the machine: manual mode.
  [[nodiscard]] bool by_hand() const { return !faults.has(Fault::kOperatorMissing) && !automatic; }
};

/// Bounds of an engine's speed.
struct EngineRange {
  double rated_radps = 0.0;
  double idle_radps = 0.0;  ///< At its slowest.
};

/// Operator, bus, identity, the valve's echo (missing: no feedback of the valve), as far as the bus
/// carries them, and the engine's speed. That frame is the one without protection, and a flow that
/// is not there would let the machine go faster: missing, or above the rated speed by more than any
/// engine, it is idle's. An engine that is measured below kRunningShare of idle does not run
/// (kEngineStopped): it is cranked, or stalls.
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

/// Faults that degraded of late, and how long they still do.
struct SlowingState {
  FaultSet faults;
  double for_s = 0.0;
  double override_ratio = 1.0;  ///< Least that the operator has allowed of late ...
  double override_for_s = 0.0;  ///< ... and how long it still counts.
};

/// Adds faults that stop; what came in as the first stays it.
void stop(const FaultSet& faults, CommonValid& inputs);

/// Adds one that only slows.
void degrade(Fault fault, CommonValid& inputs);

/// Adds one that is only said.
void warn(Fault fault, CommonValid& inputs);

/// kTaskUnknown in a task that needs a drive which was not commissioned; or only the speed that is
/// left to it.
void tell_unknown(const UnknownDrives& unknown, CommonValid& inputs);

/// The operator's speed times `speed_ratio` while anything is degraded, and for kSlowAfter_s after:
/// a value that comes and goes must not make the machine jerk. For the same reason the engine
/// counts as idling for as long as its speed does, and the operator's speed is the least of the
/// last kOverrideAfter_s. Outside motion nothing is slowed or remembered.
[[nodiscard]] SlowingState slow_down(double speed_ratio, const SlowingState& last, bool moving,
                                     double period_s, CommonValid& inputs);

/// True while something has still to come to neutral after motion: not `centred` since, and the
/// operator has not taken over in manual mode. What is not known does not end it; with `unknown`,
/// `centred` is not.
[[nodiscard]] bool still_closing(bool last, bool centred, Fault unknown, const CommonValid& inputs);

}  // namespace graben
