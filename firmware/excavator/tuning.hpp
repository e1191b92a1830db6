// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about the excavator's drives: each was chosen, none follows from the machine.

namespace graben {

// Strokes against what their oil can have done (excavator_drives.cpp)

/// Error of the tip beyond which the stroke behind it counts as wrong. [m; chosen: not tried]
inline constexpr double kStrokeOffTip_m = 0.08;
/// Bound of a stroke's error from below, whatever the tip makes of it: oil, dead bands and noise
/// put a healthy stroke so far off. [m; chosen: not tried]
inline constexpr double kStrokeOffLeast_m = 0.008;
/// Bound of a stroke's error from above, where it moves the tip little. [m; chosen: not tried]
inline constexpr double kStrokeOffMost_m = 0.010;
/// Allowance for strokes by angles that are foretold over 20 ms. [m; chosen: an arm in hard ground
/// shakes by 4 mrad at 15 Hz, which is foretold 10 mm to and fro; without it, digs in loam were
/// tried and ended in faults 1 or 42 by sensors that were right]
inline constexpr double kForetoldShaken_m = 0.015;
/// Way of a cylinder against its open spool that is a wrong direction. [m; chosen: more than the
/// oil of its hoses gives; not tried]
inline constexpr double kStrokeWrong_m = 0.012;
/// Share of the allowed error at which a stroke that stands still while its oil moves is told.
/// [-; chosen: not tried]
inline constexpr double kStrokeUnseenShare = 0.3;

/// Way of the tip by which a cylinder may be off from what was asked. [m; chosen: healthy ones stay
/// within 0.14 at all speeds in 60 draws with `lie_cases`, but an arm in soil; 0.20 tried]
inline constexpr double kStrokeWayTip_m = 0.16;
/// Bounds of that as a stroke, from below ... [m; chosen: 0.025 tried, 1 of 40 slow draws in soil
/// stops]
inline constexpr double kStrokeWayLeast_m = 0.035;
/// ... and from above. [m; chosen: the same; not tried]
inline constexpr double kStrokeWayMost_m = 0.08;

// Drives that the oil's law can lead (excavator_drives.cpp, outputs.cpp)

/// Dead time beyond which boom or arm goes by the servo. [s; chosen: the oil's law was tried with
/// 150 ms and did not help]
inline constexpr double kOilDeadTimeMost_s = 0.05;
/// Lag beyond which boom or arm goes by the servo. [s; chosen: not tried]
inline constexpr double kOilLagMost_s = 0.1;
/// Time constant beyond which a spool is not led, and its drive goes by the servo. [s; chosen: not
/// tried]
inline constexpr double kLedSpoolMost_s = 0.045;

// The servo where no pressure is measured (excavator_drives.cpp). It leads alone then, and its
// low-pass has to lie below the lowest mode of the softest oil, 0.6 GPa instead of 1.4.

/// Factor on the servo's gain without pressures. [-; chosen: 1 for all three was tried, 31 of 200
/// machines of 22 t rang at 2 Hz; limit cycles of 40 to 70 mm]
inline constexpr double kGainWithoutPressures = 0.75;
/// Factor on its frequency; a mode falls with the root of 0.6 / 1.4. [-; chosen: tried with
/// kGainWithoutPressures]
inline constexpr double kFrequencyWithoutPressures = 0.67;
/// Factor on its damping. [-; chosen: tried with kGainWithoutPressures]
inline constexpr double kDampingWithoutPressures = 0.75;

// Watches of the swing (swing.cpp)

/// Step of the angle in one frame that noise and lost frames explain. [rad; chosen: 0.1 m at teeth
/// 7 m away; not tried]
inline constexpr double kSwingJumpMargin_rad = 0.015;
/// Way of a platform that nobody asks to turn from which it is seen to. [rad; chosen: 2 degrees;
/// not tried]
inline constexpr double kSwingRest_rad = 0.035;
/// Way of the platform against its open spool that is a wrong direction. [rad; chosen: 20 mm at
/// teeth 7 m away; not tried]
inline constexpr double kSwingWrong_rad = 0.003;
/// Way by its oil at which an angle that stands still is told. [rad; chosen: 0.07 m at teeth 7 m
/// away; not tried]
inline constexpr double kSwingUnseen_rad = 0.010;
/// Error of the angle against what its oil can have done. [rad; chosen: 0.10 m at teeth 7 m away;
/// not tried]
inline constexpr double kSwingOff_rad = 0.015;
/// Speed below which the platform stands. [rad/s; chosen: 10 mm/s at teeth 7 m away; not tried]
inline constexpr double kSwingStill_radps = 0.0015;
/// Share of its full speed that a worn motor leaks at the sensors' largest pressure. [-; chosen:
/// not tried]
inline constexpr double kSwingLeakShare = 0.10;
/// Slack before the swing's ends. [rad; chosen: 0.2 mm at teeth 10 m away; not tried]
inline constexpr double kSwingEndSlack_rad = 0.02e-3;

// Damping of the platform by what pushes it (swing.cpp)

/// Low-pass of the push that is damped. [s; chosen: less than the period of the platform on its
/// oil; not tried]
inline constexpr double kSwingPushFast_s = 0.02;
/// Low-pass of the push that stays: friction, slope, the sensors' zeros. [s; chosen: more than that
/// period; not tried]
inline constexpr double kSwingPushSlow_s = 2.0;
/// Pressure that friction takes, whichever way the platform turns: it is not damped. [Pa; chosen:
/// 1.0e6 was tried]
inline constexpr double kSwingFriction_pa = 1.4e6;
/// Bound of the acceleration that is damped, in accelerations of the plan. [-; chosen: not tried]
inline constexpr double kSwingDampsMost = 2.0;

}  // namespace graben
