// SPDX-License-Identifier: Apache-2.0
// Generated from j1939.dbc.in by can_dbc/generate.py; change the DBC and generate again.
// clang-format off
#pragma once
/// Messages of SAE J1939-71 that sensors on a machine's links send. Their layout and scale are the
/// standard's, as Honeywell (TARS-LCASS user manual 32332897 B, 7.1 to 7.5), LORD (MV5-AR user
/// manual, 4.2) and ifm (JD device manual, 8.3) print them. Nothing protects them but range, rate,
/// age and plausibility.
/// Values are in the SI unit that their name ends with. A message that nobody has filled in carries
/// the start values. encode() rounds to the nearest raw value and saturates into [min|max]; NaN and
/// infinities become the signal's error value, or its start value where it has none; bits of no
/// signal are 1. CRC and counter are left to the end-to-end protection.

#include <array>
#include <cstdint>

#include "can_dbc/codec.hpp"

namespace graben::dbc::j1939 {

inline constexpr std::uint8_t kDbcVersion = 1;

/// Slope sensor information 2 (PGN 61481).
struct SSI2 {
  static constexpr const char* kName = "SSI2";
  static constexpr const char* kSender = "LinkImu";
  static constexpr std::uint32_t kId = 0x0CF029E2;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  enum class PitchCompensation : std::uint8_t {
    kOn = 0,
    kOff = 1,
  };

  enum class PitchMerit : std::uint8_t {
    kFunctional = 0,
    kDegraded = 1,
  };

  enum class RollCompensation : std::uint8_t {
    kOn = 0,
    kOff = 1,
  };

  enum class RollMerit : std::uint8_t {
    kFunctional = 0,
    kDegraded = 1,
  };

  static constexpr Field kPitch{
      "Pitch", "rad", 0, 24, 0U, 16384000U, 16711679, 16777215, 16777215U,
      -8192000, 3.141592653589793, 5898240.0};
  static constexpr Field kRoll{
      "Roll", "rad", 24, 24, 0U, 16384000U, 16711679, 16777215, 16777215U,
      -8192000, 3.141592653589793, 5898240.0};
  static constexpr Field kPitchCompensation{
      "PitchCompensation", "", 48, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kPitchMerit{
      "PitchMerit", "", 50, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kRollCompensation{
      "RollCompensation", "", 52, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kRollMerit{
      "RollMerit", "", 54, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLatency{
      "Latency", "s", 56, 8, 0U, 250U, 254, 255, 255U,
      0, 1.0, 2000.0};

  /// Pitch angle, nose up is positive. [-250 .. 250 deg on the bus]
  Physical pitch_rad{0.0, RawState::kNotAvailable};
  /// Roll angle. [-250 .. 250 deg on the bus]
  Physical roll_rad{0.0, RawState::kNotAvailable};
  /// The pitch is compensated for motion.
  Coded<PitchCompensation> pitch_compensation{PitchCompensation::kOn, RawState::kValid};
  /// Figure of merit of the pitch.
  Coded<PitchMerit> pitch_merit{PitchMerit::kFunctional, RawState::kValid};
  /// The roll is compensated for motion.
  Coded<RollCompensation> roll_compensation{RollCompensation::kOn, RawState::kValid};
  /// Figure of merit of the roll.
  Coded<RollMerit> roll_merit{RollMerit::kFunctional, RawState::kValid};
  /// Age of the measurement as the frame is sent. [0 .. 125 ms on the bus]
  Physical latency_s{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kPitch, self.pitch_rad);
    visitor(kRoll, self.roll_rad);
    visitor(kPitchCompensation, self.pitch_compensation);
    visitor(kPitchMerit, self.pitch_merit);
    visitor(kRollCompensation, self.roll_compensation);
    visitor(kRollMerit, self.roll_merit);
    visitor(kLatency, self.latency_s);
  }
  static constexpr SSI2 decode(const Payload& payload) {
    return decode_message<SSI2>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Angular rate information (PGN 61482).
struct ARI {
  static constexpr const char* kName = "ARI";
  static constexpr const char* kSender = "LinkImu";
  static constexpr std::uint32_t kId = 0x0CF02AE2;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  enum class PitchRateMerit : std::uint8_t {
    kFunctional = 0,
    kDegraded = 1,
  };

  enum class RollRateMerit : std::uint8_t {
    kFunctional = 0,
    kDegraded = 1,
  };

  enum class YawRateMerit : std::uint8_t {
    kFunctional = 0,
    kDegraded = 1,
  };

  static constexpr Field kPitchRate{
      "PitchRate", "rad/s", 0, 16, 0U, 64127U, 65279, 65535, 65535U,
      -32000, 3.141592653589793, 23040.0};
  static constexpr Field kRollRate{
      "RollRate", "rad/s", 16, 16, 0U, 64127U, 65279, 65535, 65535U,
      -32000, 3.141592653589793, 23040.0};
  static constexpr Field kYawRate{
      "YawRate", "rad/s", 32, 16, 0U, 64127U, 65279, 65535, 65535U,
      -32000, 3.141592653589793, 23040.0};
  static constexpr Field kPitchRateMerit{
      "PitchRateMerit", "", 48, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kRollRateMerit{
      "RollRateMerit", "", 50, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kYawRateMerit{
      "YawRateMerit", "", 52, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLatency{
      "Latency", "s", 56, 8, 0U, 250U, 254, 255, 255U,
      0, 1.0, 2000.0};

  /// Rate of pitch, nose up is positive. [-250 .. 250.992 deg/s on the bus]
  Physical pitch_rate_radps{0.0, RawState::kNotAvailable};
  /// Rate of roll about the sensor's long axis. [-250 .. 250.992 deg/s on the bus]
  Physical roll_rate_radps{0.0, RawState::kNotAvailable};
  /// Rate of yaw about the sensor's upright axis. [-250 .. 250.992 deg/s on the bus]
  Physical yaw_rate_radps{0.0, RawState::kNotAvailable};
  /// Figure of merit of the pitch rate.
  Coded<PitchRateMerit> pitch_rate_merit{PitchRateMerit::kFunctional, RawState::kValid};
  /// Figure of merit of the roll rate.
  Coded<RollRateMerit> roll_rate_merit{RollRateMerit::kFunctional, RawState::kValid};
  /// Figure of merit of the yaw rate.
  Coded<YawRateMerit> yaw_rate_merit{YawRateMerit::kFunctional, RawState::kValid};
  /// Age of the measurement as the frame is sent. [0 .. 125 ms on the bus]
  Physical latency_s{0.0, RawState::kNotAvailable};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kPitchRate, self.pitch_rate_radps);
    visitor(kRollRate, self.roll_rate_radps);
    visitor(kYawRate, self.yaw_rate_radps);
    visitor(kPitchRateMerit, self.pitch_rate_merit);
    visitor(kRollRateMerit, self.roll_rate_merit);
    visitor(kYawRateMerit, self.yaw_rate_merit);
    visitor(kLatency, self.latency_s);
  }
  static constexpr ARI decode(const Payload& payload) {
    return decode_message<ARI>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Acceleration sensor (PGN 61485). At rest and level it shows 1 g upright.
struct ACS {
  static constexpr const char* kName = "ACS";
  static constexpr const char* kSender = "LinkImu";
  static constexpr std::uint32_t kId = 0x0CF02DE2;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  enum class LateralMerit : std::uint8_t {
    kFunctional = 0,
    kDegraded = 1,
  };

  enum class LongitudinalMerit : std::uint8_t {
    kFunctional = 0,
    kDegraded = 1,
  };

  enum class VerticalMerit : std::uint8_t {
    kFunctional = 0,
    kDegraded = 1,
  };

  static constexpr Field kLateral{
      "Lateral", "m/s^2", 0, 16, 0U, 64255U, 65279, 65535, 65535U,
      -32000, 1.0, 100.0};
  static constexpr Field kLongitudinal{
      "Longitudinal", "m/s^2", 16, 16, 0U, 64255U, 65279, 65535, 65535U,
      -32000, 1.0, 100.0};
  static constexpr Field kVertical{
      "Vertical", "m/s^2", 32, 16, 0U, 64255U, 65279, 65535, 65535U,
      -32000, 1.0, 100.0};
  static constexpr Field kLateralMerit{
      "LateralMerit", "", 48, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLongitudinalMerit{
      "LongitudinalMerit", "", 50, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};
  static constexpr Field kVerticalMerit{
      "VerticalMerit", "", 52, 2, 0U, 1U, 2, 3, 0U,
      0, 1.0, 1.0};

  /// Specific force across the sensor's long axis, to the left. [-320 .. 322.55 m/s2 on the bus]
  Physical lateral_mps2{0.0, RawState::kNotAvailable};
  /// Specific force along the sensor's long axis, to its front. [-320 .. 322.55 m/s2 on the bus]
  Physical longitudinal_mps2{0.0, RawState::kNotAvailable};
  /// Specific force along the sensor's upright axis, upwards. [-320 .. 322.55 m/s2 on the bus]
  Physical vertical_mps2{0.0, RawState::kNotAvailable};
  /// Figure of merit of the lateral acceleration.
  Coded<LateralMerit> lateral_merit{LateralMerit::kFunctional, RawState::kValid};
  /// Figure of merit of the longitudinal acceleration.
  Coded<LongitudinalMerit> longitudinal_merit{LongitudinalMerit::kFunctional, RawState::kValid};
  /// Figure of merit of the vertical acceleration.
  Coded<VerticalMerit> vertical_merit{VerticalMerit::kFunctional, RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kLateral, self.lateral_mps2);
    visitor(kLongitudinal, self.longitudinal_mps2);
    visitor(kVertical, self.vertical_mps2);
    visitor(kLateralMerit, self.lateral_merit);
    visitor(kLongitudinalMerit, self.longitudinal_merit);
    visitor(kVerticalMerit, self.vertical_merit);
  }
  static constexpr ACS decode(const Payload& payload) {
    return decode_message<ACS>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

using AllMessages =
    MessageList<SSI2,
                ARI,
                ACS>;

inline constexpr std::array<MessageInfo, 3> kMessages{{
    message_info<SSI2>(),
    message_info<ARI>(),
    message_info<ACS>(),
}};

/// All of this as one type, for what is the same on every machine kind's bus.
struct Dbc {
  using SSI2 = j1939::SSI2;
  using ARI = j1939::ARI;
  using ACS = j1939::ACS;
  using AllMessages = j1939::AllMessages;
  static constexpr const auto& kMessages = j1939::kMessages;
  static constexpr std::uint8_t kDbcVersion = j1939::kDbcVersion;
};

}  // namespace graben::dbc::j1939
