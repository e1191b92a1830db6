// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Signals that every machine kind's controller takes in and gives out beside its own. SI units.

#include <Eigen/Core>
#include <cstdint>

#include "firmware/core/codes.hpp"
#include "firmware/core/fault_set.hpp"
#include "firmware/signals/signal.hpp"

namespace graben {

/// The operator's choice of who drives.
enum class OperatorMode : std::uint8_t { kManual = 0, kAutomatic = 1 };

/// The controller's task; the numbers are on the bus.
enum class Task : std::uint8_t {
  kNone = 0,
  kDig = 1,
  kGrade = 2,
  kProgram = 3,
  kJog = 4,          ///< Each drive by the operator's axis.
  kCoordinated = 5,  ///< The teeth by the operator's axes.
  kCommission = 6,   ///< Duties as the operator's station tries them, guarded.
  kAssist = 7,       ///< As kJog; near the design the arm by its axis, the edge on the design.
};

/// What the operator says that the tool is at; the numbers are on the bus.
enum class TouchKind : std::uint8_t {
  kMark = 0,       ///< The mark of the machine's profile.
  kBenchmark = 1,  ///< The benchmark of the task files' site.
  kHeading = 2,    ///< The site's second point, for its heading.
  kSurface = 3,    ///< Any place of the design where it is made already: a check.
  kMoved = 4,      ///< No point: the tracks have moved.
};

/// A touch; each has a number of its own.
struct TouchWord {
  std::uint8_t number = 0;
  TouchKind kind = TouchKind::kMark;
};

struct OperatorInputs {
  Signal<bool> enable;  ///< Deadman: motion only while it is given.
  Signal<OperatorMode> mode;
  Signal<Task> task;
  Signal<double> speed_override_ratio;  ///< 0 .. 1 of the task's speed.
  Signal<std::uint8_t> task_number;     ///< Which of the task files kProgram means.
  Signal<TouchWord> touch;              ///< The tool is at a point.
};

/// What somebody outside asks for; the numbers are on the bus.
enum class ExternalLevel : std::uint8_t { kFree = 0, kSlow = 1, kStop = 2 };

/// A people detector's or a site's word.
struct ExternalWord {
  ExternalLevel level = ExternalLevel::kStop;
  bool resumes = false;      ///< After its stop the machine goes on by itself.
  std::uint8_t source = 0;   ///< Who says so.
  double speed_ratio = 0.0;  ///< While kSlow, most share of the task's full speed, 0 .. 1.
  double deadline_s = 0.0;   ///< It holds for so long.
};

/// What the operator has confirmed for a drive in Task::kCommission.
struct StrokeWindow {
  double least_m = 0.0;  ///< Strokes that it is to stay within.
  double most_m = 0.0;
  double most_mps = 0.0;
};

/// State of the bus.
enum class BusState : std::uint8_t { kActive = 0, kPassive = 1, kOff = 2, kDown = 3 };

/// State of bus and process beside the signals.
struct LinkInputs {
  BusState bus = BusState::kDown;
  FaultSet message_faults;      ///< Of messages and their senders, as the bus side finds them.
  bool out_of_range = false;    ///< A frame since the last cycle was refused for a value.
  int dropped_cycles = 0;       ///< In a row, whose command the bus did not take.
  bool stop_requested = false;  ///< The process was told to end.
  bool cannot_answer = false;   ///< A station cannot say when it heard us: no kStreamLate of it.
};

/// Of a hydraulic drive. Of a motor the ports stand for the sides: extending first.
struct DriveInputs {
  Signal<double> stroke_m;
  Signal<double> cap_pressure_pa;
  Signal<double> rod_pressure_pa;
  Signal<double> spool_ratio;  ///< Measured spool over its travel, deadband and all, -1 .. 1.
};

/// Inputs of every kind.
struct MachineInputs {
  Signal<double> engine_speed_radps;
  Signal<bool> valve_enabled;  ///< The valve side's echo of our enable.
  OperatorInputs driver;
  Signal<ExternalWord> external;
  Signal<bool> same_machine;  ///< The machine's end runs with our profile hash and DBC version.
  LinkInputs link;
};

/// Outputs of every kind.
struct MachineOutputs {
  bool enable = false;     ///< The valve side closes every spool without it.
  bool pilot_cut = false;  ///< Asks for the pilot pressure to be cut: the valve does not obey.
  /// Without it the controller does not know whether an earlier one has asked for a cut, and says
  /// so: a restart must not give the pressure back to a spool that is stuck.
  bool pilot_known = false;
};

/// What came of the last check of the tool at its mark; the numbers are on the bus.
enum class MarkResult : std::uint8_t { kNoMark = 0, kNever = 1, kPassed = 2, kMissed = 3 };

/// What became of the last touch; the numbers are on the bus.
enum class MarkTouch : std::uint8_t {
  kNone = 0,
  kTaken = 1,       ///< Of the mark: it is the last check.
  kMoving = 2,      ///< Refused: the tool was not still.
  kNotByHand = 3,   ///< Refused: the operator did not have the machine.
  kNotKnown = 4,    ///< Refused: where the tool is was not known.
  kNoPoint = 5,     ///< Refused: the machine has no such point, or another one comes first.
  kContradict = 6,  ///< Refused: the tool is elsewhere than the site or its design has the point.
};

/// The last check of the tool at its mark.
struct MarkTold {
  MarkResult result = MarkResult::kNoMark;
  MarkTouch touch = MarkTouch::kNone;
  std::uint8_t count = 0;    ///< Checks since the start; stays at 250.
  double age_s = 0.0;        ///< Of the check; without one, of the controller.
  double tolerance_m = 0.0;  ///< The profile's.
  /// Shown tool less mark: outwards as the tool looks, to the left of that, up.
  Eigen::Vector3d off_m = Eigen::Vector3d::Zero();
};

/// Status of a controller; nothing of it moves metal.
struct MachineStatus {
  EcuMode mode = EcuMode::kSilent;
  Fault fault = Fault::kNone;       ///< What stopped it; else what slows it; else what is missing.
  FaultSet faults;                  ///< All that are there now, and the one that is latched.
  std::uint32_t why_not_armed = 0;  ///< Bits of ArmBlock; 0 when Armed or Active.
  Limit limit;
  bool stand_in = false;  ///< The bus, or a station, lacks something that is checked elsewhere.
  double lambda = 0.0;    ///< Share of the wanted speed that is followed, 0 .. 1.
  MarkTold mark;          ///< Told in every mode.
};

}  // namespace graben
