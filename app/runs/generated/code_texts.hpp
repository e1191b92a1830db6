// Generated from firmware/safety/faults.toml and limits.toml by can_dbc/generate_all.py.
// clang-format off
#pragma once
/// Texts of faults, arm conditions and limits, by their numbers.

#include <array>

namespace graben::runs {

struct FaultText {
  const char* text;
  const char* help;  ///< What to do.
};

enum class LimitOf { kNothing, kPump, kDrive, kFault, kTrack, kFence };

struct LimitText {
  const char* text;
  LimitOf of;  ///< Whose number the limit's index is.
};

inline constexpr std::array<FaultText, 38> kFaultTexts{{
    {"none", ""},
    {"a stroke is missing",
     "Check the stroke sensors, their cables and the machine's node."},
    {"a pressure is missing",
     "Work on slowly, or stop and check the pressure sensors and their cables."},
    {"a pump's swash is missing",
     "Check the swash sensors and the machine's node."},
    {"the engine's speed is missing",
     "Work on slowly; check that the engine sends EEC1."},
    {"the operator's frames are missing",
     "Check the operator's station and its cable."},
    {"a stroke lies outside its cylinder",
     "Calibrate the stroke sensor; compare the stroke with the profile."},
    {"the pose cannot be reached",
     "Move the machine by hand away from the end of its linkage; compare strokes and profile."},
    {"the valve's equations were not solved",
     "Release enable and give it again; if it comes back, keep the log and report it."},
    {"a command is not a number",
     "Do not use the controller; keep the log and report it."},
    {"a control cycle stalled",
     "Check what else runs on the ECU, and its real-time settings."},
    {"the machine has another profile or DBC",
     "Give controller and machine the same profile and DBC version."},
    {"bus-off",
     "Check wiring, termination and bit rate of the bus."},
    {"the bus is error-passive: nobody acknowledges",
     "Check the bus: a plug, the other nodes' supply."},
    {"the bus is down",
     "Check the CAN interface of the ECU."},
    {"the bus does not take frames",
     "Check the load of the bus and its wiring."},
    {"two control cycles in a row were late",
     "Check what else runs on the ECU, and its real-time settings."},
    {"wrong CRCs of a message",
     "Check wiring and termination; look for a node that sends our ids."},
    {"a message out of sequence",
     "Look for a second sender, a gateway that repeats frames, or an overloaded bus."},
    {"a message under another one's id",
     "Look for a node that sends under another one's id."},
    {"the valve's feedback is missing",
     "Check the valve driver and its cable."},
    {"a spool does not obey",
     "Keep clear. Lower the tool by hand, stop the engine, check the spool for dirt."},
    {"a cylinder moves uncommanded",
     "Keep clear. Stop the engine; check the valve, hoses and load-holding valves."},
    {"a stroke stands still under flow",
     "Check the stroke sensor; check whether the tool is blocked or the oil is shut off."},
    {"a stroke jumps",
     "Check the stroke sensor, its mounting and its cable."},
    {"a pressure is stuck or at its rail",
     "Work on slowly, or stop and check the pressure sensors."},
    {"a pump's swash is not as commanded",
     "Work on slowly; check the pump's regulator and its pilot pressure."},
    {"a stored setpoint has changed",
     "Restart the controller; if it comes back, replace the ECU."},
    {"the valve does not confirm enable",
     "Keep clear. Check the valve driver: it does not act on enable."},
    {"a value is out of its range",
     "Check which node sends a value outside its range: profile, sensor or DBC."},
    {"a sensor calls itself wrong",
     "Check the sensor whose value is 'error'."},
    {"the body's pose is missing",
     "Check the positioning system and the inclination sensor."},
    {"the body's pose jumps or cannot be",
     "Check the positioning system's reception and the inclination sensor."},
    {"the transmission's feedback is missing",
     "Check the displacement and track speed sensors."},
    {"a displacement does not obey",
     "Stop the engine; check the transmission's pilot pressure and servo."},
    {"a displacement runs away",
     "Keep clear. Stop the engine; check the transmission's servo."},
    {"a track's speed is not that of its displacements",
     "Work on slowly; check the track speed sensors and for slip."},
    {"unknown task number",
     "Choose a task that the controller was started with."},
}};

inline constexpr std::array<const char*, 23> kArmBlockTexts{{
    "a stroke is missing or cannot be",
    "a pressure is missing or cannot be",
    "a pump's swash is missing or not as commanded",
    "the engine's speed is missing",
    "the operator's frames are missing",
    "the valve's feedback is missing",
    "the machine has another profile or DBC, or does not say",
    "the bus is not active, or does not take the controller's frames",
    "messages with wrong CRCs, out of sequence or with values out of range",
    "the strokes give no pose",
    "control cycles are late",
    "the operator drives by hand",
    "a task is chosen already: first none, then the task",
    "enable is not given, or was not released before",
    "a fault is latched: release enable, then give it again",
    "the controller was told to end",
    "the body's pose is missing or cannot be",
    "the transmission's feedback is missing or not as commanded",
    "a spool is not in its middle: release the levers",
    "the valve does not do as it is told",
    "the controller's own check has failed",
    "a sensor reports an error of its own",
    "unknown task number",
}};

inline constexpr std::array<LimitText, 14> kLimitTexts{{
    {"none", LimitOf::kNothing},
    {"pump flow", LimitOf::kPump},
    {"back flow", LimitOf::kDrive},
    {"spool travel", LimitOf::kDrive},
    {"stroke end", LimitOf::kDrive},
    {"rise of lambda", LimitOf::kNothing},
    {"slowed", LimitOf::kFault},
    {"implement flow", LimitOf::kNothing},
    {"transmission flow", LimitOf::kTrack},
    {"what lies ahead", LimitOf::kNothing},
    {"off the grade", LimitOf::kNothing},
    {"swing end", LimitOf::kNothing},
    {"fence", LimitOf::kFence},
    {"behind the plan", LimitOf::kNothing},
}};

}  // namespace graben::runs
