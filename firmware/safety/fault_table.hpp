#pragma once
/// What each fault does.

#include <array>
#include <cstdint>

#include "firmware/core/codes.hpp"

namespace graben {

enum class Reaction : std::uint8_t { kNone = 0, kDegrade = 1, kStop = 2 };

struct FaultRow {
  Fault fault = Fault::kNone;
  Reaction reaction = Reaction::kNone;
  std::uint8_t fmi = 31;
  bool red_stop = false;
};

inline constexpr std::array<FaultRow, kFaultCount> kFaultTable{{
    {Fault::kNone, Reaction::kNone, 31, false},
    {Fault::kStrokeMissing, Reaction::kStop, 9, true},
    {Fault::kPressureMissing, Reaction::kDegrade, 9, false},
    {Fault::kSwashMissing, Reaction::kDegrade, 9, false},
    {Fault::kEngineSpeedMissing, Reaction::kDegrade, 9, false},
    {Fault::kOperatorMissing, Reaction::kStop, 9, true},
    {Fault::kStrokeImplausible, Reaction::kStop, 2, true},
    {Fault::kPoseUnreachable, Reaction::kStop, 31, true},
    {Fault::kSolverFailed, Reaction::kStop, 12, true},
    {Fault::kCommandNotFinite, Reaction::kStop, 12, true},
    {Fault::kCycleStalled, Reaction::kStop, 12, true},
    {Fault::kIdentityMismatch, Reaction::kStop, 31, true},
    {Fault::kBusOff, Reaction::kStop, 19, true},
    {Fault::kBusPassive, Reaction::kStop, 19, true},
    {Fault::kBusDown, Reaction::kStop, 19, true},
    {Fault::kTransmitFailed, Reaction::kStop, 19, true},
    {Fault::kCycleOverrun, Reaction::kStop, 12, true},
    {Fault::kMessageCorrupt, Reaction::kStop, 19, true},
    {Fault::kMessageSequence, Reaction::kStop, 19, true},
    {Fault::kMessageMasquerade, Reaction::kStop, 19, true},
    {Fault::kSpoolMissing, Reaction::kStop, 9, true},
    {Fault::kSpoolStuck, Reaction::kStop, 31, true},
    {Fault::kUncommandedMotion, Reaction::kStop, 31, true},
    {Fault::kStrokeStuck, Reaction::kStop, 2, true},
    {Fault::kStrokeJump, Reaction::kStop, 2, true},
    {Fault::kPressureImplausible, Reaction::kDegrade, 2, false},
    {Fault::kSwashDisagrees, Reaction::kDegrade, 2, false},
    {Fault::kMemoryCorrupt, Reaction::kStop, 12, true},
    {Fault::kValveNotFollowing, Reaction::kStop, 31, true},
    {Fault::kValueOutOfRange, Reaction::kDegrade, 2, false},
    {Fault::kSensorError, Reaction::kDegrade, 12, false},
}};

constexpr const FaultRow& fault_row(Fault fault) {
  return kFaultTable[static_cast<unsigned>(fault)];
}

}  // namespace graben
