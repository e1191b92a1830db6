#pragma once
/// Where a controller stands, whatever its machine: what it says of mode and faults, and whether
/// the pilot pressure stays cut.

#include <initializer_list>

#include "firmware/core/guarded.hpp"
#include "firmware/safety/common_inputs.hpp"
#include "firmware/safety/mode.hpp"

namespace graben {

/// The first that is not kNone.
[[nodiscard]] Fault first_of(std::initializer_list<Fault> faults);

/// The mode that was stored; one that is not intact counts as stopped by that, whatever it has
/// become.
[[nodiscard]] ModeState stored_mode(const Guarded<ModeState>& mode);

/// What the inputs ask of the mode, after whatever stops.
[[nodiscard]] ModeRequest mode_request(Fault fault, const CommonValid& valid, bool centred,
                                       bool stop_requested);

/// What is kept of the pilot pressure from cycle to cycle.
struct PilotState {
  bool kept_cut = false;  ///< Until the operator arms again.
  bool known = false;     ///< It has armed or asked for a cut since its start.
};

struct PilotResult {
  bool cut = false;  ///< It has to go now.
  PilotState state;
};

/// The cut lasts until the operator has armed again: a spool that did not obey may not have its
/// pressure back because the deadman was let go.
[[nodiscard]] PilotResult pilot(const PilotState& last, const ModeState& mode,
                                const FaultSet& faults);

/// What the operator reads of mode and faults.
[[nodiscard]] MachineStatus describe(const ModeState& mode, const ModeRequest& request,
                                     const CommonValid& valid);

}  // namespace graben
