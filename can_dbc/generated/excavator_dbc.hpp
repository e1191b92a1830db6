// Generated from excavator.dbc by can_dbc/generate.py; change the DBC and generate again.
// clang-format off
#pragma once
/// J1939-addressed frames of an excavator and its controller. Intel byte order, unused bits 1. A
/// protected message has its CRC in byte 0 and its counter in the low nibble of byte 1. Extension
/// is positive for stroke, velocity and duty.
/// Values are in the SI unit that their name ends with. A message that nobody has filled in carries
/// the start values. encode() rounds to the nearest raw value and saturates into [min|max]; NaN and
/// infinities become the signal's error value, or its start value where it has none; bits of no
/// signal are 1. CRC and counter are left to the end-to-end protection.

#include <array>
#include <cstdint>

#include "can_dbc/codec.hpp"

namespace graben::dbc::excavator {

inline constexpr std::uint8_t kDbcVersion = 1;

/// Measured stroke of the boom cylinder.
struct BoomStroke {
  static constexpr const char* kName = "BoomStroke";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF2080;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF20;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kBoomStroke{
      "BoomStroke", "m", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1.0, 20000.0};

  /// Stroke of the boom cylinder; counts from the closed cylinder, extension is positive. [0 ..
  /// 3200 mm on the bus]
  Physical boom_stroke_m{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBoomStroke, self.boom_stroke_m);
  }
  static constexpr BoomStroke decode(const Payload& payload) {
    return decode_message<BoomStroke>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Measured stroke of the arm cylinder.
struct ArmStroke {
  static constexpr const char* kName = "ArmStroke";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF2180;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF21;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kArmStroke{
      "ArmStroke", "m", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1.0, 20000.0};

  /// Stroke of the arm cylinder; counts from the closed cylinder, extension is positive. [0 .. 3200
  /// mm on the bus]
  Physical arm_stroke_m{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kArmStroke, self.arm_stroke_m);
  }
  static constexpr ArmStroke decode(const Payload& payload) {
    return decode_message<ArmStroke>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Measured stroke of the bucket cylinder.
struct BucketStroke {
  static constexpr const char* kName = "BucketStroke";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF2280;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF22;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kBucketStroke{
      "BucketStroke", "m", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1.0, 20000.0};

  /// Stroke of the bucket cylinder; counts from the closed cylinder, extension is positive. [0 ..
  /// 3200 mm on the bus]
  Physical bucket_stroke_m{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBucketStroke, self.bucket_stroke_m);
  }
  static constexpr BucketStroke decode(const Payload& payload) {
    return decode_message<BucketStroke>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Measured chamber pressures of the boom cylinder.
struct BoomPressure {
  static constexpr const char* kName = "BoomPressure";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF2380;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF23;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kBoomCapPressure{
      "BoomCapPressure", "Pa", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1000.0, 1.0};
  static constexpr Field kBoomRodPressure{
      "BoomRodPressure", "Pa", 32, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1000.0, 1.0};

  /// Pressure in the cap (piston) side of the boom cylinder, above ambient. [0 .. 64 MPa on the
  /// bus]
  Physical boom_cap_pressure_pa{0.0, RawState::kNotAvailable};
  /// Pressure in the rod side of the boom cylinder, above ambient. [0 .. 64 MPa on the bus]
  Physical boom_rod_pressure_pa{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBoomCapPressure, self.boom_cap_pressure_pa);
    visitor(kBoomRodPressure, self.boom_rod_pressure_pa);
  }
  static constexpr BoomPressure decode(const Payload& payload) {
    return decode_message<BoomPressure>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Measured chamber pressures of the arm cylinder.
struct ArmPressure {
  static constexpr const char* kName = "ArmPressure";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF2480;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF24;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kArmCapPressure{
      "ArmCapPressure", "Pa", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1000.0, 1.0};
  static constexpr Field kArmRodPressure{
      "ArmRodPressure", "Pa", 32, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1000.0, 1.0};

  /// Pressure in the cap (piston) side of the arm cylinder, above ambient. [0 .. 64 MPa on the bus]
  Physical arm_cap_pressure_pa{0.0, RawState::kNotAvailable};
  /// Pressure in the rod side of the arm cylinder, above ambient. [0 .. 64 MPa on the bus]
  Physical arm_rod_pressure_pa{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kArmCapPressure, self.arm_cap_pressure_pa);
    visitor(kArmRodPressure, self.arm_rod_pressure_pa);
  }
  static constexpr ArmPressure decode(const Payload& payload) {
    return decode_message<ArmPressure>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Measured chamber pressures of the bucket cylinder.
struct BucketPressure {
  static constexpr const char* kName = "BucketPressure";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF2580;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF25;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kBucketCapPressure{
      "BucketCapPressure", "Pa", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1000.0, 1.0};
  static constexpr Field kBucketRodPressure{
      "BucketRodPressure", "Pa", 32, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1000.0, 1.0};

  /// Pressure in the cap (piston) side of the bucket cylinder, above ambient. [0 .. 64 MPa on the
  /// bus]
  Physical bucket_cap_pressure_pa{0.0, RawState::kNotAvailable};
  /// Pressure in the rod side of the bucket cylinder, above ambient. [0 .. 64 MPa on the bus]
  Physical bucket_rod_pressure_pa{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBucketCapPressure, self.bucket_cap_pressure_pa);
    visitor(kBucketRodPressure, self.bucket_rod_pressure_pa);
  }
  static constexpr BucketPressure decode(const Payload& payload) {
    return decode_message<BucketPressure>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Measured swash of both pumps.
struct PumpState {
  static constexpr const char* kName = "PumpState";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF2680;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF26;
  static constexpr std::uint8_t kMaxDeltaCounter = 2;

  static constexpr Field kPump1Swash{
      "Pump1Swash", "", 16, 16, 0U, 60000U, 65279, 65535, 65535U,
      0, 1.0, 50000.0};
  static constexpr Field kPump2Swash{
      "Pump2Swash", "", 32, 16, 0U, 60000U, 65279, 65535, 65535U,
      0, 1.0, 50000.0};

  /// Swash of pump 1: tan(alpha) over tan(alpha at full swash). [0 .. 120 % on the bus]
  Physical pump1_swash_ratio{0.0, RawState::kNotAvailable};
  /// Swash of pump 2: tan(alpha) over tan(alpha at full swash). [0 .. 120 % on the bus]
  Physical pump2_swash_ratio{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kPump1Swash, self.pump1_swash_ratio);
    visitor(kPump2Swash, self.pump2_swash_ratio);
  }
  static constexpr PumpState decode(const Payload& payload) {
    return decode_message<PumpState>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

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
  };

  static constexpr Field kEnable{
      "Enable", "", 12, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kOperatorMode{
      "OperatorMode", "", 16, 4, 0U, 1U, 14, 15, 0U,
      0, 1.0, 1.0};
  static constexpr Field kTask{
      "Task", "", 24, 8, 0U, 1U, 254, 255, 0U,
      0, 1.0, 1.0};
  static constexpr Field kSpeedOverride{
      "SpeedOverride", "", 32, 8, 0U, 200U, 254, 255, 0U,
      0, 1.0, 200.0};

  /// Deadman: motion only while it is On.
  Coded<Enable> enable{Enable::kOff, RawState::kValid};
  /// What the operator lets the controller do.
  Coded<OperatorMode> operator_mode{OperatorMode::kManual, RawState::kValid};
  /// What the controller is to do.
  Coded<Task> task{Task::kNone, RawState::kValid};
  /// Share of the task speed that the operator allows. [0 .. 100 % on the bus]
  Physical speed_override_ratio{physical_of(kSpeedOverride, 0U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kEnable, self.enable);
    visitor(kOperatorMode, self.operator_mode);
    visitor(kTask, self.task);
    visitor(kSpeedOverride, self.speed_override_ratio);
  }
  static constexpr OperatorCommand decode(const Payload& payload) {
    return decode_message<OperatorCommand>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// What the machine is; arming is refused while it differs from the ECU.
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

  /// Hash of the machine profile that the sender runs with. [0 .. 4294967295 on the bus]
  Count profile_hash{0U, RawState::kValid};
  /// DbcVersion of the sender. [0 .. 250 on the bus]
  Count dbc_version{0U, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kProfileHash, self.profile_hash);
    visitor(kDbcVersion, self.dbc_version);
  }
  static constexpr MachineIdentity decode(const Payload& payload) {
    return decode_message<MachineIdentity>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Commands to the pilot valves. The valve side closes every spool without it.
struct SpoolCommand {
  static constexpr const char* kName = "SpoolCommand";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x0CFF3082;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF30;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  enum class Enable : std::uint8_t {
    kOff = 0,
    kOn = 1,
  };

  static constexpr Field kEnable{
      "Enable", "", 12, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kBoomDuty{
      "BoomDuty", "", 16, 16, 12000U, 52000U, 65279, 65535, 32000U,
      -32000, 1.0, 20000.0};
  static constexpr Field kArmDuty{
      "ArmDuty", "", 32, 16, 12000U, 52000U, 65279, 65535, 32000U,
      -32000, 1.0, 20000.0};
  static constexpr Field kBucketDuty{
      "BucketDuty", "", 48, 16, 12000U, 52000U, 65279, 65535, 32000U,
      -32000, 1.0, 20000.0};

  /// Spools may open only while it is On.
  Coded<Enable> enable{Enable::kOff, RawState::kValid};
  /// Duty of the boom spool; positive extends the cylinder, 0 is neutral. [-1000 .. 1000 per mille
  /// on the bus]
  Physical boom_duty_ratio{physical_of(kBoomDuty, 32000U), RawState::kValid};
  /// Duty of the arm spool; positive extends the cylinder, 0 is neutral. [-1000 .. 1000 per mille
  /// on the bus]
  Physical arm_duty_ratio{physical_of(kArmDuty, 32000U), RawState::kValid};
  /// Duty of the bucket spool; positive extends the cylinder, 0 is neutral. [-1000 .. 1000 per
  /// mille on the bus]
  Physical bucket_duty_ratio{physical_of(kBucketDuty, 32000U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kEnable, self.enable);
    visitor(kBoomDuty, self.boom_duty_ratio);
    visitor(kArmDuty, self.arm_duty_ratio);
    visitor(kBucketDuty, self.bucket_duty_ratio);
  }
  static constexpr SpoolCommand decode(const Payload& payload) {
    return decode_message<SpoolCommand>(payload);
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
  };

  static constexpr Field kMode{
      "Mode", "", 0, 4, 0U, 5U, 14, 15, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLimitKind{
      "LimitKind", "", 4, 4, 0U, 5U, 14, 15, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLimitIndex{
      "LimitIndex", "", 8, 4, 0U, 13U, 14, 15, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLambda{
      "Lambda", "", 16, 16, 0U, 50000U, 65279, 65535, 0U,
      0, 1.0, 50000.0};
  static constexpr Field kFault{
      "Fault", "", 32, 8, 0U, 11U, 254, 255, 0U,
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
  /// Whose limit it is: the index of the pump for PumpFlow, else of the actuator (boom 0, arm 1,
  /// bucket 2). [0 .. 13 on the bus]
  Count limit_index{0U, RawState::kValid};
  /// Share of the wanted velocity that the hydraulics can follow. [0 .. 1 on the bus]
  Physical lambda{physical_of(kLambda, 0U), RawState::kValid};
  /// What stopped the machine.
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

/// Wanted cylinder velocities before they are scaled by Lambda.
struct EcuMotion {
  static constexpr const char* kName = "EcuMotion";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FF3282;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kBoomWantedVelocity{
      "BoomWantedVelocity", "m/s", 0, 16, 0U, 64000U, 65279, 65535, 30000U,
      -30000, 1.0, 10000.0};
  static constexpr Field kArmWantedVelocity{
      "ArmWantedVelocity", "m/s", 16, 16, 0U, 64000U, 65279, 65535, 30000U,
      -30000, 1.0, 10000.0};
  static constexpr Field kBucketWantedVelocity{
      "BucketWantedVelocity", "m/s", 32, 16, 0U, 64000U, 65279, 65535, 30000U,
      -30000, 1.0, 10000.0};

  /// Wanted velocity of the boom cylinder; extension is positive. [-3000 .. 3400 mm/s on the bus]
  Physical boom_wanted_velocity_mps{physical_of(kBoomWantedVelocity, 30000U), RawState::kValid};
  /// Wanted velocity of the arm cylinder; extension is positive. [-3000 .. 3400 mm/s on the bus]
  Physical arm_wanted_velocity_mps{physical_of(kArmWantedVelocity, 30000U), RawState::kValid};
  /// Wanted velocity of the bucket cylinder; extension is positive. [-3000 .. 3400 mm/s on the bus]
  Physical bucket_wanted_velocity_mps{physical_of(kBucketWantedVelocity, 30000U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBoomWantedVelocity, self.boom_wanted_velocity_mps);
    visitor(kArmWantedVelocity, self.arm_wanted_velocity_mps);
    visitor(kBucketWantedVelocity, self.bucket_wanted_velocity_mps);
  }
  static constexpr EcuMotion decode(const Payload& payload) {
    return decode_message<EcuMotion>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// What the solution expects of the hydraulics, and how well the path is kept.
struct EcuHydraulics {
  static constexpr const char* kName = "EcuHydraulics";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FF3382;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kPump1ExpectedPressure{
      "Pump1ExpectedPressure", "Pa", 0, 16, 0U, 64000U, 65279, 65535, 0U,
      0, 2000.0, 1.0};
  static constexpr Field kPump2ExpectedPressure{
      "Pump2ExpectedPressure", "Pa", 16, 16, 0U, 64000U, 65279, 65535, 0U,
      0, 2000.0, 1.0};
  static constexpr Field kPathError{
      "PathError", "m", 32, 16, 0U, 64000U, 65279, 65535, 0U,
      0, 1.0, 10000.0};

  /// Delivery pressure of pump 1 that the solution expects, above ambient. [0 .. 128 MPa on the
  /// bus]
  Physical pump1_expected_pressure_pa{physical_of(kPump1ExpectedPressure, 0U), RawState::kValid};
  /// Delivery pressure of pump 2 that the solution expects, above ambient. [0 .. 128 MPa on the
  /// bus]
  Physical pump2_expected_pressure_pa{physical_of(kPump2ExpectedPressure, 0U), RawState::kValid};
  /// Distance of the measured bucket tip from the path. [0 .. 6400 mm on the bus]
  Physical path_error_m{physical_of(kPathError, 0U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kPump1ExpectedPressure, self.pump1_expected_pressure_pa);
    visitor(kPump2ExpectedPressure, self.pump2_expected_pressure_pa);
    visitor(kPathError, self.path_error_m);
  }
  static constexpr EcuHydraulics decode(const Payload& payload) {
    return decode_message<EcuHydraulics>(payload);
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

  /// Hash of the machine profile that the sender runs with. [0 .. 4294967295 on the bus]
  Count profile_hash{0U, RawState::kValid};
  /// DbcVersion of the sender. [0 .. 250 on the bus]
  Count dbc_version{0U, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kProfileHash, self.profile_hash);
    visitor(kDbcVersion, self.dbc_version);
  }
  static constexpr EcuIdentity decode(const Payload& payload) {
    return decode_message<EcuIdentity>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

using AllMessages =
    MessageList<BoomStroke,
                ArmStroke,
                BucketStroke,
                BoomPressure,
                ArmPressure,
                BucketPressure,
                PumpState,
                EEC1,
                OperatorCommand,
                MachineIdentity,
                SpoolCommand,
                EcuStatus,
                EcuMotion,
                EcuHydraulics,
                EcuIdentity>;

inline constexpr std::array<MessageInfo, 15> kMessages{{
    message_info<BoomStroke>(),
    message_info<ArmStroke>(),
    message_info<BucketStroke>(),
    message_info<BoomPressure>(),
    message_info<ArmPressure>(),
    message_info<BucketPressure>(),
    message_info<PumpState>(),
    message_info<EEC1>(),
    message_info<OperatorCommand>(),
    message_info<MachineIdentity>(),
    message_info<SpoolCommand>(),
    message_info<EcuStatus>(),
    message_info<EcuMotion>(),
    message_info<EcuHydraulics>(),
    message_info<EcuIdentity>(),
}};

}  // namespace graben::dbc::excavator
