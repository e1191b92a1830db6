// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Modes of the machine: silent by default, positive and complete conditions before motion.

#include "firmware/core/fault_set.hpp"
#include "firmware/signals/machine_signals.hpp"

namespace graben {

/// State of the mode from cycle to cycle.
struct ModeState {
  EcuMode mode = EcuMode::kSilent;
  Fault fault = Fault::kNone;  ///< Why kFault, held until it is left; why kSilent.
  bool may_arm = false;        ///< Enable has been seen released in automatic mode.
};

/// Request of this cycle and its conditions.
struct ModeRequest {
  Fault fault = Fault::kNone;  ///< First thing that stops.
  bool enable = false;
  bool automatic = false;
  bool has_task = false;
  bool centred = true;  ///< Every spool is near its middle: nobody moves the machine by hand.
  bool stop = false;    ///< The process was told to end.
};

/// Armed or Active: the operator has given enable and nothing has taken it back.
[[nodiscard]] bool in_motion(EcuMode mode);

/// Silent -> Ready when every input is complete and enable is not given; Ready -> Armed when enable
/// is newly given in automatic mode with the task at rest and the spools in their middle, so that
/// neither a held deadman nor a waiting task starts motion; Armed <-> Active with the task; enable
/// released: Ready in the same cycle. Told to end: Stopping, for good.
/// A fault while Armed or Active latches in kFault, left for Ready only with complete inputs and
/// enable released; in Ready it falls back to Silent.
[[nodiscard]] ModeState next_mode(const ModeState& last, const ModeRequest& request);

/// Bits of ArmBlock: all that stands between `now` and Armed; 0 in motion. `faults` are those that
/// are there.
[[nodiscard]] std::uint32_t why_not_armed(const ModeState& now, const ModeRequest& request,
                                          const FaultSet& faults);

}  // namespace graben
