// SPDX-License-Identifier: Apache-2.0
// The table once more, from what the machine's operator and the bus were promised: a slip of the
// hand in the firmware's does not repeat itself here.

#include "firmware/safety/fault_table.hpp"

#include <array>
#include "tests/unit/cmocka_cpp.hpp"

constexpr bool kCutsPilot = true;

struct Promise {
  int code;  ///< On the bus.
  Fault fault;
  char reaction;  ///< 'N' neutral, 'D' goes on slower.
  int fmi;        ///< SAE J1939-73.
  ArmBlock block;
  bool pilot = false;
};

const Promise kPromises[] = {
    // Signals that do not come: FMI 9, abnormal update rate.
    {1, Fault::kStrokeMissing, 'N', 9, ArmBlock::kStroke},
    {2, Fault::kPressureMissing, 'D', 9, ArmBlock::kPressure},
    {3, Fault::kSwashMissing, 'N', 9, ArmBlock::kSwash},
    {4, Fault::kEngineSpeedMissing, 'D', 9, ArmBlock::kEngineSpeed},
    {5, Fault::kOperatorMissing, 'N', 9, ArmBlock::kOperator},
    {20, Fault::kSpoolMissing, 'N', 9, ArmBlock::kSpool},
    // Values that cannot be: FMI 2, erratic; 10, abnormal rate of change; 31, condition exists.
    {6, Fault::kStrokeImplausible, 'N', 2, ArmBlock::kStroke},
    {7, Fault::kPoseUnreachable, 'N', 2, ArmBlock::kUnreachable},
    {23, Fault::kStrokeStuck, 'N', 2, ArmBlock::kStroke},
    {24, Fault::kStrokeJump, 'N', 10, ArmBlock::kStroke},
    {25, Fault::kPressureImplausible, 'D', 2, ArmBlock::kPressure},
    {29, Fault::kValueOutOfRange, 'D', 31, ArmBlock::kMessages},
    // Ourselves and failed devices: FMI 12; too late: 9.
    {8, Fault::kSolverFailed, 'N', 12, ArmBlock::kController},
    {9, Fault::kCommandNotFinite, 'N', 12, ArmBlock::kController},
    {27, Fault::kMemoryCorrupt, 'N', 12, ArmBlock::kController},
    {30, Fault::kSensorError, 'N', 12, ArmBlock::kSensorError},
    {10, Fault::kCycleStalled, 'N', 9, ArmBlock::kCycle},
    {16, Fault::kCycleOverrun, 'N', 9, ArmBlock::kCycle},
    // The bus: FMI 19, received network data in error; another machine: 14, special.
    {11, Fault::kIdentityMismatch, 'N', 14, ArmBlock::kIdentity},
    {12, Fault::kBusOff, 'N', 19, ArmBlock::kBus},
    {13, Fault::kBusPassive, 'N', 19, ArmBlock::kBus},
    {14, Fault::kBusDown, 'N', 19, ArmBlock::kBus},
    {15, Fault::kTransmitFailed, 'N', 19, ArmBlock::kBus},
    {17, Fault::kMessageCorrupt, 'N', 19, ArmBlock::kMessages},
    {18, Fault::kMessageSequence, 'N', 19, ArmBlock::kMessages},
    {19, Fault::kMessageMasquerade, 'N', 19, ArmBlock::kMessages},
    // The machine does not do as it is told: FMI 7, mechanical system not responding.
    {21, Fault::kSpoolStuck, 'N', 7, ArmBlock::kValve, kCutsPilot},
    {22, Fault::kUncommandedMotion, 'N', 7, ArmBlock::kValve, kCutsPilot},
    {26, Fault::kSwashDisagrees, 'D', 7, ArmBlock::kSwash},
    {28, Fault::kValveNotFollowing, 'N', 7, ArmBlock::kValve, kCutsPilot},
    // The operator asks for what is not there: FMI 31, condition exists.
    {37, Fault::kTaskUnknown, 'N', 31, ArmBlock::kTask},
    // What looks healthy frame by frame.
    {38, Fault::kStreamLate, 'N', 9, ArmBlock::kStreamLate},
    {39, Fault::kSecondController, 'N', 19, ArmBlock::kSecondController},
    {40, Fault::kEngineStopped, 'N', 31, ArmBlock::kEngineStopped},
    {41, Fault::kWrongDirection, 'N', 7, ArmBlock::kValve, true},
    {42, Fault::kMotionImplausible, 'N', 2, ArmBlock::kStroke},
    {43, Fault::kPathLeft, 'N', 31, ArmBlock::kPath},
    {44, Fault::kPoseDisagrees, 'N', 2, ArmBlock::kPose},
    {47, Fault::kBlocked, 'W', 31, ArmBlock::kPath},
    {45, Fault::kStalling, 'W', 31, ArmBlock::kPath},
    {46, Fault::kStalled, 'N', 31, ArmBlock::kPath},
    {48, Fault::kCommissionBound, 'N', 31, ArmBlock::kPath},
    {49, Fault::kNoWay, 'N', 31, ArmBlock::kPath},
    // A joint's second sensor.
    {50, Fault::kWitnessMissing, 'D', 9, ArmBlock::kStroke},
    {51, Fault::kWitnessDisagrees, 'N', 2, ArmBlock::kStroke},
    {52, Fault::kMarkMissed, 'N', 14, ArmBlock::kMark},
    {53, Fault::kMarkDue, 'W', 31, ArmBlock::kMark},
    // An engine that stands though its speed says that it runs.
    {54, Fault::kEngineDoubtful, 'N', 2, ArmBlock::kEngineStopped},
    // Somebody outside.
    {56, Fault::kExternalStop, 'N', 31, ArmBlock::kExternal},
    {57, Fault::kExternalSilent, 'N', 9, ArmBlock::kExternal},
    // A spool that is later than told.
    {58, Fault::kSpoolLate, 'N', 10, ArmBlock::kValve},
    // A design whose place is not known.
    {59, Fault::kFrameUnknown, 'W', 31, ArmBlock::kSite},
    // The dozer's own.
    {31, Fault::kPoseMissing, 'N', 9, ArmBlock::kPose},
    {32, Fault::kPoseImplausible, 'N', 2, ArmBlock::kPose},
    {33, Fault::kTransmissionMissing, 'N', 9, ArmBlock::kTransmission},
    {34, Fault::kDisplacementDisagrees, 'N', 7, ArmBlock::kTransmission},
    {35, Fault::kDisplacementRunaway, 'N', 7, ArmBlock::kTransmission},
    {36, Fault::kTrackSpeedDisagrees, 'D', 2, ArmBlock::kTransmission},
    {55, Fault::kTracksAstray, 'N', 2, ArmBlock::kTransmission},
};

TEST(every_fault_keeps_its_promise) {
  std::array<int, kFaultCount> promised{};
  for (const Promise& promise : kPromises) {
    const FaultRow& row = fault_row(promise.fault);
    const bool stops = promise.reaction == 'N';
    assert_int_equal(promise.fault, promise.code);
    assert_int_equal(row.fault, promise.fault);
    assert_int_equal(row.reaction, stops                     ? Reaction::kStop
                                   : promise.reaction == 'W' ? Reaction::kWarn
                                                             : Reaction::kDegrade);
    assert_int_equal(row.fmi, promise.fmi);
    assert_int_equal(row.red_stop, stops);
    assert_int_equal(row.block, promise.block);
    assert_int_equal(cuts_pilot(promise.fault), promise.pilot);
    FaultSet alone;
    alone.add(promise.fault);
    assert_int_equal(has_red_stop(alone), stops);
    assert_int_equal(has_amber_warning(alone), !stops);
    FaultSet among;
    among.add(Fault::kBusOff);
    assert_false(cuts_pilot(among));
    among.add(promise.fault);
    assert_int_equal(cuts_pilot(among), promise.pilot);
    among.add(Fault::kSensorError);
    assert_int_equal(cuts_pilot(among), promise.pilot);
    ++promised[static_cast<unsigned>(promise.code)];
  }
  for (unsigned code = 1; code < promised.size(); ++code) {
    assert_int_equal(promised[code], 1);
  }
}

/// What is no fault does nothing, lights no lamp.
TEST(what_is_no_fault_does_nothing) {
  assert_false(has_red_stop({}) || has_amber_warning({}) || cuts_pilot(FaultSet()));
  for (const int code : {0, kFaultCount, 255}) {
    const FaultRow& row = fault_row(static_cast<Fault>(code));
    assert_int_equal(row.fault, Fault::kNone);
    assert_int_equal(row.reaction, Reaction::kNone);
    assert_int_equal(row.fmi, 0);
    assert_false(row.red_stop);
    assert_false(cuts_pilot(static_cast<Fault>(code)));
  }
}
