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
  kStopping = 4,  ///< Reserved: bringing the spools to neutral. Not entered yet.
  kFault = 5,     ///< Neutral until the enable has been released and given afresh.
};

/// What stopped the machine.
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
};

/// What holds lambda below 1.
enum class LimitKind : std::uint8_t {
  kNone = 0,
  kPumpFlow = 1,     ///< (29), (30): a pump cannot feed the in-flow; index is the pump's.
  kBackFlow = 2,     ///< (36) with F_offset: the load would push back; index is the actuator's.
  kSpoolTravel = 3,  ///< (13): the spool is fully open; index is the actuator's.
  kStrokeEnd = 4,    ///< The cylinder is at its end; index is the actuator's.
  kRise = 5,         ///< Nothing but the rate at which lambda may rise.
};

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

/// How the optimiser ended.
enum class SolveStatus : std::uint8_t {
  kOk = 0,
  kInfeasible = 1,    ///< No motion is possible even at lambda -> 0: (43) is not met.
  kBadInput = 2,      ///< A number was not finite or out of its range; the result is lambda 0.
  kNotConverged = 3,  ///< A fixed iteration count was not enough; the result is lambda 0.
};

}  // namespace graben
