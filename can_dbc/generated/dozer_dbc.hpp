// Generated from dozer.dbc by can_dbc/generate.py; change the DBC and generate again.
// clang-format off
#pragma once
/// J1939-addressed frames of a dozer and its controller. Intel byte order, unused bits 1. A
/// protected message has its CRC in byte 0 and its counter in the low nibble of byte 1. World: x
/// along the grade, z up. Extension is positive for stroke, velocity and duty of the blade, and
/// lowers it; forward is positive for transmission and tracks. Messages that excavator.dbc has too
/// keep their ids, protection and layout.
/// Values are in the SI unit that their name ends with. A message that nobody has filled in carries
/// the start values. encode() rounds to the nearest raw value and saturates into [min|max]; NaN and
/// infinities become the signal's error value, or its start value where it has none; bits of no
/// signal are 1. CRC and counter are left to the end-to-end protection.

#include <array>
#include <cstdint>

#include "can_dbc/codec.hpp"

namespace graben::dbc::dozer {

inline constexpr std::uint8_t kDbcVersion = 3;

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
  };

  static constexpr Field kEnable{
      "Enable", "", 12, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kOperatorMode{
      "OperatorMode", "", 16, 4, 0U, 1U, 14, 15, 0U,
      0, 1.0, 1.0};
  static constexpr Field kTask{
      "Task", "", 24, 8, 0U, 2U, 254, 255, 0U,
      0, 1.0, 1.0};
  static constexpr Field kSpeedOverride{
      "SpeedOverride", "", 32, 8, 0U, 200U, 254, 255, 0U,
      0, 1.0, 200.0};

  /// Deadman: motion only while it is On.
  Coded<Enable> enable{Enable::kOff, RawState::kValid};
  /// What the operator lets the controller do.
  Coded<OperatorMode> operator_mode{OperatorMode::kManual, RawState::kValid};
  /// What the controller is to do. Dig is an excavator's; a dozer refuses the frame.
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

  /// Echo: the enable that the valve side acts on; the spool is held closed while it is Off.
  Coded<Enabled> enabled{{}, RawState::kNotAvailable};
  /// Measured position of the blade spool over its full travel, deadband included; positive extends
  /// the cylinders. [-1000 .. 1000 per mille on the bus]
  Physical blade_spool_ratio{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kEnabled, self.enabled);
    visitor(kBladeSpool, self.blade_spool_ratio);
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

  /// The spool may open only while it is On.
  Coded<Enable> enable{Enable::kOff, RawState::kValid};
  /// On asks for the pilot pressure to be cut: the spool centres by its springs, whatever holds it.
  Coded<PilotCut> pilot_cut{PilotCut::kOff, RawState::kValid};
  /// Duty of the blade spool; positive extends the cylinders and lowers the blade, 0 is neutral.
  /// [-1000 .. 1000 per mille on the bus]
  Physical blade_duty_ratio{physical_of(kBladeDuty, 32000U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kEnable, self.enable);
    visitor(kPilotCut, self.pilot_cut);
    visitor(kBladeDuty, self.blade_duty_ratio);
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
  };

  static constexpr Field kMode{
      "Mode", "", 0, 4, 0U, 5U, 14, 15, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLimitKind{
      "LimitKind", "", 4, 4, 0U, 10U, 14, 15, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLimitIndex{
      "LimitIndex", "", 8, 8, 0U, 250U, 254, 255, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLambda{
      "Lambda", "", 16, 16, 0U, 50000U, 65279, 65535, 0U,
      0, 1.0, 50000.0};
  static constexpr Field kFault{
      "Fault", "", 32, 8, 0U, 37U, 254, 255, 0U,
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
  /// Whose limit it is: the index of the track for TransmissionFlow (left 0, right 1), the number
  /// of the Fault for Degraded, else 0. [0 .. 250 on the bus]
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

  /// Wanted travel speed, after the acceleration limit; forward is positive. [-3200 .. 3200 mm/s on
  /// the bus]
  Physical wanted_speed_mps{physical_of(kWantedSpeed, 32000U), RawState::kValid};
  /// Travel speed that flow and transmission allow. [0 .. 6400 mm/s on the bus]
  Physical speed_limit_mps{physical_of(kSpeedLimit, 0U), RawState::kValid};
  /// Wanted velocity of the blade cylinders; extension is positive and lowers the blade. [-3200 ..
  /// 3200 mm/s on the bus]
  Physical wanted_blade_velocity_mps{physical_of(kWantedBladeVelocity, 32000U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kWantedSpeed, self.wanted_speed_mps);
    visitor(kSpeedLimit, self.speed_limit_mps);
    visitor(kWantedBladeVelocity, self.wanted_blade_velocity_mps);
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

  /// Flow into the blade cylinders that the measured motion requires. [0 .. 640 L/min on the bus]
  Physical required_flow_m3ps{physical_of(kRequiredFlow, 0U), RawState::kValid};
  /// Flow that pump and valve can give to the blade cylinders. [0 .. 640 L/min on the bus]
  Physical available_flow_m3ps{physical_of(kAvailableFlow, 0U), RawState::kValid};
  /// Measured cutting edge against the grade; above is positive. [-1600 .. 1600 mm on the bus]
  Physical grade_error_m{physical_of(kGradeError, 32000U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kRequiredFlow, self.required_flow_m3ps);
    visitor(kAvailableFlow, self.available_flow_m3ps);
    visitor(kGradeError, self.grade_error_m);
  }
  static constexpr EcuGrade decode(const Payload& payload) {
    return decode_message<EcuGrade>(payload);
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

  /// A bit for each reason, from bit 0: stroke, pressure, swash, engine speed, operator, spool
  /// feedback, identity, bus, messages, unreachable pose, cycle, manual, task not at rest, enable
  /// not fresh, fault latched, stopping, body pose, transmission, spools not centred, valve not
  /// obeying, controller's own check, sensor error, unknown task. 0 when armed. [0 .. 4294967295 on
  /// the bus]
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
  /// Failure mode identifier: 2 erratic, 9 abnormal update rate, 12 bad device, 19 received network
  /// data in error, 31 condition exists. [0 .. 31 on the bus]
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
    MessageList<BladeStroke,
                BodyPosition,
                BodyPitch,
                BodyVelocity,
                LeftTransmission,
                RightTransmission,
                TrackSpeed,
                EEC1,
                OperatorCommand,
                MachineIdentity,
                ValveState,
                SpoolCommand,
                PumpDisplacementCommand,
                MotorDisplacementCommand,
                EcuStatus,
                EcuMotion,
                EcuGrade,
                EcuIdentity,
                EcuHealth,
                DM1>;

inline constexpr std::array<MessageInfo, 20> kMessages{{
    message_info<BladeStroke>(),
    message_info<BodyPosition>(),
    message_info<BodyPitch>(),
    message_info<BodyVelocity>(),
    message_info<LeftTransmission>(),
    message_info<RightTransmission>(),
    message_info<TrackSpeed>(),
    message_info<EEC1>(),
    message_info<OperatorCommand>(),
    message_info<MachineIdentity>(),
    message_info<ValveState>(),
    message_info<SpoolCommand>(),
    message_info<PumpDisplacementCommand>(),
    message_info<MotorDisplacementCommand>(),
    message_info<EcuStatus>(),
    message_info<EcuMotion>(),
    message_info<EcuGrade>(),
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
  using EEC1 = dozer::EEC1;
  using OperatorCommand = dozer::OperatorCommand;
  using MachineIdentity = dozer::MachineIdentity;
  using ValveState = dozer::ValveState;
  using SpoolCommand = dozer::SpoolCommand;
  using PumpDisplacementCommand = dozer::PumpDisplacementCommand;
  using MotorDisplacementCommand = dozer::MotorDisplacementCommand;
  using EcuStatus = dozer::EcuStatus;
  using EcuMotion = dozer::EcuMotion;
  using EcuGrade = dozer::EcuGrade;
  using EcuIdentity = dozer::EcuIdentity;
  using EcuHealth = dozer::EcuHealth;
  using DM1 = dozer::DM1;
  using AllMessages = dozer::AllMessages;
  static constexpr const auto& kMessages = dozer::kMessages;
  static constexpr std::uint8_t kDbcVersion = dozer::kDbcVersion;
};

}  // namespace graben::dbc::dozer
