// SPDX-License-Identifier: Apache-2.0
// Generated from zx200.dbc.in by can_dbc/generate.py; change the DBC and generate again.
// clang-format off
#pragma once
/// Machine and external controller of an excavator of the ZX200 class. Angles are those of the
/// joints, right-handed about the axis that points to the machine's left: a link that sinks turns
/// positive.
/// Values are in the SI unit that their name ends with. A message that nobody has filled in carries
/// the start values. encode() rounds to the nearest raw value and saturates into [min|max]; NaN and
/// infinities become the signal's error value, or its start value where it has none; bits of no
/// signal are 1. CRC and counter are left to the end-to-end protection.

#include <array>
#include <cstdint>

#include "can_dbc/codec.hpp"

namespace graben::dbc::zx200 {

inline constexpr std::uint8_t kDbcVersion = 1;

/// Lock, mode and errors.
struct MachineState {
  static constexpr const char* kName = "MachineState";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x18FF84E8;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 50;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kLockCmdState{
      "LockCmdState", "", 0, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kPilotShutoffValveState{
      "PilotShutoffValveState", "", 6, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kSystemError{
      "SystemError", "", 8, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kCanErrorPl{
      "CanErrorPl", "", 9, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kCanErrorBody{
      "CanErrorBody", "", 10, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kCanErrorIct{
      "CanErrorIct", "", 11, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kLockReceiverError{
      "LockReceiverError", "", 12, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kEmergencyStopReceiverError{
      "EmergencyStopReceiverError", "", 13, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kSwitchError{
      "SwitchError", "", 14, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kControlState{
      "ControlState", "", 16, 8, 0U, 255U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kOilTemperature{
      "OilTemperature", "degC", 24, 8, 0U, 255U, -1, -1, 100U,
      -100, 1.0, 1.0};
  static constexpr Field kEngineState{
      "EngineState", "", 40, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kAliveCounter{
      "AliveCounter", "", 56, 8, 0U, 255U, -1, -1, 0U,
      0, 1.0, 1.0};

  /// 1: the machine is locked. [0 .. 1 on the bus]
  Count lock_cmd_state{0U, RawState::kValid};
  /// 1: the pilot pressure reaches the valves. [0 .. 1 on the bus]
  Count pilot_shutoff_valve_state{0U, RawState::kValid};
  /// 1: an error of the system. [0 .. 1 on the bus]
  Count system_error{0U, RawState::kValid};
  /// 1: an error of the bus of the pressures. [0 .. 1 on the bus]
  Count can_error_pl{0U, RawState::kValid};
  /// 1: an error of the machine's own bus. [0 .. 1 on the bus]
  Count can_error_body{0U, RawState::kValid};
  /// 1: an error of the bus to the external controller. [0 .. 1 on the bus]
  Count can_error_ict{0U, RawState::kValid};
  /// 1: the lock's receiver is not heard. [0 .. 1 on the bus]
  Count lock_receiver_error{0U, RawState::kValid};
  /// 1: the emergency stop is pressed, or its receiver not heard. [0 .. 1 on the bus]
  Count emergency_stop_receiver_error{0U, RawState::kValid};
  /// 1: an error of a switch. [0 .. 1 on the bus]
  Count switch_error{0U, RawState::kValid};
  /// What drives the machine; 1: the external controller. [0 .. 255 on the bus]
  Count control_state{0U, RawState::kValid};
  /// Of the hydraulic oil. [-100 .. 155 degC on the bus]
  Physical oil_temperature_degc{physical_of(kOilTemperature, 100U), RawState::kValid};
  /// 1: the engine runs. [0 .. 1 on the bus]
  Count engine_state{0U, RawState::kValid};
  /// Goes on by one with every frame. [0 .. 255 on the bus]
  Count alive_counter{0U, RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kLockCmdState, self.lock_cmd_state);
    visitor(kPilotShutoffValveState, self.pilot_shutoff_valve_state);
    visitor(kSystemError, self.system_error);
    visitor(kCanErrorPl, self.can_error_pl);
    visitor(kCanErrorBody, self.can_error_body);
    visitor(kCanErrorIct, self.can_error_ict);
    visitor(kLockReceiverError, self.lock_receiver_error);
    visitor(kEmergencyStopReceiverError, self.emergency_stop_receiver_error);
    visitor(kSwitchError, self.switch_error);
    visitor(kControlState, self.control_state);
    visitor(kOilTemperature, self.oil_temperature_degc);
    visitor(kEngineState, self.engine_state);
    visitor(kAliveCounter, self.alive_counter);
  }
  static constexpr MachineState decode(const Payload& payload) {
    return decode_message<MachineState>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Pilot pressures of the front's and the swing's spools.
struct PilotPressure1 {
  static constexpr const char* kName = "PilotPressure1";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x18FF7BE8;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kBoomUpPilot{
      "BoomUpPilot", "Pa", 0, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kBoomDownPilot{
      "BoomDownPilot", "Pa", 8, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kArmCrowdPilot{
      "ArmCrowdPilot", "Pa", 16, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kArmDumpPilot{
      "ArmDumpPilot", "Pa", 24, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kBucketCrowdPilot{
      "BucketCrowdPilot", "Pa", 32, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kBucketDumpPilot{
      "BucketDumpPilot", "Pa", 40, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kSwingRightPilot{
      "SwingRightPilot", "Pa", 48, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kSwingLeftPilot{
      "SwingLeftPilot", "Pa", 56, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};

  /// Measured pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical boom_up_pilot_pa{physical_of(kBoomUpPilot, 0U), RawState::kValid};
  /// Measured pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical boom_down_pilot_pa{physical_of(kBoomDownPilot, 0U), RawState::kValid};
  /// Measured pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical arm_crowd_pilot_pa{physical_of(kArmCrowdPilot, 0U), RawState::kValid};
  /// Measured pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical arm_dump_pilot_pa{physical_of(kArmDumpPilot, 0U), RawState::kValid};
  /// Measured pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical bucket_crowd_pilot_pa{physical_of(kBucketCrowdPilot, 0U), RawState::kValid};
  /// Measured pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical bucket_dump_pilot_pa{physical_of(kBucketDumpPilot, 0U), RawState::kValid};
  /// Measured pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical swing_right_pilot_pa{physical_of(kSwingRightPilot, 0U), RawState::kValid};
  /// Measured pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical swing_left_pilot_pa{physical_of(kSwingLeftPilot, 0U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBoomUpPilot, self.boom_up_pilot_pa);
    visitor(kBoomDownPilot, self.boom_down_pilot_pa);
    visitor(kArmCrowdPilot, self.arm_crowd_pilot_pa);
    visitor(kArmDumpPilot, self.arm_dump_pilot_pa);
    visitor(kBucketCrowdPilot, self.bucket_crowd_pilot_pa);
    visitor(kBucketDumpPilot, self.bucket_dump_pilot_pa);
    visitor(kSwingRightPilot, self.swing_right_pilot_pa);
    visitor(kSwingLeftPilot, self.swing_left_pilot_pa);
  }
  static constexpr PilotPressure1 decode(const Payload& payload) {
    return decode_message<PilotPressure1>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Pressures of the front's cylinders and the swing's motor.
struct Pressure1 {
  static constexpr const char* kName = "Pressure1";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x18FF79E8;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kBoomBottomPressure{
      "BoomBottomPressure", "Pa", 0, 8, 0U, 255U, -1, -1, 50U,
      -50, 200000.0, 1.0};
  static constexpr Field kBoomRodPressure{
      "BoomRodPressure", "Pa", 8, 8, 0U, 255U, -1, -1, 50U,
      -50, 200000.0, 1.0};
  static constexpr Field kArmBottomPressure{
      "ArmBottomPressure", "Pa", 16, 8, 0U, 255U, -1, -1, 50U,
      -50, 200000.0, 1.0};
  static constexpr Field kArmRodPressure{
      "ArmRodPressure", "Pa", 24, 8, 0U, 255U, -1, -1, 50U,
      -50, 200000.0, 1.0};
  static constexpr Field kBucketBottomPressure{
      "BucketBottomPressure", "Pa", 32, 8, 0U, 255U, -1, -1, 50U,
      -50, 200000.0, 1.0};
  static constexpr Field kBucketRodPressure{
      "BucketRodPressure", "Pa", 40, 8, 0U, 255U, -1, -1, 50U,
      -50, 200000.0, 1.0};
  static constexpr Field kSwingAPressure{
      "SwingAPressure", "Pa", 48, 8, 0U, 255U, -1, -1, 50U,
      -50, 200000.0, 1.0};
  static constexpr Field kSwingBPressure{
      "SwingBPressure", "Pa", 56, 8, 0U, 255U, -1, -1, 50U,
      -50, 200000.0, 1.0};

  /// Measured pressure. [-10 .. 41 MPa on the bus]
  Physical boom_bottom_pressure_pa{physical_of(kBoomBottomPressure, 50U), RawState::kValid};
  /// Measured pressure. [-10 .. 41 MPa on the bus]
  Physical boom_rod_pressure_pa{physical_of(kBoomRodPressure, 50U), RawState::kValid};
  /// Measured pressure. [-10 .. 41 MPa on the bus]
  Physical arm_bottom_pressure_pa{physical_of(kArmBottomPressure, 50U), RawState::kValid};
  /// Measured pressure. [-10 .. 41 MPa on the bus]
  Physical arm_rod_pressure_pa{physical_of(kArmRodPressure, 50U), RawState::kValid};
  /// Measured pressure. [-10 .. 41 MPa on the bus]
  Physical bucket_bottom_pressure_pa{physical_of(kBucketBottomPressure, 50U), RawState::kValid};
  /// Measured pressure. [-10 .. 41 MPa on the bus]
  Physical bucket_rod_pressure_pa{physical_of(kBucketRodPressure, 50U), RawState::kValid};
  /// Measured pressure. [-10 .. 41 MPa on the bus]
  Physical swing_a_pressure_pa{physical_of(kSwingAPressure, 50U), RawState::kValid};
  /// Measured pressure. [-10 .. 41 MPa on the bus]
  Physical swing_b_pressure_pa{physical_of(kSwingBPressure, 50U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBoomBottomPressure, self.boom_bottom_pressure_pa);
    visitor(kBoomRodPressure, self.boom_rod_pressure_pa);
    visitor(kArmBottomPressure, self.arm_bottom_pressure_pa);
    visitor(kArmRodPressure, self.arm_rod_pressure_pa);
    visitor(kBucketBottomPressure, self.bucket_bottom_pressure_pa);
    visitor(kBucketRodPressure, self.bucket_rod_pressure_pa);
    visitor(kSwingAPressure, self.swing_a_pressure_pa);
    visitor(kSwingBPressure, self.swing_b_pressure_pa);
  }
  static constexpr Pressure1 decode(const Payload& payload) {
    return decode_message<Pressure1>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Flows into the front's cylinders and the swing's motor.
struct FlowRate1 {
  static constexpr const char* kName = "FlowRate1";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x18FF7FE8;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kBoomBottomFlow{
      "BoomBottomFlow", "m^3/s", 0, 8, 0U, 255U, -1, -1, 125U,
      -125, 1.0, 7500.0};
  static constexpr Field kBoomRodFlow{
      "BoomRodFlow", "m^3/s", 8, 8, 0U, 255U, -1, -1, 125U,
      -125, 1.0, 7500.0};
  static constexpr Field kArmBottomFlow{
      "ArmBottomFlow", "m^3/s", 16, 8, 0U, 255U, -1, -1, 125U,
      -125, 1.0, 7500.0};
  static constexpr Field kArmRodFlow{
      "ArmRodFlow", "m^3/s", 24, 8, 0U, 255U, -1, -1, 125U,
      -125, 1.0, 7500.0};
  static constexpr Field kBucketBottomFlow{
      "BucketBottomFlow", "m^3/s", 32, 8, 0U, 255U, -1, -1, 125U,
      -125, 1.0, 7500.0};
  static constexpr Field kBucketRodFlow{
      "BucketRodFlow", "m^3/s", 40, 8, 0U, 255U, -1, -1, 125U,
      -125, 1.0, 7500.0};
  static constexpr Field kSwingAFlow{
      "SwingAFlow", "m^3/s", 48, 8, 0U, 255U, -1, -1, 125U,
      -125, 1.0, 7500.0};
  static constexpr Field kSwingBFlow{
      "SwingBFlow", "m^3/s", 56, 8, 0U, 255U, -1, -1, 125U,
      -125, 1.0, 7500.0};

  /// Flow into it. [-1000 .. 1040 L/min on the bus]
  Physical boom_bottom_flow_m3ps{physical_of(kBoomBottomFlow, 125U), RawState::kValid};
  /// Flow into it. [-1000 .. 1040 L/min on the bus]
  Physical boom_rod_flow_m3ps{physical_of(kBoomRodFlow, 125U), RawState::kValid};
  /// Flow into it. [-1000 .. 1040 L/min on the bus]
  Physical arm_bottom_flow_m3ps{physical_of(kArmBottomFlow, 125U), RawState::kValid};
  /// Flow into it. [-1000 .. 1040 L/min on the bus]
  Physical arm_rod_flow_m3ps{physical_of(kArmRodFlow, 125U), RawState::kValid};
  /// Flow into it. [-1000 .. 1040 L/min on the bus]
  Physical bucket_bottom_flow_m3ps{physical_of(kBucketBottomFlow, 125U), RawState::kValid};
  /// Flow into it. [-1000 .. 1040 L/min on the bus]
  Physical bucket_rod_flow_m3ps{physical_of(kBucketRodFlow, 125U), RawState::kValid};
  /// Flow into it. [-1000 .. 1040 L/min on the bus]
  Physical swing_a_flow_m3ps{physical_of(kSwingAFlow, 125U), RawState::kValid};
  /// Flow into it. [-1000 .. 1040 L/min on the bus]
  Physical swing_b_flow_m3ps{physical_of(kSwingBFlow, 125U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBoomBottomFlow, self.boom_bottom_flow_m3ps);
    visitor(kBoomRodFlow, self.boom_rod_flow_m3ps);
    visitor(kArmBottomFlow, self.arm_bottom_flow_m3ps);
    visitor(kArmRodFlow, self.arm_rod_flow_m3ps);
    visitor(kBucketBottomFlow, self.bucket_bottom_flow_m3ps);
    visitor(kBucketRodFlow, self.bucket_rod_flow_m3ps);
    visitor(kSwingAFlow, self.swing_a_flow_m3ps);
    visitor(kSwingBFlow, self.swing_b_flow_m3ps);
  }
  static constexpr FlowRate1 decode(const Payload& payload) {
    return decode_message<FlowRate1>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Pilot pressures that the front's and the swing's spools are to have.
struct PilotPressureCmd1 {
  static constexpr const char* kName = "PilotPressureCmd1";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FF640A;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kBoomUp{
      "BoomUp", "Pa", 0, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kBoomDown{
      "BoomDown", "Pa", 8, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kArmCrowd{
      "ArmCrowd", "Pa", 16, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kArmDump{
      "ArmDump", "Pa", 24, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kBucketCrowd{
      "BucketCrowd", "Pa", 32, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kBucketDump{
      "BucketDump", "Pa", 40, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kSwingRight{
      "SwingRight", "Pa", 48, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};
  static constexpr Field kSwingLeft{
      "SwingLeft", "Pa", 56, 8, 0U, 255U, -1, -1, 0U,
      0, 20000.0, 1.0};

  /// Wanted pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical boom_up_pa{physical_of(kBoomUp, 0U), RawState::kValid};
  /// Wanted pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical boom_down_pa{physical_of(kBoomDown, 0U), RawState::kValid};
  /// Wanted pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical arm_crowd_pa{physical_of(kArmCrowd, 0U), RawState::kValid};
  /// Wanted pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical arm_dump_pa{physical_of(kArmDump, 0U), RawState::kValid};
  /// Wanted pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical bucket_crowd_pa{physical_of(kBucketCrowd, 0U), RawState::kValid};
  /// Wanted pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical bucket_dump_pa{physical_of(kBucketDump, 0U), RawState::kValid};
  /// Wanted pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical swing_right_pa{physical_of(kSwingRight, 0U), RawState::kValid};
  /// Wanted pilot pressure. [0 .. 5.1 MPa on the bus]
  Physical swing_left_pa{physical_of(kSwingLeft, 0U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBoomUp, self.boom_up_pa);
    visitor(kBoomDown, self.boom_down_pa);
    visitor(kArmCrowd, self.arm_crowd_pa);
    visitor(kArmDump, self.arm_dump_pa);
    visitor(kBucketCrowd, self.bucket_crowd_pa);
    visitor(kBucketDump, self.bucket_dump_pa);
    visitor(kSwingRight, self.swing_right_pa);
    visitor(kSwingLeft, self.swing_left_pa);
  }
  static constexpr PilotPressureCmd1 decode(const Payload& payload) {
    return decode_message<PilotPressureCmd1>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Angles of the joints, each against the link before it.
struct FrontAngle {
  static constexpr const char* kName = "FrontAngle";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x18FF7DE8;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kBoomAngle{
      "BoomAngle", "rad", 0, 16, 0U, 65535U, -1, -1, 25000U,
      -25000, 1.0, 2500.0};
  static constexpr Field kArmAngle{
      "ArmAngle", "rad", 16, 16, 0U, 65535U, -1, -1, 25000U,
      -25000, 1.0, 2500.0};
  static constexpr Field kBucketAngle{
      "BucketAngle", "rad", 32, 16, 0U, 65535U, -1, -1, 25000U,
      -25000, 1.0, 2500.0};
  static constexpr Field kSwingAngle{
      "SwingAngle", "rad", 48, 16, 0U, 65535U, -1, -1, 25000U,
      -25000, 1.0, 2500.0};

  /// Of this joint. [-10 .. 16.214 rad on the bus]
  Physical boom_angle_rad{physical_of(kBoomAngle, 25000U), RawState::kValid};
  /// Of this joint. [-10 .. 16.214 rad on the bus]
  Physical arm_angle_rad{physical_of(kArmAngle, 25000U), RawState::kValid};
  /// Of this joint. [-10 .. 16.214 rad on the bus]
  Physical bucket_angle_rad{physical_of(kBucketAngle, 25000U), RawState::kValid};
  /// Of this joint. [-10 .. 16.214 rad on the bus]
  Physical swing_angle_rad{physical_of(kSwingAngle, 25000U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBoomAngle, self.boom_angle_rad);
    visitor(kArmAngle, self.arm_angle_rad);
    visitor(kBucketAngle, self.bucket_angle_rad);
    visitor(kSwingAngle, self.swing_angle_rad);
  }
  static constexpr FrontAngle decode(const Payload& payload) {
    return decode_message<FrontAngle>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Rates of the joints.
struct FrontAngularVelocity {
  static constexpr const char* kName = "FrontAngularVelocity";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x18FF78E8;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 10;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kBoomRate{
      "BoomRate", "rad/s", 0, 16, 0U, 65535U, -1, -1, 25000U,
      -25000, 1.0, 5000.0};
  static constexpr Field kArmRate{
      "ArmRate", "rad/s", 16, 16, 0U, 65535U, -1, -1, 25000U,
      -25000, 1.0, 5000.0};
  static constexpr Field kBucketRate{
      "BucketRate", "rad/s", 32, 16, 0U, 65535U, -1, -1, 25000U,
      -25000, 1.0, 5000.0};
  static constexpr Field kSwingRate{
      "SwingRate", "rad/s", 48, 16, 0U, 65535U, -1, -1, 25000U,
      -25000, 1.0, 5000.0};

  /// Of this joint. [-5 .. 8.107 rad/s on the bus]
  Physical boom_rate_radps{physical_of(kBoomRate, 25000U), RawState::kValid};
  /// Of this joint. [-5 .. 8.107 rad/s on the bus]
  Physical arm_rate_radps{physical_of(kArmRate, 25000U), RawState::kValid};
  /// Of this joint. [-5 .. 8.107 rad/s on the bus]
  Physical bucket_rate_radps{physical_of(kBucketRate, 25000U), RawState::kValid};
  /// Of this joint. [-5 .. 8.107 rad/s on the bus]
  Physical swing_rate_radps{physical_of(kSwingRate, 25000U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kBoomRate, self.boom_rate_radps);
    visitor(kArmRate, self.arm_rate_radps);
    visitor(kBucketRate, self.bucket_rate_radps);
    visitor(kSwingRate, self.swing_rate_radps);
  }
  static constexpr FrontAngularVelocity decode(const Payload& payload) {
    return decode_message<FrontAngularVelocity>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// Attitude of the upper body.
struct RollPitchAngle {
  static constexpr const char* kName = "RollPitchAngle";
  static constexpr const char* kSender = "Machine";
  static constexpr std::uint32_t kId = 0x18FF7EE8;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 20;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kRoll{
      "Roll", "rad", 0, 14, 0U, 16383U, -1, -1, 8000U,
      -8000, 1.0, 2000.0};
  static constexpr Field kPitch{
      "Pitch", "rad", 16, 14, 0U, 16383U, -1, -1, 8000U,
      -8000, 1.0, 2000.0};

  /// Roll angle. [-4 .. 4.1915 rad on the bus]
  Physical roll_rad{physical_of(kRoll, 8000U), RawState::kValid};
  /// Pitch angle. [-4 .. 4.1915 rad on the bus]
  Physical pitch_rad{physical_of(kPitch, 8000U), RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kRoll, self.roll_rad);
    visitor(kPitch, self.pitch_rad);
  }
  static constexpr RollPitchAngle decode(const Payload& payload) {
    return decode_message<RollPitchAngle>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

/// What the external controller asks of the machine; it is there as long as the counter goes on.
struct MachineSettingCmd {
  static constexpr const char* kName = "MachineSettingCmd";
  static constexpr const char* kSender = "Graben";
  static constexpr std::uint32_t kId = 0x18FF660A;
  static constexpr std::uint8_t kLength = 8;
  static constexpr std::uint16_t kCycleTimeMs = 50;
  static constexpr bool kProtected = false;
  static constexpr std::uint16_t kDataId = 0x0000;
  static constexpr std::uint8_t kMaxDeltaCounter = 0;

  static constexpr Field kEngineSpeed{
      "EngineSpeed", "rad/s", 0, 8, 0U, 255U, -1, -1, 0U,
      0, 3.141592653589793, 3.0};
  static constexpr Field kPowerEcoMode{
      "PowerEcoMode", "", 8, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kTravelSpeedMode{
      "TravelSpeedMode", "", 9, 2, 0U, 3U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kWorkingModeNotice{
      "WorkingModeNotice", "", 11, 1, 0U, 1U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kYellowLedMode{
      "YellowLedMode", "", 12, 2, 0U, 3U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kHorn{
      "Horn", "", 14, 2, 0U, 3U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kTravelSignalSwitch{
      "TravelSignalSwitch", "", 24, 4, 0U, 15U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kFrontSignalSwitch{
      "FrontSignalSwitch", "", 28, 4, 0U, 15U, -1, -1, 0U,
      0, 1.0, 1.0};
  static constexpr Field kAliveCounter{
      "AliveCounter", "", 56, 8, 0U, 255U, -1, -1, 0U,
      0, 1.0, 1.0};

  /// Wanted engine speed. [0 .. 2550 rpm on the bus]
  Physical engine_speed_radps{physical_of(kEngineSpeed, 0U), RawState::kValid};
  /// 1: power. [0 .. 1 on the bus]
  Count power_eco_mode{0U, RawState::kValid};
  /// Of the tracks. [0 .. 3 on the bus]
  Count travel_speed_mode{0U, RawState::kValid};
  /// 1: work is under way. [0 .. 1 on the bus]
  Count working_mode_notice{0U, RawState::kValid};
  /// Of the lamp. [0 .. 3 on the bus]
  Count yellow_led_mode{0U, RawState::kValid};
  /// 1: it sounds. [0 .. 3 on the bus]
  Count horn{0U, RawState::kValid};
  /// What drives the tracks; 0: the levers. [0 .. 15 on the bus]
  Count travel_signal_switch{0U, RawState::kValid};
  /// What drives front and swing; 0: the levers, 1: PilotPressureCmd1. [0 .. 15 on the bus]
  Count front_signal_switch{0U, RawState::kValid};
  /// Goes on by one with every frame. [0 .. 255 on the bus]
  Count alive_counter{0U, RawState::kValid};

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(kEngineSpeed, self.engine_speed_radps);
    visitor(kPowerEcoMode, self.power_eco_mode);
    visitor(kTravelSpeedMode, self.travel_speed_mode);
    visitor(kWorkingModeNotice, self.working_mode_notice);
    visitor(kYellowLedMode, self.yellow_led_mode);
    visitor(kHorn, self.horn);
    visitor(kTravelSignalSwitch, self.travel_signal_switch);
    visitor(kFrontSignalSwitch, self.front_signal_switch);
    visitor(kAliveCounter, self.alive_counter);
  }
  static constexpr MachineSettingCmd decode(const Payload& payload) {
    return decode_message<MachineSettingCmd>(payload);
  }
  constexpr Payload encode() const { return encode_message(*this); }
};

using AllMessages =
    MessageList<MachineState,
                PilotPressure1,
                Pressure1,
                FlowRate1,
                PilotPressureCmd1,
                FrontAngle,
                FrontAngularVelocity,
                RollPitchAngle,
                MachineSettingCmd>;

inline constexpr std::array<MessageInfo, 9> kMessages{{
    message_info<MachineState>(),
    message_info<PilotPressure1>(),
    message_info<Pressure1>(),
    message_info<FlowRate1>(),
    message_info<PilotPressureCmd1>(),
    message_info<FrontAngle>(),
    message_info<FrontAngularVelocity>(),
    message_info<RollPitchAngle>(),
    message_info<MachineSettingCmd>(),
}};

/// All of this as one type, for what is the same on every machine kind's bus.
struct Dbc {
  using MachineState = zx200::MachineState;
  using PilotPressure1 = zx200::PilotPressure1;
  using Pressure1 = zx200::Pressure1;
  using FlowRate1 = zx200::FlowRate1;
  using PilotPressureCmd1 = zx200::PilotPressureCmd1;
  using FrontAngle = zx200::FrontAngle;
  using FrontAngularVelocity = zx200::FrontAngularVelocity;
  using RollPitchAngle = zx200::RollPitchAngle;
  using MachineSettingCmd = zx200::MachineSettingCmd;
  using AllMessages = zx200::AllMessages;
  static constexpr const auto& kMessages = zx200::kMessages;
  static constexpr std::uint8_t kDbcVersion = zx200::kDbcVersion;
};

}  // namespace graben::dbc::zx200
