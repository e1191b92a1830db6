// SPDX-License-Identifier: Apache-2.0
// Generated from excavator.dbc.in by can_dbc/generate.py; change the DBC and generate again.
// clang-format off
#pragma once
/// J1939-addressed frames of an excavator and its controller. Extension is positive for stroke,
/// velocity and duty. Intel byte order, unused bits 1. A protected message has its CRC in byte 0
/// and its counter in the low nibble of byte 1.
/// Values are in the SI unit that their name ends with. A message that nobody has filled in carries
/// the start values. encode() rounds to the nearest raw value and saturates into [min|max]; NaN and
/// infinities become the signal's error value, or its start value where it has none; bits of no
/// signal are 1. CRC and counter are left to the end-to-end protection.

#include <array>
#include <cstdint>

#include "can_dbc/codec.hpp"
#include "can_dbc/generated/common_dbc.hpp"

namespace graben::dbc::excavator {

inline constexpr std::uint8_t kDbcVersion = 10;

using common::EEC1;
using common::OperatorCommand;
using common::MachineIdentity;
using common::EcuStatus;
using common::EcuIdentity;
using common::EcuHealth;
using common::DM1;

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

/// Measured swing of the platform; of a machine whose profile has a swing drive.
struct SwingState {
  static constexpr const char* kName = "SwingState";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF2A80;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF2A;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kSwingAngle{
      "SwingAngle", "rad", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 10000.0};
  static constexpr Field kSwingLeftPressure{
      "SwingLeftPressure", "Pa", 32, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1000.0, 1.0};
  static constexpr Field kSwingRightPressure{
      "SwingRightPressure", "Pa", 48, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1000.0, 1.0};

  /// Swing about the vertical; 0 looks along x, to the left is positive. [-3200 .. 3200 mrad on the
  /// bus]
  Physical swing_angle_rad{0.0, RawState::kNotAvailable};
  /// Pressure at the motor port that turns the platform to the left, above ambient. [0 .. 64 MPa on
  /// the bus]
  Physical swing_left_pressure_pa{0.0, RawState::kNotAvailable};
  /// Pressure at the motor port that turns it to the right, above ambient. [0 .. 64 MPa on the bus]
  Physical swing_right_pressure_pa{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kSwingAngle, self.swing_angle_rad);
    visitor(kSwingLeftPressure, self.swing_left_pressure_pa);
    visitor(kSwingRightPressure, self.swing_right_pressure_pa);
  }
  static constexpr SwingState decode(const Payload& payload) {
    return decode_message<SwingState>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// What the valve side measures and does.
struct ValveState {
  static constexpr const char* kName = "ValveState";
  static constexpr const char* kSender = "Valve";
  static constexpr std::uint32_t kId = 0x0CFF2983;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF29;
  static constexpr std::uint8_t kMaxDeltaCounter = 2;

  enum class Enabled : std::uint8_t {
    kOff = 0,
    kOn = 1,
  };

  static constexpr Field kEnabled{
      "Enabled", "", 12, 2, 0U, 1U, 2, 3, 3U,
      0, 1.0, 1.0};
  static constexpr Field kBoomSpool{
      "BoomSpool", "", 16, 16, 12000U, 52000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};
  static constexpr Field kArmSpool{
      "ArmSpool", "", 32, 16, 12000U, 52000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};
  static constexpr Field kBucketSpool{
      "BucketSpool", "", 48, 16, 12000U, 52000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};

  /// Echo: the enable that the valve side acts on; spools are held closed while it is Off.
  Coded<Enabled> enabled{{}, RawState::kNotAvailable};
  /// Measured position of the boom spool over its full travel x_m, deadband included; positive
  /// extends the cylinder. [-1000 .. 1000 per mille on the bus]
  Physical boom_spool_ratio{0.0, RawState::kNotAvailable};
  /// Measured position of the arm spool over its full travel x_m, deadband included; positive
  /// extends the cylinder. [-1000 .. 1000 per mille on the bus]
  Physical arm_spool_ratio{0.0, RawState::kNotAvailable};
  /// Measured position of the bucket spool over its full travel x_m, deadband included; positive
  /// extends the cylinder. [-1000 .. 1000 per mille on the bus]
  Physical bucket_spool_ratio{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kEnabled, self.enabled);
    visitor(kBoomSpool, self.boom_spool_ratio);
    visitor(kArmSpool, self.arm_spool_ratio);
    visitor(kBucketSpool, self.bucket_spool_ratio);
  }
  static constexpr ValveState decode(const Payload& payload) {
    return decode_message<ValveState>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// What the valve side measures of the swing section.
struct SwingValveState {
  static constexpr const char* kName = "SwingValveState";
  static constexpr const char* kSender = "Valve";
  static constexpr std::uint32_t kId = 0x0CFF2B83;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF2B;
  static constexpr std::uint8_t kMaxDeltaCounter = 2;

  static constexpr Field kSwingSpool{
      "SwingSpool", "", 16, 16, 12000U, 52000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};

  /// Measured position of the swing spool over its full travel x_m, deadband included; positive
  /// turns to the left. [-1000 .. 1000 per mille on the bus]
  Physical swing_spool_ratio{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kSwingSpool, self.swing_spool_ratio);
  }
  static constexpr SwingValveState decode(const Payload& payload) {
    return decode_message<SwingValveState>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Where the operator's levers are. Jog moves each drive by its own axis, Coordinated the teeth; no
/// other task looks at it. Without it these two do not move.
struct OperatorAxes {
  static constexpr const char* kName = "OperatorAxes";
  static constexpr const char* kSender = "Operator";
  static constexpr std::uint32_t kId = 0x0CFF2C81;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF2C;
  static constexpr std::uint8_t kMaxDeltaCounter = 2;

  static constexpr Field kBoomOrUp{
      "BoomOrUp", "", 16, 8, 0U, 250U, 254, 255, 255U,
      -125, 1.0, 125.0};
  static constexpr Field kArmOrForward{
      "ArmOrForward", "", 24, 8, 0U, 250U, 254, 255, 255U,
      -125, 1.0, 125.0};
  static constexpr Field kBucketOrAttitude{
      "BucketOrAttitude", "", 32, 8, 0U, 250U, 254, 255, 255U,
      -125, 1.0, 125.0};
  static constexpr Field kSwing{
      "Swing", "", 40, 8, 0U, 250U, 254, 255, 255U,
      -125, 1.0, 125.0};

  /// Jog: speed of the boom, raising is positive. Coordinated: of the teeth, up is positive. [-100
  /// .. 100 % on the bus]
  Physical boom_or_up_ratio{0.0, RawState::kNotAvailable};
  /// Jog: speed of the arm cylinder, extension is positive. Coordinated: of the teeth, away from
  /// the machine is positive. [-100 .. 100 % on the bus]
  Physical arm_or_forward_ratio{0.0, RawState::kNotAvailable};
  /// Jog: speed of the bucket cylinder, extension is positive. Coordinated: of the bucket's
  /// attitude, opening is positive. [-100 .. 100 % on the bus]
  Physical bucket_or_attitude_ratio{0.0, RawState::kNotAvailable};
  /// Speed of the swing, to the left is positive. Not available: the station has no such axis.
  /// [-100 .. 100 % on the bus]
  Physical swing_ratio{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBoomOrUp, self.boom_or_up_ratio);
    visitor(kArmOrForward, self.arm_or_forward_ratio);
    visitor(kBucketOrAttitude, self.bucket_or_attitude_ratio);
    visitor(kSwing, self.swing_ratio);
  }
  static constexpr OperatorAxes decode(const Payload& payload) {
    return decode_message<OperatorAxes>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Duties that task Commission is to try, of two drives at most. No other task looks at it.
struct CommissionDuty {
  static constexpr const char* kName = "CommissionDuty";
  static constexpr const char* kSender = "Operator";
  static constexpr std::uint32_t kId = 0x0CFF2D81;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF2D;
  static constexpr std::uint8_t kMaxDeltaCounter = 2;

  static constexpr Field kBoomDuty{
      "BoomDuty", "", 16, 16, 12000U, 52000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};
  static constexpr Field kArmDuty{
      "ArmDuty", "", 32, 16, 12000U, 52000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};
  static constexpr Field kBucketDuty{
      "BucketDuty", "", 48, 16, 12000U, 52000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};

  /// Duty of the boom spool; positive extends the cylinder, 0 is neutral. [-1000 .. 1000 per mille
  /// on the bus]
  Physical boom_duty_ratio{0.0, RawState::kNotAvailable};
  /// Duty of the arm spool; positive extends the cylinder, 0 is neutral. [-1000 .. 1000 per mille
  /// on the bus]
  Physical arm_duty_ratio{0.0, RawState::kNotAvailable};
  /// Duty of the bucket spool; positive extends the cylinder, 0 is neutral. [-1000 .. 1000 per
  /// mille on the bus]
  Physical bucket_duty_ratio{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBoomDuty, self.boom_duty_ratio);
    visitor(kArmDuty, self.arm_duty_ratio);
    visitor(kBucketDuty, self.bucket_duty_ratio);
  }
  static constexpr CommissionDuty decode(const Payload& payload) {
    return decode_message<CommissionDuty>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Window that the operator has confirmed for a drive in task Commission; the drives take turns. A
/// drive without a window of the last second does not move.
struct CommissionWindow {
  static constexpr const char* kName = "CommissionWindow";
  static constexpr const char* kSender = "Operator";
  static constexpr std::uint32_t kId = 0x0CFF2E81;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 100;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF2E;
  static constexpr std::uint8_t kMaxDeltaCounter = 2;

  enum class Drive : std::uint8_t {
    kBoom = 0,
    kArm = 1,
    kBucket = 2,
  };

  static constexpr Field kDrive{
      "Drive", "", 12, 4, 0U, 2U, 14, 15, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLeastStroke{
      "LeastStroke", "m", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1.0, 20000.0};
  static constexpr Field kMostStroke{
      "MostStroke", "m", 32, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1.0, 20000.0};
  static constexpr Field kMostSpeed{
      "MostSpeed", "m/s", 48, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1.0, 20000.0};

  /// Whose window it is.
  Coded<Drive> drive{Drive::kBoom, RawState::kValid};
  /// The cylinder is stopped where it retracts beyond it. [0 .. 3200 mm on the bus]
  Physical least_stroke_m{0.0, RawState::kNotAvailable};
  /// The cylinder is stopped where it extends beyond it. [0 .. 3200 mm on the bus]
  Physical most_stroke_m{0.0, RawState::kNotAvailable};
  /// The cylinder is stopped where it moves faster. [0 .. 3200 mm/s on the bus]
  Physical most_speed_mps{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kDrive, self.drive);
    visitor(kLeastStroke, self.least_stroke_m);
    visitor(kMostStroke, self.most_stroke_m);
    visitor(kMostSpeed, self.most_speed_mps);
  }
  static constexpr CommissionWindow decode(const Payload& payload) {
    return decode_message<CommissionWindow>(payload);
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

  enum class PilotCut : std::uint8_t {
    kOff = 0,
    kOn = 1,
  };

  static constexpr Field kEnable{
      "Enable", "", 12, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kPilotCut{
      "PilotCut", "", 14, 2, 0U, 1U, 2, 3, 0U,
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
  /// On asks for the pilot pressure to be cut: every spool centres by its springs, whatever holds
  /// it.
  Coded<PilotCut> pilot_cut{PilotCut::kOff, RawState::kValid};
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
    visitor(kPilotCut, self.pilot_cut);
    visitor(kBoomDuty, self.boom_duty_ratio);
    visitor(kArmDuty, self.arm_duty_ratio);
    visitor(kBucketDuty, self.bucket_duty_ratio);
  }
  static constexpr SpoolCommand decode(const Payload& payload) {
    return decode_message<SpoolCommand>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Commands to the pumps. Without it, or without a value, a pump keeps the swash that the machine
/// is set to.
struct PumpCommand {
  static constexpr const char* kName = "PumpCommand";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x0CFF3582;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF35;
  static constexpr std::uint8_t kMaxDeltaCounter = 2;

  static constexpr Field kPump1Swash{
      "Pump1Swash", "", 16, 16, 0U, 60000U, 65279, 65535, 65535U,
      0, 1.0, 50000.0};
  static constexpr Field kPump2Swash{
      "Pump2Swash", "", 32, 16, 0U, 60000U, 65279, 65535, 65535U,
      0, 1.0, 50000.0};

  /// Wanted swash of pump 1: tan(alpha) over tan(alpha at full swash); not available: not
  /// commanded. [0 .. 120 % on the bus]
  Physical pump1_swash_ratio{0.0, RawState::kNotAvailable};
  /// Wanted swash of pump 2: tan(alpha) over tan(alpha at full swash); not available: not
  /// commanded. [0 .. 120 % on the bus]
  Physical pump2_swash_ratio{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kPump1Swash, self.pump1_swash_ratio);
    visitor(kPump2Swash, self.pump2_swash_ratio);
  }
  static constexpr PumpCommand decode(const Payload& payload) {
    return decode_message<PumpCommand>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Command to the pilot valve of the swing section; sent where the profile has a swing drive. The
/// spool opens only while SpoolCommand and this both say On.
struct SwingCommand {
  static constexpr const char* kName = "SwingCommand";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x0CFF3782;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF37;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  enum class Enable : std::uint8_t {
    kOff = 0,
    kOn = 1,
  };

  static constexpr Field kEnable{
      "Enable", "", 12, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kSwingDuty{
      "SwingDuty", "", 16, 16, 12000U, 52000U, 65279, 65535, 32000U,
      -32000, 1.0, 20000.0};

  /// The swing spool may open only while it is On.
  Coded<Enable> enable{Enable::kOff, RawState::kValid};
  /// Duty of the swing spool; positive turns to the left, 0 is neutral. [-1000 .. 1000 per mille on
  /// the bus]
  Physical swing_duty_ratio{physical_of(kSwingDuty, 32000U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kEnable, self.enable);
    visitor(kSwingDuty, self.swing_duty_ratio);
  }
  static constexpr SwingCommand decode(const Payload& payload) {
    return decode_message<SwingCommand>(payload);
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

/// How far the task is that runs; sent where the profile has a swing drive.
struct TaskStatus {
  static constexpr const char* kName = "TaskStatus";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FF3882;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  enum class StepKind : std::uint8_t {
    kNone = 0,
    kApproach = 1,
    kDig = 2,
    kLift = 3,
    kSwing = 4,
    kDump = 5,
    kReturnToDig = 6,
    kDone = 7,
    kWait = 8,
  };

  static constexpr Field kTaskNumber{
      "TaskNumber", "", 0, 8, 0U, 250U, 254, 255, 255U,
      0, 1.0, 1.0};
  static constexpr Field kStep{
      "Step", "", 8, 8, 0U, 250U, 254, 255, 0U,
      0, 1.0, 1.0};
  static constexpr Field kStepKind{
      "StepKind", "", 16, 4, 0U, 8U, 14, 15, 0U,
      0, 1.0, 1.0};
  static constexpr Field kProgress{
      "Progress", "", 24, 16, 0U, 50000U, 65279, 65535, 0U,
      0, 1.0, 50000.0};
  static constexpr Field kSwingWantedVelocity{
      "SwingWantedVelocity", "rad/s", 40, 16, 0U, 64000U, 65279, 65535, 32000U,
      -32000, 1.0, 10000.0};
  static constexpr Field kNotArrived{
      "NotArrived", "", 56, 8, 0U, 250U, 254, 255, 255U,
      0, 1.0, 1.0};

  /// Which of the ECU's task files, from 0; not available while none runs. [0 .. 250 on the bus]
  Count task_number{0U, RawState::kNotAvailable};
  /// Step of the task, from 0. [0 .. 250 on the bus]
  Count step{0U, RawState::kValid};
  /// What the step is.
  Coded<StepKind> step_kind{StepKind::kNone, RawState::kValid};
  /// Share of the step that is done. [0 .. 1 on the bus]
  Physical progress{physical_of(kProgress, 0U), RawState::kValid};
  /// Wanted swing rate before it is scaled by Lambda; to the left is positive. [-3200 .. 3200
  /// mrad/s on the bus]
  Physical swing_wanted_velocity_radps{physical_of(kSwingWantedVelocity, 32000U), RawState::kValid};
  /// Steps that went on though the teeth had not come to stand at their end, since the task began.
  /// [0 .. 250 on the bus]
  Count not_arrived{0U, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kTaskNumber, self.task_number);
    visitor(kStep, self.step);
    visitor(kStepKind, self.step_kind);
    visitor(kProgress, self.progress);
    visitor(kSwingWantedVelocity, self.swing_wanted_velocity_radps);
    visitor(kNotArrived, self.not_arrived);
  }
  static constexpr TaskStatus decode(const Payload& payload) {
    return decode_message<TaskStatus>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Where the spools' dead bands end, as learnt while the cylinders move: how far from where the
/// profile says, as a share of the spool's travel. Not available: not learnt yet on that side.
struct EcuLearntValves {
  static constexpr const char* kName = "EcuLearntValves";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FF3982;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 100;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kBoomExtendEdge{
      "BoomExtendEdge", "", 0, 8, 0U, 250U, 254, 255, 255U,
      -125, 1.0, 1000.0};
  static constexpr Field kBoomRetractEdge{
      "BoomRetractEdge", "", 8, 8, 0U, 250U, 254, 255, 255U,
      -125, 1.0, 1000.0};
  static constexpr Field kArmExtendEdge{
      "ArmExtendEdge", "", 16, 8, 0U, 250U, 254, 255, 255U,
      -125, 1.0, 1000.0};
  static constexpr Field kArmRetractEdge{
      "ArmRetractEdge", "", 24, 8, 0U, 250U, 254, 255, 255U,
      -125, 1.0, 1000.0};
  static constexpr Field kBucketExtendEdge{
      "BucketExtendEdge", "", 32, 8, 0U, 250U, 254, 255, 255U,
      -125, 1.0, 1000.0};
  static constexpr Field kBucketRetractEdge{
      "BucketRetractEdge", "", 40, 8, 0U, 250U, 254, 255, 255U,
      -125, 1.0, 1000.0};

  /// Where the boom cylinder extends: positive opens later than the profile says. [-12.5 .. 12.5 %
  /// on the bus]
  Physical boom_extend_edge_ratio{0.0, RawState::kNotAvailable};
  /// Where the boom cylinder retracts: positive opens later than the profile says. [-12.5 .. 12.5 %
  /// on the bus]
  Physical boom_retract_edge_ratio{0.0, RawState::kNotAvailable};
  /// Where the arm cylinder extends: positive opens later than the profile says. [-12.5 .. 12.5 %
  /// on the bus]
  Physical arm_extend_edge_ratio{0.0, RawState::kNotAvailable};
  /// Where the arm cylinder retracts: positive opens later than the profile says. [-12.5 .. 12.5 %
  /// on the bus]
  Physical arm_retract_edge_ratio{0.0, RawState::kNotAvailable};
  /// Where the bucket cylinder extends: positive opens later than the profile says. [-12.5 .. 12.5
  /// % on the bus]
  Physical bucket_extend_edge_ratio{0.0, RawState::kNotAvailable};
  /// Where the bucket cylinder retracts: positive opens later than the profile says. [-12.5 .. 12.5
  /// % on the bus]
  Physical bucket_retract_edge_ratio{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBoomExtendEdge, self.boom_extend_edge_ratio);
    visitor(kBoomRetractEdge, self.boom_retract_edge_ratio);
    visitor(kArmExtendEdge, self.arm_extend_edge_ratio);
    visitor(kArmRetractEdge, self.arm_retract_edge_ratio);
    visitor(kBucketExtendEdge, self.bucket_extend_edge_ratio);
    visitor(kBucketRetractEdge, self.bucket_retract_edge_ratio);
  }
  static constexpr EcuLearntValves decode(const Payload& payload) {
    return decode_message<EcuLearntValves>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// What the ground does to the bucket's teeth and what the bucket carries, by the pressures of the
/// cylinders, pose and motion. Not available: pressures, pose or the links' masses are not known;
/// of the payload also while the bucket may touch the ground, fills or pours, or has not been
/// lifted long enough.
struct EcuTipLoad {
  static constexpr const char* kName = "EcuTipLoad";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FF3A82;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 100;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kTipForceOutwards{
      "TipForceOutwards", "N", 0, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 10.0, 1.0};
  static constexpr Field kTipForceUp{
      "TipForceUp", "N", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 10.0, 1.0};
  static constexpr Field kPayloadMass{
      "PayloadMass", "kg", 32, 16, 0U, 64000U, 65279, 65535, 65535U,
      -4000, 1.0, 4.0};
  static constexpr Field kTipForceDeviation{
      "TipForceDeviation", "N", 48, 8, 0U, 250U, 254, 255, 255U,
      0, 250.0, 1.0};
  static constexpr Field kPayloadDeviation{
      "PayloadDeviation", "kg", 56, 8, 0U, 250U, 254, 255, 255U,
      0, 1.0, 1.0};

  /// Of the ground on the teeth, in the plane of the links, level, away from the machine; of the
  /// fill's weight it has none. [-320 .. 320 kN on the bus]
  Physical tip_force_outwards_n{0.0, RawState::kNotAvailable};
  /// Of the ground on the teeth, in the plane of the links, upwards; of the fill's weight it has
  /// none. [-320 .. 320 kN on the bus]
  Physical tip_force_up_n{0.0, RawState::kNotAvailable};
  /// Of what the bucket carries; it may be below 0 by what it is off. [-1000 .. 15000 kg on the
  /// bus]
  Physical payload_mass_kg{0.0, RawState::kNotAvailable};
  /// Standard deviation of each component of the force; the largest value stands for more too. [0
  /// .. 62.5 kN on the bus]
  Physical tip_force_deviation_n{0.0, RawState::kNotAvailable};
  /// Standard deviation of the payload; the largest value stands for more too. [0 .. 250 kg on the
  /// bus]
  Physical payload_deviation_kg{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kTipForceOutwards, self.tip_force_outwards_n);
    visitor(kTipForceUp, self.tip_force_up_n);
    visitor(kPayloadMass, self.payload_mass_kg);
    visitor(kTipForceDeviation, self.tip_force_deviation_n);
    visitor(kPayloadDeviation, self.payload_deviation_kg);
  }
  static constexpr EcuTipLoad decode(const Payload& payload) {
    return decode_message<EcuTipLoad>(payload);
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
                SwingState,
                ValveState,
                SwingValveState,
                OperatorAxes,
                CommissionDuty,
                CommissionWindow,
                SpoolCommand,
                PumpCommand,
                SwingCommand,
                EcuMotion,
                EcuHydraulics,
                TaskStatus,
                EcuLearntValves,
                EcuTipLoad,
                EEC1,
                OperatorCommand,
                MachineIdentity,
                EcuStatus,
                EcuIdentity,
                EcuHealth,
                DM1>;

inline constexpr std::array<MessageInfo, 28> kMessages{{
    message_info<BoomStroke>(),
    message_info<ArmStroke>(),
    message_info<BucketStroke>(),
    message_info<BoomPressure>(),
    message_info<ArmPressure>(),
    message_info<BucketPressure>(),
    message_info<PumpState>(),
    message_info<SwingState>(),
    message_info<ValveState>(),
    message_info<SwingValveState>(),
    message_info<OperatorAxes>(),
    message_info<CommissionDuty>(),
    message_info<CommissionWindow>(),
    message_info<SpoolCommand>(),
    message_info<PumpCommand>(),
    message_info<SwingCommand>(),
    message_info<EcuMotion>(),
    message_info<EcuHydraulics>(),
    message_info<TaskStatus>(),
    message_info<EcuLearntValves>(),
    message_info<EcuTipLoad>(),
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
  using BoomStroke = excavator::BoomStroke;
  using ArmStroke = excavator::ArmStroke;
  using BucketStroke = excavator::BucketStroke;
  using BoomPressure = excavator::BoomPressure;
  using ArmPressure = excavator::ArmPressure;
  using BucketPressure = excavator::BucketPressure;
  using PumpState = excavator::PumpState;
  using SwingState = excavator::SwingState;
  using ValveState = excavator::ValveState;
  using SwingValveState = excavator::SwingValveState;
  using OperatorAxes = excavator::OperatorAxes;
  using CommissionDuty = excavator::CommissionDuty;
  using CommissionWindow = excavator::CommissionWindow;
  using SpoolCommand = excavator::SpoolCommand;
  using PumpCommand = excavator::PumpCommand;
  using SwingCommand = excavator::SwingCommand;
  using EcuMotion = excavator::EcuMotion;
  using EcuHydraulics = excavator::EcuHydraulics;
  using TaskStatus = excavator::TaskStatus;
  using EcuLearntValves = excavator::EcuLearntValves;
  using EcuTipLoad = excavator::EcuTipLoad;
  using EEC1 = excavator::EEC1;
  using OperatorCommand = excavator::OperatorCommand;
  using MachineIdentity = excavator::MachineIdentity;
  using EcuStatus = excavator::EcuStatus;
  using EcuIdentity = excavator::EcuIdentity;
  using EcuHealth = excavator::EcuHealth;
  using DM1 = excavator::DM1;
  using AllMessages = excavator::AllMessages;
  static constexpr const auto& kMessages = excavator::kMessages;
  static constexpr std::uint8_t kDbcVersion = excavator::kDbcVersion;
};

}  // namespace graben::dbc::excavator
