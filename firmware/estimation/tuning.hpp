// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers that were chosen for the angles of bodies, each with why: angles that come late, and
/// angles by gyro and accelerometer.

#include <cstddef>

#include "firmware/core/time.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {

// Foretold angles (foretold_angle.cpp)

/// Readings that a late angle's rate is taken over. [-; chosen: over two a sensor's resolution
/// counts half as much as over one; others not tried]
inline constexpr std::size_t kForetoldReadings = 2;
/// Longest time between readings that still give a rate. [us; chosen: farther apart they say
/// nothing of it; not tried]
inline constexpr TimeUs kForetoldLongest_us = 50 * kMillisecondUs;

// Angle by gyro and accelerometer (link_angle.cpp)

/// Specific force below which it has no direction worth using: free fall. [m/s2; chosen: 0.3 of
/// gravity; not tried]
inline constexpr double kAngleLeastForce_mps2 = 0.3 * kStandardGravity_mps2;
/// Deviation that a gyro's bias wanders in 1 s, growing with the root of time. [rad/s; chosen: 0.02
/// deg/s in 100 s; not tried]
inline constexpr double kGyroBiasWander = 3.5e-5;
/// Share of a link's own computed acceleration that may be wrong. [-; chosen: pins have play and
/// links bend; not tried]
inline constexpr double kLinkAccelerationOff = 0.1;
/// Weight of an unexpected size of the force in the check for contradictions. [-; chosen: repeated
/// hits turn the mean force to one side; tried 0, runs in loam ended by right sensors]
inline constexpr double kAngleHitWeight = 4.0;
/// Least weight of a reading in the check for contradictions. [-; chosen: an axis that is off for
/// good is told within seconds amid hits too; tried 0, it was not]
inline constexpr double kAngleLeastWeight = 0.05;
/// Gyro rate at rest above which it is no bias, in standard deviations. [-; chosen: whatever the
/// caller takes for rest; not tried]
inline constexpr double kRestMostDeviations = 4.0;
/// Time constant of the low-pass before gyro and gravity count as contradicting. [s; chosen: long
/// enough to average vibration out; tried 2 s, with 0.1 rad]
inline constexpr double kAngleOffTime_s = 1.0;
/// Time over which the sway of a force's direction is looked at. [s; chosen: that of the tracks at
/// 2 Hz hardly shows in its mean; 1 s tried, what is longer comes late]
inline constexpr double kAngleSwayTime_s = 0.3;
/// One reading's square counts as no more than this many of its mean. [-; derived: a sine's peak;
/// with a third of all readings hit it stays]
inline constexpr double kAngleSwayMost = 2.0;
/// Square of a hit over that mean from which it is a blow and tells less. [-; chosen: two
/// deviations; not tried]
inline constexpr double kAngleBlow = 4.0;
/// Mean angle between gyro and gravity from which they contradict each other. [rad; chosen: 3 deg
/// is no bias; tried 0.1]
inline constexpr double kAngleContradicts_rad = 0.05;
/// Distance of a sensor from its link's pin from which its force tells of its gyro. [m; chosen:
/// nearer, noise of the force is as much as a gyro's jump; 0.3 tried, a bucket dug in air came to
/// its bound]
inline constexpr double kGyroLeastLever_m = 1.0;
/// Time constant of the force that stays, an accelerometer's offset. [s; chosen: 1.0 tried, a
/// bucket came 0.28 m off by a gyro that jumped]
inline constexpr double kGyroSteadyTime_s = 4.0;
/// Time constant with which what a gyro has jumped is forgotten. [s; chosen: not tried]
inline constexpr double kGyroJumpTime_s = 0.2;
/// Time constant of the low-pass of that. [s; chosen: hits in soil shake a link faster; tried
/// without]
inline constexpr double kGyroShakeTime_s = 0.05;
/// Time constant of the mean square of a force that its gyro does not explain. [s; chosen: not
/// tried]
inline constexpr double kGyroShakenTime_s = 0.5;
/// Most of a reading in it, in mean squares: it has to go on. [-; chosen: three deviations; not
/// tried]
inline constexpr double kGyroShakenMost = 9.0;
/// Change of a gyro's rate that its force does not explain, from which one of them is wrong.
/// [rad/s; chosen: 2 deg/s; not tried]
inline constexpr double kGyroJump_radps = 0.035;
/// Least of that in deviations of what the force's noise makes of it. [-; chosen: not tried]
inline constexpr double kGyroJumpDeviations = 5.0;
/// How long a jump counts after it was last seen: until then the gyro's own angle against gravity
/// shows whether it still is off. [s; chosen: at 4 deg/s 20 deg, seven times what contradicts; 0
/// tried, a machine was armed again beside a gyro that still was off in 9 of 20 seeds]
inline constexpr double kGyroJumpHeld_s = 5.0;

}  // namespace graben
