#pragma once
/// Codes that leave the core. One enum for each question: what stops (Fault), what explains
/// (LimitKind), how the solver ended (SolveStatus), what the machine may do (EcuMode).
/// The numbers are on the bus; never renumber, only add.

#include <cstdint>

namespace graben {

/// State of the controller towards the machine. Only kActive moves metal.
enum class EcuMode : std::uint8_t {
  kSilent = 0,    ///< Inputs not complete since the start.
  kReady = 1,     ///< Inputs complete; enable not given.
  kArmed = 2,     ///< Enabled, no task.
  kActive = 3,    ///< Follows the task.
  kStopping = 4,  ///< Told to end: neutral, and nothing arms any more.
  kFault = 5,     ///< Neutral until the enable has been released and given afresh.
};

/// What stopped the machine or took a function away; what each does stands in
/// safety/fault_table.hpp.
enum class Fault : std::uint8_t {
  kNone = 0,
  kStrokeMissing = 1,
  kPressureMissing = 2,
  kSwashMissing = 3,
  kEngineSpeedMissing = 4,
  kOperatorMissing = 5,
  kStrokeImplausible = 6,
  kPoseUnreachable = 7,
  kSolverFailed = 8,
  kCommandNotFinite = 9,
  kCycleStalled = 10,      ///< Too long since the last cycle.
  kIdentityMismatch = 11,  ///< The machine's end has another profile or DBC, or does not say.
  kBusOff = 12,
  kBusPassive = 13,           ///< Nobody acknowledges.
  kBusDown = 14,              ///< The interface is down or gone.
  kTransmitFailed = 15,       ///< The bus did not take our frames, two cycles in a row.
  kCycleOverrun = 16,         ///< Two cycles in a row came late.
  kMessageCorrupt = 17,       ///< Three wrong CRCs of a message in its window.
  kMessageSequence = 18,      ///< Three of a message out of sequence: two senders, replay, babble.
  kMessageMasquerade = 19,    ///< A CRC that fits another message.
  kSpoolMissing = 20,         ///< No feedback of the valve.
  kSpoolStuck = 21,           ///< A spool is where no command of late has sent it.
  kUncommandedMotion = 22,    ///< A cylinder moves with its spool closed, or against it.
  kStrokeStuck = 23,          ///< A stroke stands still while its spool feeds the cylinder.
  kStrokeJump = 24,           ///< A stroke changes faster than the cylinder can.
  kPressureImplausible = 25,  ///< A pressure stands still in motion, or at its sensor's end.
  kSwashDisagrees = 26,       ///< A pump's swash is not what it was told to be.
  kMemoryCorrupt = 27,        ///< A stored setpoint differs from its complement.
  kValveNotFollowing = 28,    ///< The valve side does not confirm enable in time.
  kValueOutOfRange = 29,      ///< A frame, CRC right, had a value outside its range.
  kSensorError = 30,          ///< A sender calls its own value wrong.
  kPoseMissing = 31,          ///< Position, height, pitch or a rate of the body.
  kPoseImplausible = 32,      ///< The body's pose jumps, or cannot be.
  kTransmissionMissing = 33,  ///< A displacement's feedback or a track's speed.
  kDisplacementDisagrees = 34,  ///< A displacement does not reach what it was told to be.
  kDisplacementRunaway = 35,    ///< A displacement goes where no command of late has sent it.
  kTrackSpeedDisagrees = 36,    ///< A track's speed is not that of its displacements.
  kTaskUnknown = 37,            ///< The task that is chosen is none of ours.
};

inline constexpr int kFaultCount = 38;

/// What holds lambda below 1.
enum class LimitKind : std::uint8_t {
  kNone = 0,
  kPumpFlow = 1,       ///< (29), (30): a pump cannot feed the in-flow; index is the pump's.
  kBackFlow = 2,       ///< (36) with F_offset: the load would push back; index is the actuator's.
  kSpoolTravel = 3,    ///< (13): the spool is fully open; index is the actuator's.
  kStrokeEnd = 4,      ///< The cylinder nears its end; index is the actuator's.
  kRise = 5,           ///< Nothing but the rate at which lambda may rise.
  kDegraded = 6,       ///< A lost sensor: the field is slower; index is the Fault.
  kImplementFlow = 7,  ///< (11): the blade cylinders' flow, as measured.
  kTransmissionFlow = 8,  ///< (13): a track's transmission; index is the track's (left 0, right 1).
  kAhead = 9,             ///< Braking for what the blade will need further on.
  kOffGrade = 10,         ///< The cutting edge is too far off the grade.
  kSwingEnd = 11,         ///< The swing nears the end of its range.
  kFence = 12,            ///< A point of the machine nears a plane; index is the fence's.
  kOffPath = 13,          ///< The drives are behind the plan: its progress waits.
};

inline constexpr int kLimitKindCount = 14;

/// A limit and whose it is.
struct Limit {
  LimitKind kind = LimitKind::kNone;
  std::uint8_t index = 0;
};

/// How lambda is chosen.
enum class McvPolicy : std::uint8_t {
  kAlgorithm1 = 0,  ///< As in Kim et al.
  kConnected = 1,   ///< The end of the interval that contains 0.
  kGlobal = 2,      ///< The largest feasible lambda.
  /// For comparisons only, never on a machine: no search, the fastest that was asked for, and what
  /// is out of reach opens fully. The direction is lost.
  kFixed = 3,
};

/// How a dozer's travel speed is chosen.
enum class SpeedPolicy : std::uint8_t {
  kBounded = 0,
  /// For comparisons only, never on a machine: the speed that was asked for, whatever the blade
  /// needs.
  kConstant = 1,
};

/// How the optimiser ended.
enum class SolveStatus : std::uint8_t {
  kOk = 0,
  kInfeasible = 1,    ///< No motion is possible even at lambda -> 0: (43) is not met.
  kBadInput = 2,      ///< A number was not finite or out of its range; the result is lambda 0.
  kNotConverged = 3,  ///< A fixed iteration count was not enough; the result is lambda 0.
};

}  // namespace graben
