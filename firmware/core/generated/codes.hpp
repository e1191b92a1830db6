// SPDX-License-Identifier: Apache-2.0
// Generated from firmware/safety/faults.toml and limits.toml by can_dbc/generate_all.py.
// clang-format off
#pragma once
/// Codes on the bus that faults.toml and limits.toml number.

#include <cstdint>

namespace graben {

/// What stopped the machine or took a function away (firmware/safety/README.md).
enum class Fault : std::uint8_t {
  kNone = 0,
  kStrokeMissing = 1,  ///< No fresh, valid stroke of a drive.
  kPressureMissing = 2,  ///< No fresh, valid pressure of a drive.
  kSwashMissing = 3,  ///< No fresh, valid swash of a pump.
  kEngineSpeedMissing = 4,  ///< No fresh, valid engine speed; idle is assumed.
  kOperatorMissing = 5,  ///< No fresh, valid command of the operator.
  kStrokeImplausible = 6,  ///< A stroke lies outside its range.
  kPoseUnreachable = 7,  ///< The strokes give no pose.
  kSolverFailed = 8,  ///< The valve's equations were not solved.
  kCommandNotFinite = 9,  ///< A command is not a finite number.
  kCycleStalled = 10,  ///< Too long since the last cycle.
  kIdentityMismatch = 11,  ///< The machine's end has another profile or DBC, or does not say.
  kBusOff = 12,  ///< The bus controller has left the bus.
  kBusPassive = 13,  ///< Nobody acknowledges.
  kBusDown = 14,  ///< The interface is down or gone.
  kTransmitFailed = 15,  ///< The bus did not take our frames, two cycles in a row.
  kCycleOverrun = 16,  ///< Two cycles in a row came late, or late ones too often.
  kMessageCorrupt = 17,  ///< Three wrong CRCs of a message in its window.
  kMessageSequence = 18,  ///< Three of a message out of sequence: two senders, replay, babble.
  kMessageMasquerade = 19,  ///< A CRC that fits another message.
  kSpoolMissing = 20,  ///< No feedback of the valve.
  kSpoolStuck = 21,  ///< A spool is where no command of late has sent it.
  kUncommandedMotion = 22,  ///< A cylinder moves with its spool closed, or against it.
  kStrokeStuck = 23,  ///< A stroke stands still while its spool feeds the cylinder.
  kStrokeJump = 24,  ///< A stroke changes faster than the cylinder can.
  kPressureImplausible = 25,  ///< A pressure stands still in motion, or at its sensor's end.
  kSwashDisagrees = 26,  ///< A pump's swash is not what it was told to be.
  kMemoryCorrupt = 27,  ///< A stored setpoint differs from its complement.
  kValveNotFollowing = 28,  ///< The valve side does not confirm enable in time.
  kValueOutOfRange = 29,  ///< A frame, CRC right, had a value outside its range.
  kSensorError = 30,  ///< A sender calls its own value wrong.
  kPoseMissing = 31,  ///< Position, height, pitch or a rate of the body.
  kPoseImplausible = 32,  ///< The body's pose jumps, or cannot be.
  kTransmissionMissing = 33,  ///< A displacement's feedback or a track's speed.
  kDisplacementDisagrees = 34,  ///< A displacement does not reach what it was told to be.
  kDisplacementRunaway = 35,  ///< A displacement goes where no command of late has sent it.
  kTrackSpeedDisagrees = 36,  ///< A track's speed is not that of its displacements.
  kTaskUnknown = 37,  ///< The task that is chosen is not known.
  kStreamLate = 38,  ///< Frames in order that come later and later, or an answer that comes too late.
  kSecondController = 39,  ///< A message of ours, sent by somebody else.
  kEngineStopped = 40,  ///< The engine runs below idle, or not at all.
  kWrongDirection = 41,  ///< A drive moves against its spool.
  kMotionImplausible = 42,  ///< A drive's sensor does not show what its spool makes the drive do.
  kPathLeft = 43,  ///< The tool is farther from its path, plan or design than safety.tube.
  kPoseDisagrees = 44,  ///< Position, pitch and rates of the body do not fit each other, or the tracks.
  kStalling = 45,  ///< In motion, and hardly getting on for 2 s.
  kStalled = 46,  ///< In motion, and hardly getting on for as long as the profile allows.
  kBlocked = 47,  ///< A drive pushes with what its pump gives, and stands.
  kCommissionBound = 48,  ///< In commissioning a drive is outside its window, faster than confirmed, or one of three at once.
  kNoWay = 49,  ///< No way that is tried leads to a task's start and keeps clear of its fences.
};
inline constexpr int kFaultCount = 50;  ///< With kNone.

/// Why the mode is neither Armed nor Active: bit numbers of MachineStatus::why_not_armed.
enum class ArmBlock : std::uint8_t {
  kStroke = 0,  ///< A stroke is missing or cannot be.
  kPressure = 1,  ///< A pressure is missing or cannot be.
  kSwash = 2,  ///< A swash is missing or not as commanded.
  kEngineSpeed = 3,  ///< It is missing.
  kOperator = 4,  ///< The operator's frames are missing.
  kSpool = 5,  ///< No feedback of the valve.
  kIdentity = 6,  ///< Another profile or DBC, or none said.
  kBus = 7,  ///< Not active, or it does not take our frames.
  kMessages = 8,  ///< Wrong CRC, wrong sequence, a value out of range.
  kUnreachable = 9,  ///< The strokes give no pose.
  kCycle = 10,  ///< Cycles late.
  kManual = 11,  ///< The operator drives by hand.
  kTaskNotAtRest = 12,  ///< A task is chosen before enable is given.
  kEnableNotFresh = 13,  ///< Not given; or it was given all the time and has to be released first.
  kFaultLatched = 14,  ///< Release enable, then give it again.
  kStopping = 15,  ///< The process was told to end.
  kPose = 16,  ///< Position, height, pitch of a dozer's body.
  kTransmission = 17,  ///< Displacements, track speeds.
  kNotCentred = 18,  ///< A spool is not in its middle: the machine is moved by hand.
  kValve = 19,  ///< Spools or cylinders do not do what they are told.
  kController = 20,  ///< The controller's own check has failed.
  kSensorError = 21,  ///< A sender calls its own value wrong.
  kTask = 22,  ///< The task that is chosen is not known.
  kStreamLate = 23,  ///< Frames that are old although they have just come.
  kSecondController = 24,  ///< Our own messages from elsewhere.
  kEngineStopped = 25,  ///< Below idle.
  kPath = 26,  ///< The tool has left its path, or does not get on.
};
inline constexpr int kArmBlockCount = 27;

/// Limits that hold lambda below 1.
enum class LimitKind : std::uint8_t {
  kNone = 0,
  kPumpFlow = 1,  ///< (29), (30): a pump cannot feed the in-flow.
  kBackFlow = 2,  ///< (36) with F_offset: the load would push back.
  kSpoolTravel = 3,  ///< (13): the spool is fully open.
  kStrokeEnd = 4,  ///< The cylinder nears its end.
  kRise = 5,  ///< Nothing but the rate at which lambda may rise.
  kDegraded = 6,  ///< A lost sensor: the field is slower.
  kImplementFlow = 7,  ///< (11): the blade cylinders' flow, as measured.
  kTransmissionFlow = 8,  ///< (13): a track's transmission.
  kAhead = 9,  ///< Braking for what the blade will need further on.
  kOffGrade = 10,  ///< The cutting edge is too far off the grade.
  kSwingEnd = 11,  ///< The swing nears the end of its range.
  kFence = 12,  ///< A point of the machine nears a plane.
  kOffPath = 13,  ///< The drives are behind the plan: its progress waits.
};
inline constexpr int kLimitKindCount = 14;  ///< With kNone.

}  // namespace graben
