// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Codes that leave the core. One enum for each question: what stops (Fault), what explains
/// (LimitKind), what keeps from arming (ArmBlock), how the solver ended (SolveStatus), what the
/// machine may do (EcuMode). The first three are the rows of firmware/safety/faults.toml and
/// limits.toml. The numbers are on the bus; never renumber, only add.

#include <cstdint>

#include "firmware/core/generated/codes.hpp"

namespace graben {

/// State of the controller towards the machine. Only kActive moves metal.
enum class EcuMode : std::uint8_t {
  kSilent = 0,    ///< Inputs not complete since the start.
  kReady = 1,     ///< Inputs complete; enable not given.
  kArmed = 2,     ///< Enabled, no task.
  kActive = 3,    ///< Follows the task.
  kStopping = 4,  ///< Told to end: neutral, and nothing arms any more.
  kFault = 5,     ///< Neutral until the enable has been released and given again.
};

/// A limit and whose it is.
struct Limit {
  LimitKind kind = LimitKind::kNone;
  std::uint8_t index = 0;
};

/// Policies for the choice of lambda.
enum class McvPolicy : std::uint8_t {
  kAlgorithm1 = 0,  ///< As in Kim et al.
  kConnected = 1,   ///< The end of the interval that contains 0.
  kGlobal = 2,      ///< The largest feasible lambda.
  /// For comparisons only, never on a machine: no search, the fastest that was asked for, and what
  /// is out of reach opens fully. The direction is lost.
  kFixed = 3,
};

/// Policies for a dozer's travel speed.
enum class SpeedPolicy : std::uint8_t {
  kBounded = 0,
  /// For comparisons only, never on a machine: the speed that was asked for, whatever the blade
  /// needs.
  kConstant = 1,
};

/// Ends of the optimiser.
enum class SolveStatus : std::uint8_t {
  kOk = 0,
  kInfeasible = 1,    ///< No motion is possible even at lambda -> 0: (43) is not met.
  kBadInput = 2,      ///< A number was not finite or out of its range; the result is lambda 0.
  kNotConverged = 3,  ///< A fixed iteration count was not enough; the result is lambda 0.
};

}  // namespace graben
