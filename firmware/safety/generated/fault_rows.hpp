// SPDX-License-Identifier: Apache-2.0
// Generated from firmware/safety/faults.toml and limits.toml by can_dbc/generate_all.py.
// clang-format off
#pragma once
/// The rows of the fault table, for fault_table.cpp alone.

#include <array>

#include "firmware/safety/fault_table.hpp"

namespace graben {

inline constexpr std::array<FaultRow, kFaultCount> kFaultRows{{
    {},
    {Fault::kStrokeMissing, Reaction::kStop, 9, true, false, ArmBlock::kStroke},
    {Fault::kPressureMissing, Reaction::kDegrade, 9, false, false, ArmBlock::kPressure},
    {Fault::kSwashMissing, Reaction::kStop, 9, true, false, ArmBlock::kSwash},
    {Fault::kEngineSpeedMissing, Reaction::kDegrade, 9, false, false, ArmBlock::kEngineSpeed},
    {Fault::kOperatorMissing, Reaction::kStop, 9, true, false, ArmBlock::kOperator},
    {Fault::kStrokeImplausible, Reaction::kStop, 2, true, false, ArmBlock::kStroke},
    {Fault::kPoseUnreachable, Reaction::kStop, 2, true, false, ArmBlock::kUnreachable},
    {Fault::kSolverFailed, Reaction::kStop, 12, true, false, ArmBlock::kController},
    {Fault::kCommandNotFinite, Reaction::kStop, 12, true, false, ArmBlock::kController},
    {Fault::kCycleStalled, Reaction::kStop, 9, true, false, ArmBlock::kCycle},
    {Fault::kIdentityMismatch, Reaction::kStop, 14, true, false, ArmBlock::kIdentity},
    {Fault::kBusOff, Reaction::kStop, 19, true, false, ArmBlock::kBus},
    {Fault::kBusPassive, Reaction::kStop, 19, true, false, ArmBlock::kBus},
    {Fault::kBusDown, Reaction::kStop, 19, true, false, ArmBlock::kBus},
    {Fault::kTransmitFailed, Reaction::kStop, 19, true, false, ArmBlock::kBus},
    {Fault::kCycleOverrun, Reaction::kStop, 9, true, false, ArmBlock::kCycle},
    {Fault::kMessageCorrupt, Reaction::kStop, 19, true, false, ArmBlock::kMessages},
    {Fault::kMessageSequence, Reaction::kStop, 19, true, false, ArmBlock::kMessages},
    {Fault::kMessageMasquerade, Reaction::kStop, 19, true, false, ArmBlock::kMessages},
    {Fault::kSpoolMissing, Reaction::kStop, 9, true, false, ArmBlock::kSpool},
    {Fault::kSpoolStuck, Reaction::kStop, 7, true, true, ArmBlock::kValve},
    {Fault::kUncommandedMotion, Reaction::kStop, 7, true, true, ArmBlock::kValve},
    {Fault::kStrokeStuck, Reaction::kStop, 2, true, false, ArmBlock::kStroke},
    {Fault::kStrokeJump, Reaction::kStop, 10, true, false, ArmBlock::kStroke},
    {Fault::kPressureImplausible, Reaction::kDegrade, 2, false, false, ArmBlock::kPressure},
    {Fault::kSwashDisagrees, Reaction::kDegrade, 7, false, false, ArmBlock::kSwash},
    {Fault::kMemoryCorrupt, Reaction::kStop, 12, true, false, ArmBlock::kController},
    {Fault::kValveNotFollowing, Reaction::kStop, 7, true, true, ArmBlock::kValve},
    {Fault::kValueOutOfRange, Reaction::kDegrade, 31, false, false, ArmBlock::kMessages},
    {Fault::kSensorError, Reaction::kStop, 12, true, false, ArmBlock::kSensorError},
    {Fault::kPoseMissing, Reaction::kStop, 9, true, false, ArmBlock::kPose},
    {Fault::kPoseImplausible, Reaction::kStop, 2, true, false, ArmBlock::kPose},
    {Fault::kTransmissionMissing, Reaction::kStop, 9, true, false, ArmBlock::kTransmission},
    {Fault::kDisplacementDisagrees, Reaction::kStop, 7, true, false, ArmBlock::kTransmission},
    {Fault::kDisplacementRunaway, Reaction::kStop, 7, true, false, ArmBlock::kTransmission},
    {Fault::kTrackSpeedDisagrees, Reaction::kDegrade, 2, false, false, ArmBlock::kTransmission},
    {Fault::kTaskUnknown, Reaction::kStop, 31, true, false, ArmBlock::kTask},
    {Fault::kStreamLate, Reaction::kStop, 9, true, false, ArmBlock::kStreamLate},
    {Fault::kSecondController, Reaction::kStop, 19, true, false, ArmBlock::kSecondController},
    {Fault::kEngineStopped, Reaction::kStop, 31, true, false, ArmBlock::kEngineStopped},
    {Fault::kWrongDirection, Reaction::kStop, 7, true, true, ArmBlock::kValve},
    {Fault::kMotionImplausible, Reaction::kStop, 2, true, false, ArmBlock::kStroke},
    {Fault::kPathLeft, Reaction::kStop, 31, true, false, ArmBlock::kPath},
    {Fault::kPoseDisagrees, Reaction::kStop, 2, true, false, ArmBlock::kPose},
    {Fault::kStalling, Reaction::kWarn, 31, false, false, ArmBlock::kPath},
    {Fault::kStalled, Reaction::kStop, 31, true, false, ArmBlock::kPath},
    {Fault::kBlocked, Reaction::kWarn, 31, false, false, ArmBlock::kPath},
    {Fault::kCommissionBound, Reaction::kStop, 31, true, false, ArmBlock::kPath},
    {Fault::kNoWay, Reaction::kStop, 31, true, false, ArmBlock::kPath},
}};

}  // namespace graben
