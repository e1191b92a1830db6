// SPDX-License-Identifier: Apache-2.0
// Generated from dozer.dbc.in by can_dbc/generate.py; change the DBC and generate again.
// clang-format off
#pragma once
/// J1939-addressed frames of a dozer and its controller. World: x along the grade, z up. Extension
/// is positive for stroke, velocity and duty of the blade, and lowers it; forward is positive for
/// transmission and tracks. Messages that excavator.dbc has too keep their ids, protection and
/// layout. Intel byte order, unused bits 1. A protected message has its CRC in byte 0 and its
/// counter in the low nibble of byte 1.
/// Values are in the SI unit that their name ends with. A message that nobody has filled in carries
/// the start values. encode() rounds to the nearest raw value and saturates into [min|max]; NaN and
/// infinities become the signal's error value, or its start value where it has none; bits of no
/// signal are 1. CRC and counter are left to the end-to-end protection.

#include <array>
#include <cstdint>

#include "can_dbc/codec.hpp"
#include "can_dbc/generated/common_dbc.hpp"

namespace graben::dbc::dozer {

inline constexpr std::uint8_t kDbcVersion = 7;

using common::EEC1;
using common::OperatorCommand;
using common::MachineIdentity;
using common::EcuStatus;
using common::EcuIdentity;
using common::EcuHealth;
using common::DM1;

/// Measured stroke of the blade cylinders.
struct BladeStroke {
  static constexpr const char* kName = "BladeStroke";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF5080;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF50;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kBladeStroke{
      "BladeStroke", "m", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1.0, 100000.0};

  /// Stroke of the blade cylinders; counts from the raised blade, extension is positive and lowers
  /// it. [0 .. 640 mm on the bus]
  Physical blade_stroke_m{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBladeStroke, self.blade_stroke_m);
  }
  static constexpr BladeStroke decode(const Payload& payload) {
    return decode_message<BladeStroke>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Where the body is: the origin of its frame, at the tracks' ground line below the mass centre.
struct BodyPosition {
  static constexpr const char* kName = "BodyPosition";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF5180;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF51;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kPosition{
      "Position", "m", 16, 32, 0U, 2000000000U, 4278190079, 4294967295, 4294967295U,
      -1000000000, 1.0, 10000.0};
  static constexpr Field kHeight{
      "Height", "m", 48, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 2000.0};

  /// Position along the grade, x of the world. [-100000000 .. 100000000 mm on the bus]
  Physical position_m{0.0, RawState::kNotAvailable};
  /// Height, z of the world. [-16000 .. 16000 mm on the bus]
  Physical height_m{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kPosition, self.position_m);
    visitor(kHeight, self.height_m);
  }
  static constexpr BodyPosition decode(const Payload& payload) {
    return decode_message<BodyPosition>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// How the body is inclined.
struct BodyPitch {
  static constexpr const char* kName = "BodyPitch";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF5280;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF52;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kPitch{
      "Pitch", "rad", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};
  static constexpr Field kPitchRate{
      "PitchRate", "rad/s", 32, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 10000.0};

  /// Pitch of the body; nose up is positive. [-1600 .. 1600 mrad on the bus]
  Physical pitch_rad{0.0, RawState::kNotAvailable};
  /// Rate of the pitch; nose up is positive. [-3200 .. 3200 mrad/s on the bus]
  Physical pitch_rate_radps{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kPitch, self.pitch_rad);
    visitor(kPitchRate, self.pitch_rate_radps);
  }
  static constexpr BodyPitch decode(const Payload& payload) {
    return decode_message<BodyPitch>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// How the origin of the body's frame moves in the world.
struct BodyVelocity {
  static constexpr const char* kName = "BodyVelocity";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF5380;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF53;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kForward{
      "Forward", "m/s", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 10000.0};
  static constexpr Field kClimb{
      "Climb", "m/s", 32, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 10000.0};

  /// Velocity along the grade, x of the world. [-3200 .. 3200 mm/s on the bus]
  Physical forward_mps{0.0, RawState::kNotAvailable};
  /// Velocity upwards, z of the world. [-3200 .. 3200 mm/s on the bus]
  Physical climb_mps{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kForward, self.forward_mps);
    visitor(kClimb, self.climb_mps);
  }
  static constexpr BodyVelocity decode(const Payload& payload) {
    return decode_message<BodyVelocity>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Measured state of the left path of the transmission.
struct LeftTransmission {
  static constexpr const char* kName = "LeftTransmission";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF5480;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF54;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kPump{
      "Pump", "", 16, 16, 12000U, 52000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};
  static constexpr Field kMotor{
      "Motor", "", 32, 16, 0U, 50000U, 65279, 65535, 65535U,
      0, 1.0, 50000.0};
  static constexpr Field kLinePressure{
      "LinePressure", "Pa", 48, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1000.0, 1.0};

  /// Measured displacement of the left pump over its largest; forward is positive. [-1000 .. 1000
  /// per mille on the bus]
  Physical pump_ratio{0.0, RawState::kNotAvailable};
  /// Measured displacement of the left motor over its largest. [0 .. 100 % on the bus]
  Physical motor_ratio{0.0, RawState::kNotAvailable};
  /// Higher pressure of the left path's two lines, above ambient; for diagnosis only. [0 .. 64 MPa
  /// on the bus]
  Physical line_pressure_pa{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kPump, self.pump_ratio);
    visitor(kMotor, self.motor_ratio);
    visitor(kLinePressure, self.line_pressure_pa);
  }
  static constexpr LeftTransmission decode(const Payload& payload) {
    return decode_message<LeftTransmission>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Measured state of the right path of the transmission.
struct RightTransmission {
  static constexpr const char* kName = "RightTransmission";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF5580;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF55;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kPump{
      "Pump", "", 16, 16, 12000U, 52000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};
  static constexpr Field kMotor{
      "Motor", "", 32, 16, 0U, 50000U, 65279, 65535, 65535U,
      0, 1.0, 50000.0};
  static constexpr Field kLinePressure{
      "LinePressure", "Pa", 48, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1000.0, 1.0};

  /// Measured displacement of the right pump over its largest; forward is positive. [-1000 .. 1000
  /// per mille on the bus]
  Physical pump_ratio{0.0, RawState::kNotAvailable};
  /// Measured displacement of the right motor over its largest. [0 .. 100 % on the bus]
  Physical motor_ratio{0.0, RawState::kNotAvailable};
  /// Higher pressure of the right path's two lines, above ambient; for diagnosis only. [0 .. 64 MPa
  /// on the bus]
  Physical line_pressure_pa{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kPump, self.pump_ratio);
    visitor(kMotor, self.motor_ratio);
    visitor(kLinePressure, self.line_pressure_pa);
  }
  static constexpr RightTransmission decode(const Payload& payload) {
    return decode_message<RightTransmission>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Measured speeds of the tracks: the sprocket's speed times its radius.
struct TrackSpeed {
  static constexpr const char* kName = "TrackSpeed";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF5680;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF56;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kLeftTrack{
      "LeftTrack", "m/s", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 10000.0};
  static constexpr Field kRightTrack{
      "RightTrack", "m/s", 32, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 10000.0};

  /// Speed of the left track; forward is positive. [-3200 .. 3200 mm/s on the bus]
  Physical left_track_mps{0.0, RawState::kNotAvailable};
  /// Speed of the right track; forward is positive. [-3200 .. 3200 mm/s on the bus]
  Physical right_track_mps{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kLeftTrack, self.left_track_mps);
    visitor(kRightTrack, self.right_track_mps);
  }
  static constexpr TrackSpeed decode(const Payload& payload) {
    return decode_message<TrackSpeed>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Tilt of the blade and roll of the body. Only a machine whose blade tilts sends it.
struct TiltState {
  static constexpr const char* kName = "TiltState";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF5C80;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF5C;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kTiltStroke{
      "TiltStroke", "m", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      0, 1.0, 100000.0};
  static constexpr Field kRoll{
      "Roll", "rad", 32, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};
  static constexpr Field kRollRate{
      "RollRate", "rad/s", 48, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 10000.0};

  /// Stroke of the tilt cylinder; counts from the end of its range where it is shortest. [0 .. 640
  /// mm on the bus]
  Physical tilt_stroke_m{0.0, RawState::kNotAvailable};
  /// Roll of the body about its own longitudinal axis; left side up is positive. [-1600 .. 1600
  /// mrad on the bus]
  Physical roll_rad{0.0, RawState::kNotAvailable};
  /// Rate of the roll; left side up is positive. [-3200 .. 3200 mrad/s on the bus]
  Physical roll_rate_radps{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kTiltStroke, self.tilt_stroke_m);
    visitor(kRoll, self.roll_rad);
    visitor(kRollRate, self.roll_rate_radps);
  }
  static constexpr TiltState decode(const Payload& payload) {
    return decode_message<TiltState>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Where the body is in plan beside a design's track. Only sent where that curves: Position is then
/// the station along it.
struct BodyCourse {
  static constexpr const char* kName = "BodyCourse";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x0CFF5D80;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF5D;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kOffset{
      "Offset", "m", 16, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 10000.0};
  static constexpr Field kHeading{
      "Heading", "rad", 32, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};
  static constexpr Field kYawRate{
      "YawRate", "rad/s", 48, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 10000.0};

  /// Of the origin from the track; left is positive. [-3200 .. 3200 mm on the bus]
  Physical offset_m{0.0, RawState::kNotAvailable};
  /// Of the body against the track's direction beside it; to the left is positive. [-1600 .. 1600
  /// mrad on the bus]
  Physical heading_rad{0.0, RawState::kNotAvailable};
  /// Rate of the body's turn about the vertical; to the left is positive. [-3200 .. 3200 mrad/s on
  /// the bus]
  Physical yaw_rate_radps{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kOffset, self.offset_m);
    visitor(kHeading, self.heading_rad);
    visitor(kYawRate, self.yaw_rate_radps);
  }
  static constexpr BodyCourse decode(const Payload& payload) {
    return decode_message<BodyCourse>(payload);
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
  static constexpr Field kBladeSpool{
      "BladeSpool", "", 16, 16, 12000U, 52000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};
  static constexpr Field kTiltSpool{
      "TiltSpool", "", 32, 16, 12000U, 52000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};

  /// Echo: the enable that the valve side acts on; the spool is held closed while it is Off.
  Coded<Enabled> enabled{{}, RawState::kNotAvailable};
  /// Measured position of the blade spool over its full travel, deadband included; positive extends
  /// the cylinders. [-1000 .. 1000 per mille on the bus]
  Physical blade_spool_ratio{0.0, RawState::kNotAvailable};
  /// The same of the tilt spool, where there is one. [-1000 .. 1000 per mille on the bus]
  Physical tilt_spool_ratio{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kEnabled, self.enabled);
    visitor(kBladeSpool, self.blade_spool_ratio);
    visitor(kTiltSpool, self.tilt_spool_ratio);
  }
  static constexpr ValveState decode(const Payload& payload) {
    return decode_message<ValveState>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Commands to the pilot valve. The valve side closes the spool without it.
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
  static constexpr Field kBladeDuty{
      "BladeDuty", "", 16, 16, 12000U, 52000U, 65279, 65535, 32000U,
      -32000, 1.0, 20000.0};
  static constexpr Field kTiltDuty{
      "TiltDuty", "", 32, 16, 12000U, 52000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};

  /// The spool may open only while it is On.
  Coded<Enable> enable{Enable::kOff, RawState::kValid};
  /// On asks for the pilot pressure to be cut: the spool centres by its springs, whatever holds it.
  Coded<PilotCut> pilot_cut{PilotCut::kOff, RawState::kValid};
  /// Duty of the blade spool; positive extends the cylinders and lowers the blade, 0 is neutral.
  /// [-1000 .. 1000 per mille on the bus]
  Physical blade_duty_ratio{physical_of(kBladeDuty, 32000U), RawState::kValid};
  /// Duty of the tilt spool; positive extends the cylinder, 0 is neutral. Not available without a
  /// tilt. [-1000 .. 1000 per mille on the bus]
  Physical tilt_duty_ratio{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kEnable, self.enable);
    visitor(kPilotCut, self.pilot_cut);
    visitor(kBladeDuty, self.blade_duty_ratio);
    visitor(kTiltDuty, self.tilt_duty_ratio);
  }
  static constexpr SpoolCommand decode(const Payload& payload) {
    return decode_message<SpoolCommand>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Commands to the pumps of the transmission. Without it both pumps go to 0 and the parking brake
/// closes.
struct PumpDisplacementCommand {
  static constexpr const char* kName = "PumpDisplacementCommand";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x0CFF5882;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF58;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  enum class Brake : std::uint8_t {
    kOff = 0,
    kOn = 1,
  };

  static constexpr Field kBrake{
      "Brake", "", 12, 2, 0U, 1U, 2, 3, 1U,
      0, 1.0, 1.0};
  static constexpr Field kLeftPump{
      "LeftPump", "", 16, 16, 12000U, 52000U, 65279, 65535, 32000U,
      -32000, 1.0, 20000.0};
  static constexpr Field kRightPump{
      "RightPump", "", 32, 16, 12000U, 52000U, 65279, 65535, 32000U,
      -32000, 1.0, 20000.0};

  /// On asks for the parking brake.
  Coded<Brake> brake{Brake::kOn, RawState::kValid};
  /// Wanted displacement of the left pump over its largest; forward is positive, 0 stands still.
  /// [-1000 .. 1000 per mille on the bus]
  Physical left_pump_ratio{physical_of(kLeftPump, 32000U), RawState::kValid};
  /// Wanted displacement of the right pump over its largest; forward is positive, 0 stands still.
  /// [-1000 .. 1000 per mille on the bus]
  Physical right_pump_ratio{physical_of(kRightPump, 32000U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBrake, self.brake);
    visitor(kLeftPump, self.left_pump_ratio);
    visitor(kRightPump, self.right_pump_ratio);
  }
  static constexpr PumpDisplacementCommand decode(const Payload& payload) {
    return decode_message<PumpDisplacementCommand>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Commands to the motors of the transmission. Without it both motors go to full displacement.
struct MotorDisplacementCommand {
  static constexpr const char* kName = "MotorDisplacementCommand";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x0CFF5982;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = true;
  static constexpr std::uint16_t kDataId = 0xFF59;
  static constexpr std::uint8_t kMaxDeltaCounter = 3;

  static constexpr Field kLeftMotor{
      "LeftMotor", "", 16, 16, 0U, 50000U, 65279, 65535, 50000U,
      0, 1.0, 50000.0};
  static constexpr Field kRightMotor{
      "RightMotor", "", 32, 16, 0U, 50000U, 65279, 65535, 50000U,
      0, 1.0, 50000.0};

  /// Wanted displacement of the left motor over its largest. [0 .. 100 % on the bus]
  Physical left_motor_ratio{physical_of(kLeftMotor, 50000U), RawState::kValid};
  /// Wanted displacement of the right motor over its largest. [0 .. 100 % on the bus]
  Physical right_motor_ratio{physical_of(kRightMotor, 50000U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kLeftMotor, self.left_motor_ratio);
    visitor(kRightMotor, self.right_motor_ratio);
  }
  static constexpr MotorDisplacementCommand decode(const Payload& payload) {
    return decode_message<MotorDisplacementCommand>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// What speeds the controller wants.
struct EcuMotion {
  static constexpr const char* kName = "EcuMotion";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FF5A82;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kWantedSpeed{
      "WantedSpeed", "m/s", 0, 16, 0U, 64000U, 65279, 65535, 32000U,
      -32000, 1.0, 10000.0};
  static constexpr Field kSpeedLimit{
      "SpeedLimit", "m/s", 16, 16, 0U, 64000U, 65279, 65535, 0U,
      0, 1.0, 10000.0};
  static constexpr Field kWantedBladeVelocity{
      "WantedBladeVelocity", "m/s", 32, 16, 0U, 64000U, 65279, 65535, 32000U,
      -32000, 1.0, 10000.0};
  static constexpr Field kWantedTiltVelocity{
      "WantedTiltVelocity", "m/s", 48, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 10000.0};

  /// Wanted travel speed, after the acceleration limit; forward is positive. [-3200 .. 3200 mm/s on
  /// the bus]
  Physical wanted_speed_mps{physical_of(kWantedSpeed, 32000U), RawState::kValid};
  /// Travel speed that flow and transmission allow. [0 .. 6400 mm/s on the bus]
  Physical speed_limit_mps{physical_of(kSpeedLimit, 0U), RawState::kValid};
  /// Wanted velocity of the blade cylinders; extension is positive and lowers the blade. [-3200 ..
  /// 3200 mm/s on the bus]
  Physical wanted_blade_velocity_mps{physical_of(kWantedBladeVelocity, 32000U), RawState::kValid};
  /// Wanted velocity of the tilt cylinder; extension is positive. Not available without a tilt.
  /// [-3200 .. 3200 mm/s on the bus]
  Physical wanted_tilt_velocity_mps{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kWantedSpeed, self.wanted_speed_mps);
    visitor(kSpeedLimit, self.speed_limit_mps);
    visitor(kWantedBladeVelocity, self.wanted_blade_velocity_mps);
    visitor(kWantedTiltVelocity, self.wanted_tilt_velocity_mps);
  }
  static constexpr EcuMotion decode(const Payload& payload) {
    return decode_message<EcuMotion>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// How much of the implement's flow the grade takes, and how well it is kept.
struct EcuGrade {
  static constexpr const char* kName = "EcuGrade";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FF5B82;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kRequiredFlow{
      "RequiredFlow", "m^3/s", 0, 16, 0U, 64000U, 65279, 65535, 0U,
      0, 1.0, 6000000.0};
  static constexpr Field kAvailableFlow{
      "AvailableFlow", "m^3/s", 16, 16, 0U, 64000U, 65279, 65535, 0U,
      0, 1.0, 6000000.0};
  static constexpr Field kGradeError{
      "GradeError", "m", 32, 16, 0U, 64000U, 65279, 65535, 32000U,
      -32000, 1.0, 20000.0};
  static constexpr Field kCrossError{
      "CrossError", "", 48, 16, 0U, 64000U, 65279, 65535, 65535U,
      -32000, 1.0, 20000.0};

  /// Flow into the blade cylinders that the measured motion requires. [0 .. 640 L/min on the bus]
  Physical required_flow_m3ps{physical_of(kRequiredFlow, 0U), RawState::kValid};
  /// Flow that pump and valve can give to the blade cylinders. [0 .. 640 L/min on the bus]
  Physical available_flow_m3ps{physical_of(kAvailableFlow, 0U), RawState::kValid};
  /// Measured cutting edge against the grade; above is positive. [-1600 .. 1600 mm on the bus]
  Physical grade_error_m{physical_of(kGradeError, 32000U), RawState::kValid};
  /// Measured slope of the edge across the track over the grade's; left end up is positive. [-1600
  /// .. 1600 per mille on the bus]
  Physical cross_error_ratio{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kRequiredFlow, self.required_flow_m3ps);
    visitor(kAvailableFlow, self.available_flow_m3ps);
    visitor(kGradeError, self.grade_error_m);
    visitor(kCrossError, self.cross_error_ratio);
  }
  static constexpr EcuGrade decode(const Payload& payload) {
    return decode_message<EcuGrade>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

using AllMessages =
    MessageList<BladeStroke,
                BodyPosition,
                BodyPitch,
                BodyVelocity,
                LeftTransmission,
                RightTransmission,
                TrackSpeed,
                TiltState,
                BodyCourse,
                ValveState,
                SpoolCommand,
                PumpDisplacementCommand,
                MotorDisplacementCommand,
                EcuMotion,
                EcuGrade,
                EEC1,
                OperatorCommand,
                MachineIdentity,
                EcuStatus,
                EcuIdentity,
                EcuHealth,
                DM1>;

inline constexpr std::array<MessageInfo, 22> kMessages{{
    message_info<BladeStroke>(),
    message_info<BodyPosition>(),
    message_info<BodyPitch>(),
    message_info<BodyVelocity>(),
    message_info<LeftTransmission>(),
    message_info<RightTransmission>(),
    message_info<TrackSpeed>(),
    message_info<TiltState>(),
    message_info<BodyCourse>(),
    message_info<ValveState>(),
    message_info<SpoolCommand>(),
    message_info<PumpDisplacementCommand>(),
    message_info<MotorDisplacementCommand>(),
    message_info<EcuMotion>(),
    message_info<EcuGrade>(),
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
  using BladeStroke = dozer::BladeStroke;
  using BodyPosition = dozer::BodyPosition;
  using BodyPitch = dozer::BodyPitch;
  using BodyVelocity = dozer::BodyVelocity;
  using LeftTransmission = dozer::LeftTransmission;
  using RightTransmission = dozer::RightTransmission;
  using TrackSpeed = dozer::TrackSpeed;
  using TiltState = dozer::TiltState;
  using BodyCourse = dozer::BodyCourse;
  using ValveState = dozer::ValveState;
  using SpoolCommand = dozer::SpoolCommand;
  using PumpDisplacementCommand = dozer::PumpDisplacementCommand;
  using MotorDisplacementCommand = dozer::MotorDisplacementCommand;
  using EcuMotion = dozer::EcuMotion;
  using EcuGrade = dozer::EcuGrade;
  using EEC1 = dozer::EEC1;
  using OperatorCommand = dozer::OperatorCommand;
  using MachineIdentity = dozer::MachineIdentity;
  using EcuStatus = dozer::EcuStatus;
  using EcuIdentity = dozer::EcuIdentity;
  using EcuHealth = dozer::EcuHealth;
  using DM1 = dozer::DM1;
  using AllMessages = dozer::AllMessages;
  static constexpr const auto& kMessages = dozer::kMessages;
  static constexpr std::uint8_t kDbcVersion = dozer::kDbcVersion;
};

}  // namespace graben::dbc::dozer
