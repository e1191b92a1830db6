#include "firmware/safety/status.hpp"

#include <algorithm>

#include "firmware/safety/fault_table.hpp"

namespace graben {

Fault first_of(std::initializer_list<Fault> faults) {
  const auto* there =
      std::find_if(faults.begin(), faults.end(), [](Fault fault) { return fault != Fault::kNone; });
  return there == faults.end() ? Fault::kNone : *there;
}

ModeState stored_mode(const Guarded<ModeState>& mode) {
  return mode.intact() ? mode.value() : ModeState{EcuMode::kFault, Fault::kMemoryCorrupt};
}

ModeRequest mode_request(Fault fault, const CommonValid& valid, bool centred, bool stop_requested) {
  return {fault, valid.enable, valid.automatic, valid.task != Task::kNone, centred, stop_requested};
}

PilotResult pilot(const PilotState& last, const ModeState& mode, const FaultSet& faults) {
  // Outside motion a spool is stuck only where it should have closed after it. Whatever stopped the
  // machine first must not hide it.
  const bool disobeyed =
      faults.has(Fault::kSpoolStuck) ||
      (mode.mode == EcuMode::kFault && (cuts_pilot(mode.fault) || cuts_pilot(faults)));
  PilotResult result;
  result.state.kept_cut = !in_motion(mode.mode) && (last.kept_cut || disobeyed);
  result.cut = result.state.kept_cut || cuts_pilot(mode.fault) || cuts_pilot(faults);
  result.state.known = last.known || in_motion(mode.mode) || result.cut;
  return result;
}

MachineStatus describe(const ModeState& mode, const ModeRequest& request,
                       const CommonValid& valid) {
  MachineStatus status;
  status.mode = mode.mode;
  status.stand_in = valid.stand_in;
  status.faults = valid.faults;
  status.faults.add(request.fault);
  status.why_not_armed = why_not_armed(mode, request, status.faults);
  status.faults.add(mode.fault);
  status.fault = mode.fault != Fault::kNone ? mode.fault : valid.degraded.first();
  return status;
}

}  // namespace graben
