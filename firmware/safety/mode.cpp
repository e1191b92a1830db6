#include "firmware/safety/mode.hpp"

namespace graben {

ModeState next_mode(const ModeState& last, const ValidInputs& inputs, Fault blocked) {
  const Fault fault = inputs.fault != Fault::kNone ? inputs.fault : blocked;
  const bool was_enabled = last.mode == EcuMode::kArmed || last.mode == EcuMode::kActive;
  if (fault != Fault::kNone) {
    if (was_enabled || last.mode == EcuMode::kFault) {
      return {EcuMode::kFault, last.mode == EcuMode::kFault ? last.fault : fault};
    }
    return {EcuMode::kSilent, fault};
  }
  switch (last.mode) {
    case EcuMode::kSilent:
      return {inputs.enable ? EcuMode::kSilent : EcuMode::kReady, Fault::kNone};
    case EcuMode::kFault:
      return inputs.enable ? last : ModeState{EcuMode::kReady, Fault::kNone};
    case EcuMode::kReady:
    case EcuMode::kArmed:
    case EcuMode::kActive:
    case EcuMode::kStopping:
      break;
  }
  if (!inputs.enable || !inputs.automatic) {
    return {EcuMode::kReady, Fault::kNone, !inputs.enable && inputs.automatic};
  }
  const bool has_task = inputs.task != Task::kNone;
  if (was_enabled) {
    return {has_task ? EcuMode::kActive : EcuMode::kArmed, Fault::kNone};
  }
  return {last.may_arm && !has_task ? EcuMode::kArmed : EcuMode::kReady, Fault::kNone};
}

}  // namespace graben
