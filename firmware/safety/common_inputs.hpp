#pragma once
/// What every machine kind's validation reads alike: operator, bus, identity, engine; and how the
/// faults that it found are judged.

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
};

/// How far a measured stroke may lie outside its cylinder's range: bias and mounting.
inline constexpr double kStrokeMargin_m = 0.010;

/// How far a stroke may change at once beyond what the cylinder can: noise, and frames that were
/// lost.
inline constexpr double kJumpMargin_m = 0.020;

/// A cylinder whose own oil feeds its other side, or whose load drives it, is faster than the pumps
/// alone make it; twice is more than any of them does.
inline constexpr double kFasterThanPumps = 2.0;

/// The machine names itself every second; it may miss one time.
inline constexpr double kIdentityTimeout_s = 2.5;

void read_driver(const OperatorInputs& driver, const Freshness& fresh, CommonValid& valid);
void read_bus(const BusCapabilities& bus, const LinkInputs& link, CommonValid& valid);
/// A bus that does not carry it is not asked.
void read_identity(const BusCapabilities& bus, const Signal<bool>& same_machine, TimeUs now_us,
                   CommonValid& valid);

/// Missing echo counts as no feedback of the valve, unless the bus does not carry it.
[[nodiscard]] bool read_echo(const BusCapabilities& bus, const Signal<bool>& valve_enabled,
                             const Freshness& fresh, FaultSet& faults);

/// The engine's speed, rad/s. Its frame is the one without protection, and a flow that is not there
/// would let the machine go faster: missing, or above `rated_radps` by more than any engine, it is
/// `idle_radps`.
[[nodiscard]] double engine_speed_radps(const Signal<double>& measured_radps, double rated_radps,
                                        double idle_radps, const Freshness& fresh,
                                        FaultSet& faults);

/// A stroke into its cylinder's range; far outside it is implausible.
[[nodiscard]] double bounded_stroke_m(double stroke_m, double stroke_max_m, FaultSet& faults);

/// A jump whose last believed value is still in time is not there yet; `missing` comes with its
/// end.
struct Bridge {
  Fault jump = Fault::kNone;
  Fault missing = Fault::kNone;
};

/// What of the faults stops and what only slows: in motion those that the table says, and jumps
/// that are bridged. Outside motion everything stops.
void judge(bool moving, std::initializer_list<Bridge> bridges, CommonValid& valid);

}  // namespace graben
