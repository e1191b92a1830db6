// SPDX-License-Identifier: Apache-2.0
// The dozer's signals: scales, positions, start values.

#include "can_dbc/generated/dozer_dbc.hpp"
#include "tests/unit/can_dbc/codec_rules.hpp"

using namespace graben::codec_test;
namespace bus = graben::dbc::dozer;

constexpr double kLitrePerMinute = 1e-3 / 60.0;
constexpr Scale kScales[] = {
    {"BladeStroke", 1e-5, 0.0, 0.0, 0.64},
    {"Position", 1e-4, -1e5, -1e5, 1e5},
    {"Height", 0.5e-3, -16.0, -16.0, 16.0},
    {"Pitch", 5e-5, -1.6, -1.6, 1.6},
    {"PitchRate", 1e-4, -3.2, -3.2, 3.2},
    {"Forward", 1e-4, -3.2, -3.2, 3.2},
    {"Climb", 1e-4, -3.2, -3.2, 3.2},
    {"Pump", 5e-5, -1.6, -1.0, 1.0},
    {"Motor", 2e-5, 0.0, 0.0, 1.0},
    {"LinePressure", 1e3, 0.0, 0.0, 64e6},
    {"LeftTrack", 1e-4, -3.2, -3.2, 3.2},
    {"RightTrack", 1e-4, -3.2, -3.2, 3.2},
    {"EngineSpeed", 0.125 * 2.0 * codec_test::kPi / 60.0, 0.0, 0.0,
     8031.875 * 2.0 * codec_test::kPi / 60.0},
    {"SpeedOverride", 0.005, 0.0, 0.0, 1.0},
    {"BladeSpool", 5e-5, -1.6, -1.0, 1.0},
    {"BladeDuty", 5e-5, -1.6, -1.0, 1.0},
    {"LeftPump", 5e-5, -1.6, -1.0, 1.0},
    {"RightPump", 5e-5, -1.6, -1.0, 1.0},
    {"LeftMotor", 2e-5, 0.0, 0.0, 1.0},
    {"RightMotor", 2e-5, 0.0, 0.0, 1.0},
    {"Lambda", 2e-5, 0.0, 0.0, 1.0},
    {"WantedSpeed", 1e-4, -3.2, -3.2, 3.2},
    {"SpeedLimit", 1e-4, 0.0, 0.0, 6.4},
    {"WantedBladeVelocity", 1e-4, -3.2, -3.2, 3.2},
    {"RequiredFlow", 0.01 * kLitrePerMinute, 0.0, 0.0, 640.0 * kLitrePerMinute},
    {"AvailableFlow", 0.01 * kLitrePerMinute, 0.0, 0.0, 640.0 * kLitrePerMinute},
    {"GradeError", 5e-5, -1.6, -1.6, 1.6},
    {"TiltStroke", 1e-5, 0.0, 0.0, 0.64},
    {"Roll", 5e-5, -1.6, -1.6, 1.6},
    {"RollRate", 1e-4, -3.2, -3.2, 3.2},
    {"TiltSpool", 5e-5, -1.6, -1.0, 1.0},
    {"TiltDuty", 5e-5, -1.6, -1.0, 1.0},
    {"WantedTiltVelocity", 1e-4, -3.2, -3.2, 3.2},
    {"CrossError", 5e-5, -1.6, -1.6, 1.6},
    {"Offset", 1e-4, -3.2, -3.2, 3.2},
    {"Heading", 5e-5, -1.6, -1.6, 1.6},
    {"YawRate", 1e-4, -3.2, -3.2, 3.2},
    {"Age", 60.0, 0.0, 0.0, 3855300.0},
    {"OffOutwards", 2e-3, -0.25, -0.25, 0.25},
    {"OffAcross", 2e-3, -0.25, -0.25, 0.25},
    {"OffUp", 2e-3, -0.25, -0.25, 0.25},
    {"Tolerance", 2e-3, 0.0, 0.0, 0.5},
    {"SpeedShare", 5e-3, 0.0, 0.0, 1.0},
    {"Distance", 10e-3, 0.0, 0.0, 642.55},
    {"Deadline", 10e-3, 0.0, 0.1, 1.0},
    {"Ratio", 5e-5, -1.6, -1.0, 1.0},
    {"Least", 0.5e-3, -16.0, -16.0, 16.0},
    {"Most", 0.5e-3, -16.0, -16.0, 16.0},
    {"MostSpeed", 5e-5, 0.0, 0.0, 3.2},
};

TEST(every_raw_value) { check_every_raw_value<bus::AllMessages>(kScales, 101); }

TEST(saturates_and_refuses) { check_saturation_and_refusal<bus::AllMessages>(kScales); }

// Positions, byte for byte, as the DBC gives them.
TEST(known_payloads) {
  assert_encodes(bus::SpoolCommand{}, {0xFF, 0x0F, 0x00, 0x7D, 0xFF, 0xFF, 0xFF, 0xFF});
  const Payload held{0xFF, 0xDF, 0x00, 0x7D, 0x00, 0x7D, 0xFF, 0xFF};
  assert_encodes(bus::PumpDisplacementCommand{}, held);
  const Payload full{0xFF, 0xFF, 0x50, 0xC3, 0x50, 0xC3, 0xFF, 0xFF};
  assert_encodes(bus::MotorDisplacementCommand{}, full);

  bus::SpoolCommand spool;
  spool.enable.value = bus::SpoolCommand::Enable::kOn;
  spool.pilot_cut.value = bus::SpoolCommand::PilotCut::kOn;
  spool.blade_duty_ratio.value = -1.0;
  assert_encodes(spool, {0xFF, 0x5F, 0xE0, 0x2E, 0xFF, 0xFF, 0xFF, 0xFF});
  // Without a tilt its bytes are those of an unused field.
  spool.tilt_duty_ratio = {0.5, RawState::kValid};
  assert_encodes(spool, {0xFF, 0x5F, 0xE0, 0x2E, 0x10, 0xA4, 0xFF, 0xFF});

  bus::PumpDisplacementCommand pumps;
  pumps.brake.value = bus::PumpDisplacementCommand::Brake::kOff;
  pumps.left_pump_ratio.value = 1.0;
  pumps.right_pump_ratio.value = -1.0;
  const Payload turning{0xFF, 0xCF, 0x20, 0xCB, 0xE0, 0x2E, 0xFF, 0xFF};
  assert_encodes(pumps, turning);

  // 12.3456 m along, 0.5 m below.
  const bus::BodyPosition body =
      bus::BodyPosition::decode({0xFF, 0xFF, 0x40, 0xAC, 0x9C, 0x3B, 0x18, 0x79});
  assert_near(body.position_m.value, 12.3456, 1e-9);
  assert_near(body.height_m.value, -0.5, 1e-12);

  // Neutral and full scale are exact.
  const auto back = bus::PumpDisplacementCommand::decode(turning);
  assert_true(back.left_pump_ratio.value == 1.0 && back.right_pump_ratio.value == -1.0);
  assert_true(bus::PumpDisplacementCommand::decode(held).left_pump_ratio.value == 0.0);
  assert_true(bus::MotorDisplacementCommand::decode(full).left_motor_ratio.value == 1.0);
}

// A command that nobody has filled in moves nothing; a measurement says that there is none.
TEST(start_values) {
  assert_int_equal(bus::BodyPosition{}.position_m.state, RawState::kNotAvailable);
  assert_int_equal(bus::BodyPitch{}.pitch_rate_radps.state, RawState::kNotAvailable);
  assert_int_equal(bus::LeftTransmission{}.motor_ratio.state, RawState::kNotAvailable);
  assert_int_equal(bus::ValveState{}.enabled.state, RawState::kNotAvailable);
  assert_int_equal(bus::PumpDisplacementCommand{}.brake.value,
                   bus::PumpDisplacementCommand::Brake::kOn);
  check_start_values<bus::AllMessages>();
}
