#pragma once
/// What comes into and goes out of the excavator's controller. SI units; axes in the order boom,
/// arm, bucket. Extension is positive for strokes, velocities, spools and duties; a stroke counts
/// from the closed cylinder.

#include <array>
#include <cstdint>

#include "firmware/core/codes.hpp"
#include "firmware/core/fault_set.hpp"
#include "firmware/signals/signal.hpp"

namespace graben {

inline constexpr int kAxisCount = 3;
inline constexpr int kPumpCount = 2;

/// What the operator lets the controller do.
enum class OperatorMode : std::uint8_t { kManual = 0, kAutomatic = 1 };

/// What the controller is to do.
enum class Task : std::uint8_t { kNone = 0, kDig = 1 };

struct AxisInputs {
  Signal<double> stroke_m;
  Signal<double> cap_pressure_pa;
  Signal<double> rod_pressure_pa;
  Signal<double> spool_ratio;  ///< Measured spool over its travel, deadband and all, -1 .. 1.
};

struct OperatorInputs {
  Signal<bool> enable;  ///< Deadman: motion only while it is given.
  Signal<OperatorMode> mode;
  Signal<Task> task;
  Signal<double> speed_override_ratio;  ///< 0 .. 1 of the task's speed.
};

/// What the bus lets us do.
enum class BusState : std::uint8_t { kActive = 0, kPassive = 1, kOff = 2, kDown = 3 };

/// What is known of the bus and of the process beside the signals.
struct LinkInputs {
  BusState bus = BusState::kDown;
  FaultSet message_faults;      ///< kMessageCorrupt, kMessageSequence, kMessageMasquerade.
  bool out_of_range = false;    ///< A frame since the last cycle was refused for a value.
  int dropped_cycles = 0;       ///< In a row, whose command the bus did not take.
  bool stop_requested = false;  ///< The process was told to end.
};

struct ExcavatorInputs {
  std::array<AxisInputs, kAxisCount> axis;
  std::array<Signal<double>, kPumpCount> swash_ratio;  ///< tan(alpha) / tan(alpha at full swash).
  Signal<double> engine_speed_radps;
  Signal<bool> valve_enabled;  ///< The valve side's echo of our enable.
  OperatorInputs driver;
  /// Whether the machine's end runs with our profile hash and DBC version.
  Signal<bool> same_machine;
  LinkInputs link;
};

/// Why the mode is neither Armed nor Active: bit numbers of ExcavatorStatus::why_not_armed, as they
/// are on the bus; never renumber, only add.
enum class ArmBlock : std::uint8_t {
  kStroke = 0,
  kPressure = 1,
  kSwash = 2,
  kEngineSpeed = 3,
  kOperator = 4,
  kSpool = 5,
  kIdentity = 6,
  kBus = 7,          ///< Not active, or it does not take our frames.
  kMessages = 8,     ///< Wrong CRCs, wrong sequences.
  kImplausible = 9,  ///< A stroke, pressure, swash or pose that cannot be.
  kCycle = 10,       ///< Cycles late.
  kManual = 11,
  kTaskNotAtRest = 12,
  kEnableNotFresh = 13,  ///< Not given; or it was given all the time and has to be released first.
  kFaultLatched = 14,    ///< Release enable, then give it again.
  kStopping = 15,
};

/// What the controller says of itself; nothing of it moves metal.
struct ExcavatorStatus {
  EcuMode mode = EcuMode::kSilent;
  Fault fault = Fault::kNone;       ///< What stopped it; else what slows it; else what is missing.
  FaultSet faults;                  ///< All that are there now, and the one that is latched.
  std::uint16_t why_not_armed = 0;  ///< Bits of ArmBlock; 0 when Armed or Active.
  Limit limit;
  double lambda = 0.0;
  std::array<double, kAxisCount> wanted_velocity_mps{};  ///< V_L^d before scaling by lambda.
  std::array<double, kPumpCount> pump_pressure_pa{};     ///< P_p that the solution expects.
  double path_error_m = 0.0;  ///< Distance of the measured tip from the path.
};

struct ExcavatorOutputs {
  bool enable = false;     ///< The valve side closes every spool without it.
  bool pilot_cut = false;  ///< Asks for the pilot pressure to be cut: the valve does not obey.
  /// Without it the controller does not know whether an earlier one has asked for a cut, and says
  /// so: a restart must not give the pressure back to a spool that is stuck.
  bool pilot_known = false;
  std::array<double, kAxisCount> duty_ratio{};   ///< -1 .. 1; 0 is neutral.
  std::array<double, kPumpCount> swash_ratio{};  ///< Wanted of each pump; only with enable.
  ExcavatorStatus status;
};

}  // namespace graben
