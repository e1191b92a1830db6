#pragma once
/// What the machine may do: silent by default, positive and complete conditions before motion.

#include "firmware/safety/validation.hpp"

namespace graben {

/// What the mode needs of the last cycle.
struct ModeState {
  EcuMode mode = EcuMode::kSilent;
  Fault fault = Fault::kNone;  ///< Why kFault; held until it is left.
  bool may_arm = false;        ///< Enable has been seen released in automatic mode.
};

/// Silent -> Ready when every input is complete and enable is not given; Ready -> Armed when enable
/// is given afresh in automatic mode with the task at rest, so that neither a held deadman nor a
/// waiting task starts motion; Armed <-> Active with the task; enable released: Ready in the same
/// cycle.
/// A fault while Armed or Active latches in kFault, left for Ready only with complete inputs and
/// enable released; in Ready it falls back to Silent. `blocked` names a fault that the cycle found
/// beyond the inputs (pose, solver); kNone if there is none.
[[nodiscard]] ModeState next_mode(const ModeState& last, const ValidInputs& inputs, Fault blocked);

}  // namespace graben
