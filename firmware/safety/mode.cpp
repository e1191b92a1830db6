// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/mode.hpp"

#include "firmware/safety/fault_table.hpp"

namespace graben {
namespace {

constexpr std::uint32_t bit(ArmBlock block) { return 1U << static_cast<unsigned>(block); }

ModeState after_fault(const ModeState& last, Fault fault) {
  if (last.mode == EcuMode::kFault) {
    return {EcuMode::kFault, last.fault};
  }
  return {in_motion(last.mode) ? EcuMode::kFault : EcuMode::kSilent, fault};
}

}  // namespace

bool in_motion(EcuMode mode) { return mode == EcuMode::kArmed || mode == EcuMode::kActive; }

ModeState next_mode(const ModeState& last, const ModeRequest& request) {
  if (request.stop || last.mode == EcuMode::kStopping) {
    return {EcuMode::kStopping, request.fault};
  }
  if (request.fault != Fault::kNone) {
    return after_fault(last, request.fault);
  }
  if (request.enable && last.mode == EcuMode::kFault) {
    return last;
  }
  if (request.enable && last.mode == EcuMode::kSilent) {
    return {EcuMode::kSilent, Fault::kNone};
  }
  if (!request.enable || !request.automatic) {
    return {EcuMode::kReady, Fault::kNone, !request.enable && request.automatic};
  }
  if (in_motion(last.mode)) {
    return {request.has_task ? EcuMode::kActive : EcuMode::kArmed, Fault::kNone};
  }
  const bool at_rest = !request.has_task && request.centred;
  return {last.may_arm && at_rest ? EcuMode::kArmed : EcuMode::kReady, Fault::kNone};
}

std::uint32_t why_not_armed(const ModeState& now, const ModeRequest& request,
                            const FaultSet& faults) {
  if (in_motion(now.mode)) {
    return 0;
  }
  std::uint32_t bits = bit(ArmBlock::kEnableNotFresh);
  for (Fault fault = faults.first(); fault != Fault::kNone; fault = faults.after(fault)) {
    bits |= bit(fault_row(fault).block);
  }
  const struct {
    bool blocks;
    ArmBlock block;
  } rows[] = {{!request.automatic && !faults.has(Fault::kOperatorMissing), ArmBlock::kManual},
              {request.has_task, ArmBlock::kTaskNotAtRest},
              {!request.centred, ArmBlock::kNotCentred},
              {now.mode == EcuMode::kFault, ArmBlock::kFaultLatched},
              {now.mode == EcuMode::kStopping, ArmBlock::kStopping}};
  for (const auto& row : rows) {
    bits |= row.blocks ? bit(row.block) : 0U;
  }
  return bits;
}

}  // namespace graben
