// SPDX-License-Identifier: Apache-2.0
// The excavator's signals: scales, positions, start values.

#include "can_dbc/generated/excavator_dbc.hpp"
#include "tests/unit/can_dbc/codec_rules.hpp"

using namespace graben::codec_test;
namespace bus = graben::dbc::excavator;

constexpr Scale kScales[] = {
    {"BoomStroke", 0.05e-3, 0.0, 0.0, 3.2},
    {"ArmStroke", 0.05e-3, 0.0, 0.0, 3.2},
    {"BucketStroke", 0.05e-3, 0.0, 0.0, 3.2},
    {"BoomCapPressure", 1e3, 0.0, 0.0, 64e6},
    {"BoomRodPressure", 1e3, 0.0, 0.0, 64e6},
    {"ArmCapPressure", 1e3, 0.0, 0.0, 64e6},
    {"ArmRodPressure", 1e3, 0.0, 0.0, 64e6},
    {"BucketCapPressure", 1e3, 0.0, 0.0, 64e6},
    {"BucketRodPressure", 1e3, 0.0, 0.0, 64e6},
    {"Pump1Swash", 2e-5, 0.0, 0.0, 1.2},
    {"Pump2Swash", 2e-5, 0.0, 0.0, 1.2},
    {"EngineSpeed", 0.125 * 2.0 * codec_test::kPi / 60.0, 0.0, 0.0,
     8031.875 * 2.0 * codec_test::kPi / 60.0},
    {"SpeedOverride", 0.005, 0.0, 0.0, 1.0},
    {"BoomDuty", 5e-5, -1.6, -1.0, 1.0},
    {"ArmDuty", 5e-5, -1.6, -1.0, 1.0},
    {"BucketDuty", 5e-5, -1.6, -1.0, 1.0},
    {"BoomSpool", 5e-5, -1.6, -1.0, 1.0},
    {"ArmSpool", 5e-5, -1.6, -1.0, 1.0},
    {"BucketSpool", 5e-5, -1.6, -1.0, 1.0},
    {"Lambda", 2e-5, 0.0, 0.0, 1.0},
    {"BoomWantedVelocity", 1e-4, -3.0, -3.0, 3.4},
    {"ArmWantedVelocity", 1e-4, -3.0, -3.0, 3.4},
    {"BucketWantedVelocity", 1e-4, -3.0, -3.0, 3.4},
    {"Pump1ExpectedPressure", 2e3, 0.0, 0.0, 128e6},
    {"Pump2ExpectedPressure", 2e3, 0.0, 0.0, 128e6},
    {"PathError", 1e-4, 0.0, 0.0, 6.4},
    {"SwingAngle", 1e-4, -3.2, -3.2, 3.2},
    {"SwingLeftPressure", 1e3, 0.0, 0.0, 64e6},
    {"SwingRightPressure", 1e3, 0.0, 0.0, 64e6},
    {"SwingSpool", 5e-5, -1.6, -1.0, 1.0},
    {"SwingDuty", 5e-5, -1.6, -1.0, 1.0},
    {"Progress", 2e-5, 0.0, 0.0, 1.0},
    {"SwingWantedVelocity", 1e-4, -3.2, -3.2, 3.2},
    {"BoomOrUp", 8e-3, -1.0, -1.0, 1.0},
    {"ArmOrForward", 8e-3, -1.0, -1.0, 1.0},
    {"BucketOrAttitude", 8e-3, -1.0, -1.0, 1.0},
    {"Swing", 8e-3, -1.0, -1.0, 1.0},
    {"LeastStroke", 0.05e-3, 0.0, 0.0, 3.2},
    {"MostStroke", 0.05e-3, 0.0, 0.0, 3.2},
    {"MostSpeed", 0.05e-3, 0.0, 0.0, 3.2},
    {"BoomExtendEdge", 1e-3, -0.125, -0.125, 0.125},
    {"BoomRetractEdge", 1e-3, -0.125, -0.125, 0.125},
    {"ArmExtendEdge", 1e-3, -0.125, -0.125, 0.125},
    {"ArmRetractEdge", 1e-3, -0.125, -0.125, 0.125},
    {"BucketExtendEdge", 1e-3, -0.125, -0.125, 0.125},
    {"BucketRetractEdge", 1e-3, -0.125, -0.125, 0.125},
    {"TipForceOutwards", 10.0, -320e3, -320e3, 320e3},
    {"TipForceUp", 10.0, -320e3, -320e3, 320e3},
    {"PayloadMass", 0.25, -1000.0, -1000.0, 15000.0},
    {"TipForceDeviation", 250.0, 0.0, 0.0, 62.5e3},
    {"PayloadDeviation", 1.0, 0.0, 0.0, 250.0},
    {"Age", 60.0, 0.0, 0.0, 3855300.0},
    {"OffOutwards", 2e-3, -0.25, -0.25, 0.25},
    {"OffAcross", 2e-3, -0.25, -0.25, 0.25},
    {"OffUp", 2e-3, -0.25, -0.25, 0.25},
    {"Tolerance", 2e-3, 0.0, 0.0, 0.5},
    {"SpeedShare", 5e-3, 0.0, 0.0, 1.0},
    {"Distance", 10e-3, 0.0, 0.0, 642.55},
    {"Deadline", 10e-3, 0.0, 0.1, 1.0},
};

TEST(every_raw_value) { check_every_raw_value<bus::AllMessages>(kScales, 121); }

TEST(saturates_and_refuses) { check_saturation_and_refusal<bus::AllMessages>(kScales); }

TEST(plain_numbers, bus::EcuStatus status) {
  status.rejected_frames.value = 100000;
  assert_int_equal(sent(status, bus::EcuStatus::kRejectedFrames), 250);
  status.limit_index.value = 251;
  assert_int_equal(sent(status, bus::EcuStatus::kLimitIndex), 250);
  status.fault.value = static_cast<bus::EcuStatus::Fault>(bus::EcuStatus::kFault.raw_max + 1);
  assert_int_equal(sent(status, bus::EcuStatus::kFault), 0xFE);
  status.mode.value = bus::EcuStatus::Mode::kFault;
  assert_int_equal(sent(status, bus::EcuStatus::kMode), 5);
  const bus::EcuIdentity identity{{0xDEADBEEFU, RawState::kValid}, {1U, RawState::kValid}};
  assert_encodes(identity, {0xEF, 0xBE, 0xAD, 0xDE, 0x01, 0xFF, 0xFF, 0xFF});
}

// Positions, byte for byte, as the DBC gives them.
TEST(known_payloads) {
  const Payload neutral{0xFF, 0x0F, 0x00, 0x7D, 0x00, 0x7D, 0x00, 0x7D};
  assert_encodes(bus::SpoolCommand{}, neutral);

  bus::SpoolCommand command;
  command.enable.value = bus::SpoolCommand::Enable::kOn;
  command.boom_duty_ratio.value = 1.0;
  command.arm_duty_ratio.value = -1.0;
  command.bucket_duty_ratio.value = 0.00005;
  const Payload moving{0xFF, 0x1F, 0x20, 0xCB, 0xE0, 0x2E, 0x01, 0x7D};
  assert_encodes(command, moving);

  bus::SwingCommand swing;
  assert_encodes(swing, {0xFF, 0xCF, 0x00, 0x7D, 0xFF, 0xFF, 0xFF, 0xFF});
  swing.enable.value = bus::SwingCommand::Enable::kOn;
  swing.swing_duty_ratio.value = -1.0;
  assert_encodes(swing, {0xFF, 0xDF, 0xE0, 0x2E, 0xFF, 0xFF, 0xFF, 0xFF});

  command = {};
  command.pilot_cut.value = bus::SpoolCommand::PilotCut::kOn;
  assert_encodes(command, {0xFF, 0x4F, 0x00, 0x7D, 0x00, 0x7D, 0x00, 0x7D});

  const bus::EEC1 engine = bus::EEC1::decode({0xFF, 0xFF, 0xFF, 0x80, 0x3E, 0xFF, 0xFF, 0xFF});
  assert_near(engine.engine_speed_radps.value, 2000.0 * 2.0 * codec_test::kPi / 60.0, 1e-9);

  const bus::OperatorCommand driver =
      bus::OperatorCommand::decode({0x00, 0xD0, 0xF1, 0x01, 0x64, 0xFF, 0xFF, 0xFF});
  assert_int_equal(driver.enable.value, bus::OperatorCommand::Enable::kOn);
  assert_int_equal(driver.operator_mode.value, bus::OperatorCommand::OperatorMode::kAutomatic);
  assert_int_equal(driver.task.value, bus::OperatorCommand::Task::kDig);
  assert_near(driver.speed_override_ratio.value, 0.5, 0.0);

  // J1939-73, version 4: red stop lamp, SPN 520192 + 12 = 0x7F00C, FMI 19, third time; lamp bytes,
  // SPN low byte first, its high bits above the FMI, conversion method 0 above the count.
  bus::DM1 trouble;
  trouble.red_stop_lamp.value = bus::DM1::RedStopLamp::kOn;
  trouble.spn_low.value = 0xF00C;
  trouble.spn_high.value = 7;
  trouble.fmi.value = 19;
  trouble.occurrence_count.value = 3;
  assert_encodes(trouble, {0x10, 0xFF, 0x0C, 0xF0, 0xF3, 0x03, 0xFF, 0xFF});
  assert_encodes(bus::DM1{}, {0x00, 0xFF, 0x00, 0x00, 0x00, 0x00, 0xFF, 0xFF});

  // Neutral and full scale are exact: 0 is neutral, and a ratio of 1 is not above 1.
  const bus::SpoolCommand back = bus::SpoolCommand::decode(moving);
  assert_true(back.boom_duty_ratio.value == 1.0);
  assert_true(back.arm_duty_ratio.value == -1.0);
  assert_true(bus::SpoolCommand::decode(neutral).boom_duty_ratio.value == 0.0);
}

TEST(start_values) {
  assert_int_equal(bus::BoomStroke{}.boom_stroke_m.state, RawState::kNotAvailable);
  assert_int_equal(bus::SpoolCommand{}.enable.value, bus::SpoolCommand::Enable::kOff);
  assert_int_equal(bus::SpoolCommand{}.pilot_cut.value, bus::SpoolCommand::PilotCut::kOff);
  assert_int_equal(bus::SwingState{}.swing_angle_rad.state, RawState::kNotAvailable);
  assert_int_equal(bus::SwingCommand{}.enable.value, bus::SwingCommand::Enable::kOff);
  assert_int_equal(bus::TaskStatus{}.task_number.state, RawState::kNotAvailable);
  assert_int_equal(bus::PumpCommand{}.pump1_swash_ratio.state, RawState::kNotAvailable);
  assert_int_equal(bus::ValveState{}.enabled.state, RawState::kNotAvailable);
  assert_int_equal(bus::EcuHealth{}.real_time.value, bus::EcuHealth::RealTime::kOff);
  assert_int_equal(bus::OperatorCommand{}.enable.value, bus::OperatorCommand::Enable::kOff);
  check_start_values<bus::AllMessages>();
}
