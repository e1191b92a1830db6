#pragma once
/// What every machine kind's controller takes in and gives out beside its own signals.

#include <cstdint>

#include "firmware/core/codes.hpp"
#include "firmware/core/fault_set.hpp"
#include "firmware/signals/signal.hpp"

namespace graben {

/// What the operator lets the controller do.
enum class OperatorMode : std::uint8_t { kManual = 0, kAutomatic = 1 };

/// What the controller is to do.
enum class Task : std::uint8_t { kNone = 0, kDig = 1, kGrade = 2, kProgram = 3 };

struct OperatorInputs {
  Signal<bool> enable;  ///< Deadman: motion only while it is given.
  Signal<OperatorMode> mode;
  Signal<Task> task;
  Signal<double> speed_override_ratio;  ///< 0 .. 1 of the task's speed.
  Signal<std::uint8_t> task_number;     ///< Which of the task files kProgram means.
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

/// Why the mode is neither Armed nor Active: bit numbers of MachineStatus::why_not_armed, as they
/// are on the bus; never renumber, only add.
enum class ArmBlock : std::uint8_t {
  kStroke = 0,
  kPressure = 1,      ///< Excavator.
  kPose = 1,          ///< Dozer: position, height, pitch of its body.
  kSwash = 2,         ///< Excavator.
  kTransmission = 2,  ///< Dozer: displacements, track speeds.
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

/// What a controller says of itself; nothing of it moves metal.
struct MachineStatus {
  EcuMode mode = EcuMode::kSilent;
  Fault fault = Fault::kNone;       ///< What stopped it; else what slows it; else what is missing.
  FaultSet faults;                  ///< All that are there now, and the one that is latched.
  std::uint16_t why_not_armed = 0;  ///< Bits of ArmBlock; 0 when Armed or Active.
  Limit limit;
  double lambda = 0.0;  ///< Share of the wanted speed that is followed, 0 .. 1.
};

}  // namespace graben
