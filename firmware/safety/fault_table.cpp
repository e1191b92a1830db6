#include "firmware/safety/fault_table.hpp"

#include <array>
#include <cstddef>

namespace graben {
namespace {

// Failure modes of SAE J1939-73.
constexpr std::uint8_t kErratic = 2;
constexpr std::uint8_t kNotResponding = 7;
constexpr std::uint8_t kAbnormalRate = 9;
constexpr std::uint8_t kAbnormalChange = 10;
constexpr std::uint8_t kBadDevice = 12;
constexpr std::uint8_t kSpecial = 14;
constexpr std::uint8_t kNetworkData = 19;
constexpr std::uint8_t kConditionExists = 31;

constexpr std::array<FaultRow, kFaultCount> kRows{{
    {Fault::kNone, Reaction::kNone, 0, false, ArmBlock::kUnreachable},
    {Fault::kStrokeMissing, Reaction::kStop, kAbnormalRate, true, ArmBlock::kStroke},
    {Fault::kPressureMissing, Reaction::kDegrade, kAbnormalRate, false, ArmBlock::kPressure},
    {Fault::kSwashMissing, Reaction::kStop, kAbnormalRate, true, ArmBlock::kSwash},
    {Fault::kEngineSpeedMissing, Reaction::kDegrade, kAbnormalRate, false, ArmBlock::kEngineSpeed},
    {Fault::kOperatorMissing, Reaction::kStop, kAbnormalRate, true, ArmBlock::kOperator},
    {Fault::kStrokeImplausible, Reaction::kStop, kErratic, true, ArmBlock::kStroke},
    {Fault::kPoseUnreachable, Reaction::kStop, kErratic, true, ArmBlock::kUnreachable},
    {Fault::kSolverFailed, Reaction::kStop, kBadDevice, true, ArmBlock::kController},
    {Fault::kCommandNotFinite, Reaction::kStop, kBadDevice, true, ArmBlock::kController},
    {Fault::kCycleStalled, Reaction::kStop, kAbnormalRate, true, ArmBlock::kCycle},
    {Fault::kIdentityMismatch, Reaction::kStop, kSpecial, true, ArmBlock::kIdentity},
    {Fault::kBusOff, Reaction::kStop, kNetworkData, true, ArmBlock::kBus},
    {Fault::kBusPassive, Reaction::kStop, kNetworkData, true, ArmBlock::kBus},
    {Fault::kBusDown, Reaction::kStop, kNetworkData, true, ArmBlock::kBus},
    {Fault::kTransmitFailed, Reaction::kStop, kNetworkData, true, ArmBlock::kBus},
    {Fault::kCycleOverrun, Reaction::kStop, kAbnormalRate, true, ArmBlock::kCycle},
    {Fault::kMessageCorrupt, Reaction::kStop, kNetworkData, true, ArmBlock::kMessages},
    {Fault::kMessageSequence, Reaction::kStop, kNetworkData, true, ArmBlock::kMessages},
    {Fault::kMessageMasquerade, Reaction::kStop, kNetworkData, true, ArmBlock::kMessages},
    {Fault::kSpoolMissing, Reaction::kStop, kAbnormalRate, true, ArmBlock::kSpool},
    {Fault::kSpoolStuck, Reaction::kStop, kNotResponding, true, ArmBlock::kValve},
    {Fault::kUncommandedMotion, Reaction::kStop, kNotResponding, true, ArmBlock::kValve},
    {Fault::kStrokeStuck, Reaction::kStop, kErratic, true, ArmBlock::kStroke},
    {Fault::kStrokeJump, Reaction::kStop, kAbnormalChange, true, ArmBlock::kStroke},
    {Fault::kPressureImplausible, Reaction::kDegrade, kErratic, false, ArmBlock::kPressure},
    {Fault::kSwashDisagrees, Reaction::kDegrade, kNotResponding, false, ArmBlock::kSwash},
    {Fault::kMemoryCorrupt, Reaction::kStop, kBadDevice, true, ArmBlock::kController},
    {Fault::kValveNotFollowing, Reaction::kStop, kNotResponding, true, ArmBlock::kValve},
    {Fault::kValueOutOfRange, Reaction::kDegrade, kConditionExists, false, ArmBlock::kMessages},
    {Fault::kSensorError, Reaction::kStop, kBadDevice, true, ArmBlock::kSensorError},
    {Fault::kPoseMissing, Reaction::kStop, kAbnormalRate, true, ArmBlock::kPose},
    {Fault::kPoseImplausible, Reaction::kStop, kErratic, true, ArmBlock::kPose},
    {Fault::kTransmissionMissing, Reaction::kStop, kAbnormalRate, true, ArmBlock::kTransmission},
    {Fault::kDisplacementDisagrees, Reaction::kStop, kNotResponding, true, ArmBlock::kTransmission},
    {Fault::kDisplacementRunaway, Reaction::kStop, kNotResponding, true, ArmBlock::kTransmission},
    {Fault::kTrackSpeedDisagrees, Reaction::kDegrade, kErratic, false, ArmBlock::kTransmission},
    {Fault::kTaskUnknown, Reaction::kStop, kConditionExists, true, ArmBlock::kTask},
}};

constexpr bool rows_are_in_order() {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    if (static_cast<std::size_t>(kRows[i].fault) != i) {
      return false;
    }
  }
  return true;
}
static_assert(rows_are_in_order());

}  // namespace

const FaultRow& fault_row(Fault fault) {
  const auto code = static_cast<std::size_t>(fault);
  return kRows[code < kRows.size() ? code : 0];
}

bool cuts_pilot(Fault fault) {
  return fault == Fault::kSpoolStuck || fault == Fault::kUncommandedMotion ||
         fault == Fault::kValveNotFollowing;
}

bool cuts_pilot(const FaultSet& faults) {
  bool cuts = false;
  for (Fault fault = faults.first(); fault != Fault::kNone; fault = faults.after(fault)) {
    cuts = cuts || cuts_pilot(fault);
  }
  return cuts;
}

}  // namespace graben
