// SPDX-License-Identifier: Apache-2.0
// Generated from common.dbc.in by can_dbc/generate.py; change the DBC and generate again.
// clang-format off
#pragma once
/// Intel byte order, unused bits 1. A protected message has its CRC in byte 0 and its counter in
/// the low nibble of byte 1.
/// Values are in the SI unit that their name ends with. A message that nobody has filled in carries
/// the start values. encode() rounds to the nearest raw value and saturates into [min|max]; NaN and
/// infinities become the signal's error value, or its start value where it has none; bits of no
/// signal are 1. CRC and counter are left to the end-to-end protection.

#include <array>
#include <cstdint>

#include "can_dbc/codec.hpp"

namespace graben::dbc::common {

inline constexpr std::uint8_t kDbcVersion = 1;

/// Electronic engine controller 1 (PGN 61444). Of its signals only the engine speed is read.
struct EEC1 {
  static constexpr const char* kName = "EEC1";
  static constexpr const char* kSender = "Engine";
  static constexpr std::uint32_t kId = 0x0CF00400;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kEngineSpeed{
      "EngineSpeed", "rad/s", 24, 16, 0U, 64255U, 65279, 65535, 65535U,
      0, 3.141592653589793, 240.0};

  /// Engine speed (SPN 190, bytes 4 and 5). [0 .. 8031.88 rpm on the bus]
  Physical engine_speed_radps{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kEngineSpeed, self.engine_speed_radps);
  }
  static constexpr EEC1 decode(const Payload& payload) {
    return decode_message<EEC1>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// What the operator asks for.
struct OperatorCommand {
  static constexpr const char* kName = "OperatorCommand";
  static constexpr const char* kSender = "Operator";
  static constexpr std::uint32_t kId = 0x0CFF2781;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF27;
  static constexpr std::uint8_t kMaxDeltaCounter = 2;

  enum class Enable : std::uint8_t {
    kOff = 0,
    kOn = 1,
  };

  enum class OperatorMode : std::uint8_t {
    kManual = 0,
    kAutomatic = 1,
  };

  enum class Task : std::uint8_t {
    kNone = 0,
    kDig = 1,
    kGrade = 2,
    kProgram = 3,
    kJog = 4,
    kCoordinated = 5,
    kCommission = 6,
  };

  static constexpr Field kEnable{
      "Enable", "", 12, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kOperatorMode{
      "OperatorMode", "", 16, 4, 0U, 1U, 14, 15, 0U,
      0, 1.0, 1.0};
  static constexpr Field kTask{
      "Task", "", 24, 8, 0U, 6U, 254, 255, 0U,
      0, 1.0, 1.0};
  static constexpr Field kSpeedOverride{
      "SpeedOverride", "", 32, 8, 0U, 200U, 254, 255, 0U,
      0, 1.0, 200.0};
  static constexpr Field kTaskNumber{
      "TaskNumber", "", 40, 8, 0U, 250U, 254, 255, 0U,
      0, 1.0, 1.0};
  static constexpr Field kEcho{
      "Echo", "", 48, 16, 0U, 64255U, 65279, 65535, 65535U,
      0, 1.0, 1.0};

  /// Deadman: motion only while it is On.
  Coded<Enable> enable{Enable::kOff, RawState::kValid};
  /// What the operator lets the controller do.
  Coded<OperatorMode> operator_mode{OperatorMode::kManual, RawState::kValid};
  /// What the controller is to do; a machine refuses the frame if the task is none of its own.
  Coded<Task> task{Task::kNone, RawState::kValid};
  /// Share of the task speed that the operator allows. [0 .. 100 % on the bus]
  Physical speed_override_ratio{physical_of(kSpeedOverride, 0U), RawState::kValid};
  /// Which of the ECU's task files Program means, from 0. [0 .. 250 on the bus]
  Count task_number{0U, RawState::kValid};
  /// The last EcuIdentity.Stamp that the station heard; 0 before the first. Not available: it
  /// cannot tell. [0 .. 64255 on the bus]
  Count echo{0U, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kEnable, self.enable);
    visitor(kOperatorMode, self.operator_mode);
    visitor(kTask, self.task);
    visitor(kSpeedOverride, self.speed_override_ratio);
    visitor(kTaskNumber, self.task_number);
    visitor(kEcho, self.echo);
  }
  static constexpr OperatorCommand decode(const Payload& payload) {
    return decode_message<OperatorCommand>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// What the machine is; arming is refused while it differs from the ECU. Sent also in answer to
/// each EcuIdentity, in the sender's next cycle.
struct MachineIdentity {
  static constexpr const char* kName = "MachineIdentity";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF2880;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 1000;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kProfileHash{
      "ProfileHash", "", 0, 32, 0U, 4294967295U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kDbcVersion{
      "DbcVersion", "", 32, 8, 0U, 250U, 254, 255, 255U,
      0, 1.0, 1.0};
  static constexpr Field kEcho{
      "Echo", "", 40, 16, 0U, 64255U, 65279, 65535, 65535U,
      0, 1.0, 1.0};

  /// Hash of the machine profile that the sender runs with. [0 .. 4294967295 on the bus]
  Count profile_hash{0U, RawState::kValid};
  /// DbcVersion of the sender. [0 .. 250 on the bus]
  Count dbc_version{0U, RawState::kNotAvailable};
  /// The last EcuIdentity.Stamp that the machine heard; 0 before the first. Not available: it
  /// cannot tell. [0 .. 64255 on the bus]
  Count echo{0U, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kProfileHash, self.profile_hash);
    visitor(kDbcVersion, self.dbc_version);
    visitor(kEcho, self.echo);
  }
  static constexpr MachineIdentity decode(const Payload& payload) {
    return decode_message<MachineIdentity>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// State of the controller and what holds it back.
struct EcuStatus {
  static constexpr const char* kName = "EcuStatus";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FF3182;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  enum class Mode : std::uint8_t {
    kSilent = 0,
    kReady = 1,
    kArmed = 2,
    kActive = 3,
    kStopping = 4,
    kFault = 5,
  };

  enum class LimitKind : std::uint8_t {
    kNone = 0,
    kPumpFlow = 1,
    kBackFlow = 2,
    kSpoolTravel = 3,
    kStrokeEnd = 4,
    kRise = 5,
    kDegraded = 6,
    kImplementFlow = 7,
    kTransmissionFlow = 8,
    kAhead = 9,
    kOffGrade = 10,
    kSwingEnd = 11,
    kFence = 12,
    kOffPath = 13,
  };

  enum class Fault : std::uint8_t {
    kNone = 0,
    kStrokeMissing = 1,
    kPressureMissing = 2,
    kSwashMissing = 3,
    kEngineSpeedMissing = 4,
    kOperatorMissing = 5,
    kStrokeImplausible = 6,
    kPoseUnreachable = 7,
    kSolverFailed = 8,
    kCommandNotFinite = 9,
    kCycleStalled = 10,
    kIdentityMismatch = 11,
    kBusOff = 12,
    kBusPassive = 13,
    kBusDown = 14,
    kTransmitFailed = 15,
    kCycleOverrun = 16,
    kMessageCorrupt = 17,
    kMessageSequence = 18,
    kMessageMasquerade = 19,
    kSpoolMissing = 20,
    kSpoolStuck = 21,
    kUncommandedMotion = 22,
    kStrokeStuck = 23,
    kStrokeJump = 24,
    kPressureImplausible = 25,
    kSwashDisagrees = 26,
    kMemoryCorrupt = 27,
    kValveNotFollowing = 28,
    kValueOutOfRange = 29,
    kSensorError = 30,
    kPoseMissing = 31,
    kPoseImplausible = 32,
    kTransmissionMissing = 33,
    kDisplacementDisagrees = 34,
    kDisplacementRunaway = 35,
    kTrackSpeedDisagrees = 36,
    kTaskUnknown = 37,
    kStreamLate = 38,
    kSecondController = 39,
    kEngineStopped = 40,
    kWrongDirection = 41,
    kMotionImplausible = 42,
    kPathLeft = 43,
    kPoseDisagrees = 44,
    kStalling = 45,
    kStalled = 46,
    kBlocked = 47,
    kCommissionBound = 48,
    kNoWay = 49,
  };

  static constexpr Field kMode{
      "Mode", "", 0, 4, 0U, 5U, 14, 15, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLimitKind{
      "LimitKind", "", 4, 4, 0U, 13U, 14, 15, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLimitIndex{
      "LimitIndex", "", 8, 8, 0U, 250U, 254, 255, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLambda{
      "Lambda", "", 16, 16, 0U, 50000U, 65279, 65535, 0U,
      0, 1.0, 50000.0};
  static constexpr Field kFault{
      "Fault", "", 32, 8, 0U, 49U, 254, 255, 0U,
      0, 1.0, 1.0};
  static constexpr Field kCycleTime{
      "CycleTime", "us", 40, 16, 0U, 64255U, 65279, 65535, 0U,
      0, 1.0, 1.0};
  static constexpr Field kRejectedFrames{
      "RejectedFrames", "", 56, 8, 0U, 250U, 254, 255, 0U,
      0, 1.0, 1.0};

  /// State towards the machine; only Active moves metal.
  Coded<Mode> mode{Mode::kSilent, RawState::kValid};
  /// What holds Lambda below 1.
  Coded<LimitKind> limit_kind{LimitKind::kNone, RawState::kValid};
  /// Whose limit it is: the index of the pump for PumpFlow, of the track for TransmissionFlow (left
  /// 0, right 1), of the fence in the task file for Fence, the number of the Fault for Degraded,
  /// else the index of the drive (boom 0, arm 1, bucket 2, swing 3). [0 .. 250 on the bus]
  Count limit_index{0U, RawState::kValid};
  /// Share of the wanted speed that is followed. [0 .. 1 on the bus]
  Physical lambda{physical_of(kLambda, 0U), RawState::kValid};
  /// What stopped the machine; else what slows it; else what is missing.
  Coded<Fault> fault{Fault::kNone, RawState::kValid};
  /// Time that the last control cycle took; stays at its maximum beyond it. [0 .. 64255 us on the
  /// bus]
  Count cycle_time_us{0U, RawState::kValid};
  /// Frames rejected since the start; stays at 250 from there on. [0 .. 250 on the bus]
  Count rejected_frames{0U, RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kMode, self.mode);
    visitor(kLimitKind, self.limit_kind);
    visitor(kLimitIndex, self.limit_index);
    visitor(kLambda, self.lambda);
    visitor(kFault, self.fault);
    visitor(kCycleTime, self.cycle_time_us);
    visitor(kRejectedFrames, self.rejected_frames);
  }
  static constexpr EcuStatus decode(const Payload& payload) {
    return decode_message<EcuStatus>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// What the ECU is.
struct EcuIdentity {
  static constexpr const char* kName = "EcuIdentity";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FF3482;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 1000;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kProfileHash{
      "ProfileHash", "", 0, 32, 0U, 4294967295U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kDbcVersion{
      "DbcVersion", "", 32, 8, 0U, 250U, 254, 255, 255U,
      0, 1.0, 1.0};
  static constexpr Field kStamp{
      "Stamp", "", 40, 16, 0U, 64255U, 65279, 65535, 65535U,
      0, 1.0, 1.0};

  /// Hash of the machine profile that the sender runs with. [0 .. 4294967295 on the bus]
  Count profile_hash{0U, RawState::kValid};
  /// DbcVersion of the sender. [0 .. 250 on the bus]
  Count dbc_version{0U, RawState::kNotAvailable};
  /// Another one in each frame. Operator and machine repeat it as Echo: one that comes late shows
  /// how long frames are on their way. [0 .. 64255 on the bus]
  Count stamp{0U, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kProfileHash, self.profile_hash);
    visitor(kDbcVersion, self.dbc_version);
    visitor(kStamp, self.stamp);
  }
  static constexpr EcuIdentity decode(const Payload& payload) {
    return decode_message<EcuIdentity>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Why the controller is not armed, and how its process fares.
struct EcuHealth {
  static constexpr const char* kName = "EcuHealth";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FF3682;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 100;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  enum class RealTime : std::uint8_t {
    kOff = 0,
    kOn = 1,
  };

  enum class StandIn : std::uint8_t {
    kOff = 0,
    kOn = 1,
  };

  static constexpr Field kWhyNotArmed{
      "WhyNotArmed", "", 0, 32, 0U, 4294967295U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kAllocations{
      "Allocations", "", 32, 4, 0U, 13U, 14, 15, 15U,
      0, 1.0, 1.0};
  static constexpr Field kPageFaults{
      "PageFaults", "", 40, 8, 0U, 250U, 254, 255, 255U,
      0, 1.0, 1.0};
  static constexpr Field kOverruns{
      "Overruns", "", 48, 8, 0U, 250U, 254, 255, 255U,
      0, 1.0, 1.0};
  static constexpr Field kDroppedFrames{
      "DroppedFrames", "", 56, 8, 0U, 250U, 254, 255, 255U,
      0, 1.0, 1.0};
  static constexpr Field kRealTime{
      "RealTime", "", 36, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kStandIn{
      "StandIn", "", 38, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};

  /// A bit for each reason, from bit 0: stroke, pressure, swash, engine speed, operator, spool,
  /// identity, bus, messages, unreachable, cycle, manual, task not at rest, enable not fresh, fault
  /// latched, stopping, pose, transmission, not centred, valve, controller, sensor error, task,
  /// stream late, second controller, engine stopped, path. 0 when armed. [0 .. 4294967295 on the
  /// bus]
  Count why_not_armed{0U, RawState::kValid};
  /// Heap allocations of the process since its first cycle; stays at 13 from there on. [0 .. 13 on
  /// the bus]
  Count allocations{0U, RawState::kNotAvailable};
  /// Page faults of the control thread since its first cycle; stays at 250 from there on. [0 .. 250
  /// on the bus]
  Count page_faults{0U, RawState::kNotAvailable};
  /// Late cycles since the start; stays at 250 from there on. [0 .. 250 on the bus]
  Count overruns{0U, RawState::kNotAvailable};
  /// Frames since the start that the bus did not take; stays at 250 from there on. [0 .. 250 on the
  /// bus]
  Count dropped_frames{0U, RawState::kNotAvailable};
  /// Off: the process runs without real-time priority and memory lock.
  Coded<RealTime> real_time{RealTime::kOff, RawState::kValid};
  /// On: the bus does not carry all that the controller checks, and the profile says what stands in
  /// for it.
  Coded<StandIn> stand_in{StandIn::kOff, RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kWhyNotArmed, self.why_not_armed);
    visitor(kAllocations, self.allocations);
    visitor(kPageFaults, self.page_faults);
    visitor(kOverruns, self.overruns);
    visitor(kDroppedFrames, self.dropped_frames);
    visitor(kRealTime, self.real_time);
    visitor(kStandIn, self.stand_in);
  }
  static constexpr EcuHealth decode(const Payload& payload) {
    return decode_message<EcuHealth>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Active diagnostic trouble codes (PGN 65226), one a frame: no transport protocol is used. Several
/// active codes take turns, so that up to ten of them are each on the bus within 1 s: the period is
/// 1 s over their number, at least 100 ms, and a new one is sent at once. With none: lamps off, SPN
/// 0 and FMI 0 once a second. Byte 2 (flashing) and bytes 7 and 8 are all 1.
struct DM1 {
  static constexpr const char* kName = "DM1";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FECA82;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 1000;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  enum class ProtectLamp : std::uint8_t {
    kOff = 0,
    kOn = 1,
  };

  enum class AmberWarningLamp : std::uint8_t {
    kOff = 0,
    kOn = 1,
  };

  enum class RedStopLamp : std::uint8_t {
    kOff = 0,
    kOn = 1,
  };

  enum class MalfunctionIndicatorLamp : std::uint8_t {
    kOff = 0,
    kOn = 1,
  };

  static constexpr Field kProtectLamp{
      "ProtectLamp", "", 0, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kAmberWarningLamp{
      "AmberWarningLamp", "", 2, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kRedStopLamp{
      "RedStopLamp", "", 4, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kMalfunctionIndicatorLamp{
      "MalfunctionIndicatorLamp", "", 6, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kSpnLow{
      "SpnLow", "", 16, 16, 0U, 65535U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kFmi{
      "Fmi", "", 32, 5, 0U, 31U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kSpnHigh{
      "SpnHigh", "", 37, 3, 0U, 7U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kOccurrenceCount{
      "OccurrenceCount", "", 40, 7, 0U, 127U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kConversionMethod{
      "ConversionMethod", "", 47, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};

  /// Not used: always Off.
  Coded<ProtectLamp> protect_lamp{ProtectLamp::kOff, RawState::kValid};
  /// A fault is there that does not stop the machine.
  Coded<AmberWarningLamp> amber_warning_lamp{AmberWarningLamp::kOff, RawState::kValid};
  /// A fault is there that stops the machine.
  Coded<RedStopLamp> red_stop_lamp{RedStopLamp::kOff, RawState::kValid};
  /// For emissions only: always Off.
  Coded<MalfunctionIndicatorLamp> malfunction_indicator_lamp{MalfunctionIndicatorLamp::kOff, RawState::kValid};
  /// Low 16 bits of the suspect parameter number. SPN = 520192 + EcuStatus.Fault, in the range that
  /// is the maker's to assign. [0 .. 65535 on the bus]
  Count spn_low{0U, RawState::kValid};
  /// Failure mode identifier: 2 erratic, 7 not responding, 9 abnormal update rate, 10 abnormal rate
  /// of change, 12 bad device, 14 special instructions, 19 received network data in error, 31
  /// condition exists. [0 .. 31 on the bus]
  Count fmi{0U, RawState::kValid};
  /// High 3 bits of the suspect parameter number. [0 .. 7 on the bus]
  Count spn_high{0U, RawState::kValid};
  /// How often the fault has appeared since the start, 1 .. 126; stays at 126. 0 with none, 127 is
  /// 'not available'. [0 .. 127 on the bus]
  Count occurrence_count{0U, RawState::kValid};
  /// 0: SPN in the layout of version 4. [0 .. 1 on the bus]
  Count conversion_method{0U, RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kProtectLamp, self.protect_lamp);
    visitor(kAmberWarningLamp, self.amber_warning_lamp);
    visitor(kRedStopLamp, self.red_stop_lamp);
    visitor(kMalfunctionIndicatorLamp, self.malfunction_indicator_lamp);
    visitor(kSpnLow, self.spn_low);
    visitor(kFmi, self.fmi);
    visitor(kSpnHigh, self.spn_high);
    visitor(kOccurrenceCount, self.occurrence_count);
    visitor(kConversionMethod, self.conversion_method);
  }
  static constexpr DM1 decode(const Payload& payload) {
    return decode_message<DM1>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

using AllMessages =
    MessageList<EEC1,
                OperatorCommand,
                MachineIdentity,
                EcuStatus,
                EcuIdentity,
                EcuHealth,
                DM1>;

inline constexpr std::array<MessageInfo, 7> kMessages{{
    message_info<EEC1>(),
    message_info<OperatorCommand>(),
    message_info<MachineIdentity>(),
    message_info<EcuStatus>(),
    message_info<EcuIdentity>(),
    message_info<EcuHealth>(),
    message_info<DM1>(),
}};

/// All of this as one type, for what is the same on every machine kind's bus.
struct Dbc {
  using EEC1 = common::EEC1;
  using OperatorCommand = common::OperatorCommand;
  using MachineIdentity = common::MachineIdentity;
  using EcuStatus = common::EcuStatus;
  using EcuIdentity = common::EcuIdentity;
  using EcuHealth = common::EcuHealth;
  using DM1 = common::DM1;
  using AllMessages = common::AllMessages;
  static constexpr const auto& kMessages = common::kMessages;
  static constexpr std::uint8_t kDbcVersion = common::kDbcVersion;
};

}  // namespace graben::dbc::common
