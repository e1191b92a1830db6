#pragma once
/// That the value tables of a DBC say what firmware's codes say. Each struct is instantiated once
/// for each bus; a number that differs does not compile.

#include "firmware/core/codes.hpp"
#include "firmware/excavator/excavator_signals.hpp"

namespace graben {

template <class Bus, class Own>
constexpr bool same_code(Bus bus_code, Own own_code) {
  return static_cast<int>(bus_code) == static_cast<int>(own_code);
}

template <class EcuStatus>
struct ModeCodes {
  using Bus = typename EcuStatus::Mode;
  static_assert(same_code(Bus::kSilent, EcuMode::kSilent));
  static_assert(same_code(Bus::kReady, EcuMode::kReady));
  static_assert(same_code(Bus::kArmed, EcuMode::kArmed));
  static_assert(same_code(Bus::kActive, EcuMode::kActive));
  static_assert(same_code(Bus::kStopping, EcuMode::kStopping));
  static_assert(same_code(Bus::kFault, EcuMode::kFault));
  static_assert(same_code(EcuStatus::kMode.raw_max, EcuMode::kFault));
};

/// Up to what any kind of machine can meet.
template <class EcuStatus>
struct LimitCodes {
  using Bus = typename EcuStatus::LimitKind;
  static_assert(same_code(Bus::kNone, LimitKind::kNone));
  static_assert(same_code(Bus::kPumpFlow, LimitKind::kPumpFlow));
  static_assert(same_code(Bus::kBackFlow, LimitKind::kBackFlow));
  static_assert(same_code(Bus::kSpoolTravel, LimitKind::kSpoolTravel));
  static_assert(same_code(Bus::kStrokeEnd, LimitKind::kStrokeEnd));
  static_assert(same_code(Bus::kRise, LimitKind::kRise));
  static_assert(same_code(Bus::kDegraded, LimitKind::kDegraded));
};

/// What an excavator's tasks can meet beyond them.
template <class EcuStatus>
struct TaskLimitCodes {
  using Bus = typename EcuStatus::LimitKind;
  static_assert(same_code(Bus::kSwingEnd, LimitKind::kSwingEnd));
  static_assert(same_code(Bus::kFence, LimitKind::kFence));
  static_assert(same_code(Bus::kOffPath, LimitKind::kOffPath));
};

/// What the steps of an excavator's tasks are for.
template <class TaskStatus>
struct StepCodes {
  using Bus = typename TaskStatus::StepKind;
  static_assert(same_code(Bus::kNone, StepKind::kNone));
  static_assert(same_code(Bus::kApproach, StepKind::kApproach));
  static_assert(same_code(Bus::kDig, StepKind::kDig));
  static_assert(same_code(Bus::kLift, StepKind::kLift));
  static_assert(same_code(Bus::kSwing, StepKind::kSwing));
  static_assert(same_code(Bus::kDump, StepKind::kDump));
  static_assert(same_code(Bus::kReturnToDig, StepKind::kReturnToDig));
  static_assert(same_code(Bus::kDone, StepKind::kDone));
  static_assert(same_code(TaskStatus::kStepKind.raw_max, StepKind::kDone));
};

template <class EcuStatus>
struct FaultCodes {
  using Bus = typename EcuStatus::Fault;
  static_assert(same_code(Bus::kNone, Fault::kNone));
  static_assert(same_code(Bus::kStrokeMissing, Fault::kStrokeMissing));
  static_assert(same_code(Bus::kPressureMissing, Fault::kPressureMissing));
  static_assert(same_code(Bus::kSwashMissing, Fault::kSwashMissing));
  static_assert(same_code(Bus::kEngineSpeedMissing, Fault::kEngineSpeedMissing));
  static_assert(same_code(Bus::kOperatorMissing, Fault::kOperatorMissing));
  static_assert(same_code(Bus::kStrokeImplausible, Fault::kStrokeImplausible));
  static_assert(same_code(Bus::kPoseUnreachable, Fault::kPoseUnreachable));
  static_assert(same_code(Bus::kSolverFailed, Fault::kSolverFailed));
  static_assert(same_code(Bus::kCommandNotFinite, Fault::kCommandNotFinite));
  static_assert(same_code(Bus::kCycleStalled, Fault::kCycleStalled));
  static_assert(same_code(Bus::kIdentityMismatch, Fault::kIdentityMismatch));
  static_assert(same_code(Bus::kBusOff, Fault::kBusOff));
  static_assert(same_code(Bus::kBusPassive, Fault::kBusPassive));
  static_assert(same_code(Bus::kBusDown, Fault::kBusDown));
  static_assert(same_code(Bus::kTransmitFailed, Fault::kTransmitFailed));
  static_assert(same_code(Bus::kCycleOverrun, Fault::kCycleOverrun));
  static_assert(same_code(Bus::kMessageCorrupt, Fault::kMessageCorrupt));
  static_assert(same_code(Bus::kMessageSequence, Fault::kMessageSequence));
  static_assert(same_code(Bus::kMessageMasquerade, Fault::kMessageMasquerade));
  static_assert(same_code(Bus::kSpoolMissing, Fault::kSpoolMissing));
  static_assert(same_code(Bus::kSpoolStuck, Fault::kSpoolStuck));
  static_assert(same_code(Bus::kUncommandedMotion, Fault::kUncommandedMotion));
  static_assert(same_code(Bus::kStrokeStuck, Fault::kStrokeStuck));
  static_assert(same_code(Bus::kStrokeJump, Fault::kStrokeJump));
  static_assert(same_code(Bus::kPressureImplausible, Fault::kPressureImplausible));
  static_assert(same_code(Bus::kSwashDisagrees, Fault::kSwashDisagrees));
  static_assert(same_code(Bus::kMemoryCorrupt, Fault::kMemoryCorrupt));
  static_assert(same_code(Bus::kValveNotFollowing, Fault::kValveNotFollowing));
  static_assert(same_code(Bus::kValueOutOfRange, Fault::kValueOutOfRange));
  static_assert(same_code(Bus::kSensorError, Fault::kSensorError));
  static_assert(same_code(Bus::kPoseMissing, Fault::kPoseMissing));
  static_assert(same_code(Bus::kPoseImplausible, Fault::kPoseImplausible));
  static_assert(same_code(Bus::kTransmissionMissing, Fault::kTransmissionMissing));
  static_assert(same_code(Bus::kDisplacementDisagrees, Fault::kDisplacementDisagrees));
  static_assert(same_code(Bus::kDisplacementRunaway, Fault::kDisplacementRunaway));
  static_assert(same_code(Bus::kTrackSpeedDisagrees, Fault::kTrackSpeedDisagrees));
  static_assert(same_code(Bus::kTaskUnknown, Fault::kTaskUnknown));
  static_assert(EcuStatus::kFault.raw_max == kFaultCount - 1);
  // For LimitKind::kDegraded the index is a fault's number.
  static_assert(EcuStatus::kLimitIndex.raw_max >= kFaultCount - 1);
};

template <class EcuHealth>
struct BlockCodes {
  // Every reason has its bit.
  static_assert(kArmBlockCount <= 32 && EcuHealth::kWhyNotArmed.raw_max == UINT32_MAX);
};

/// All of them, of one bus.
template <class EcuStatus, class EcuHealth>
struct BusCodes : ModeCodes<EcuStatus>,
                  LimitCodes<EcuStatus>,
                  FaultCodes<EcuStatus>,
                  BlockCodes<EcuHealth> {};

}  // namespace graben
