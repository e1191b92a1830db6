// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements of this room: each value with its unit, why it is so, and what else was tried.

#include "firmware/core/time.hpp"

namespace graben {

// Inputs that every kind reads alike (common_inputs.cpp)

/// Share of its rated speed up to which an engine's measured speed is believed. [-; chosen: it runs
/// over it by a few per cent, downhill by some more; not tried]
inline constexpr double kEngineMostOverspeed = 1.2;
/// Share of idle below which an engine does not run by itself. [-; chosen: it is cranked, or
/// stalls; not tried]
inline constexpr double kRunningShare = 0.8;
/// Time for which the machine's identity counts. [s; chosen: it names itself every second, and may
/// miss one time; not tried]
inline constexpr double kIdentityTimeout_s = 2.5;
/// Time for which a machine stays slower once nothing is degraded any more. [s; chosen: a value
/// that comes and goes must not make it jerk; 0.5 tried before]
inline constexpr double kSlowAfter_s = 1.0;
/// Time for which the operator's lower speed counts before a higher one does. [s; chosen: a speed
/// that toggles must not make the machine jerk; not tried]
inline constexpr double kOverrideAfter_s = 0.2;

// A limit from outside (external_limit.cpp)

/// Longest time for which a word from outside holds. [s; derived: ExternalLimit.Deadline]
inline constexpr double kExternalMostDeadline_s = 1.0;
/// Rate at which the speed comes back once a limit is wider. [1/s; chosen: a machine that people
/// are near to does not jump; not tried]
inline constexpr double kExternalRise_ps = 1.0;

// Time of a cycle (cycle.cpp)

/// Longest period that a cycle reckons with. [s; chosen: a late cycle must not turn into one large
/// step of a rate limit; not tried]
inline constexpr double kLongestPeriod_s = 0.02;
/// Time after the last cycle from which one is late. [us; chosen: one and a half cycles; not tried]
inline constexpr TimeUs kCycleLate_us = 15 * kMillisecondUs;
/// Lateness that the bucket of late cycles holds before that is an overrun. [us; chosen: not
/// tried]
inline constexpr TimeUs kLateBucket_us = 60 * kMillisecondUs;
/// Part of the time that the bucket loses: one in so many. [-; chosen: up to a tenth of the time
/// may be late for ever; not tried]
inline constexpr std::int32_t kLateBucketLeak = 10;

// Pilot pressure after a stop (cycle.cpp)

/// Time after which the drives of a machine that a fault has stopped stand. [s; chosen: the slowest
/// spool closes within 0.3 s, a cylinder's oil rings down within 0.5 s; a platform that still turns
/// brakes against its reliefs with its spool closed; not tried]
inline constexpr double kDrivesStop_s = 1.0;

// A machine that hardly gets on (stall_watch.cpp)

/// Share of what is asked below which a machine hardly gets on. [-; chosen: not tried]
inline constexpr double kStallShare = 0.05;
/// Time for which a machine hardly gets on until it is said. [s; chosen: not tried]
inline constexpr double kStallSaid_s = 2.0;

// Two sensors of a joint (witness.cpp)

/// Frames of the second sensor in a row that are farther from the first than the band until the two
/// contradict each other. [-; chosen: one alone may be a disturbance; not tried]
inline constexpr int kWitnessApart = 2;
/// Share of the difference of two sensors that a frame brings, out of motion. [-; chosen: noise of
/// some five frames is taken out; not tried]
inline constexpr double kWitnessLearns = 0.2;
/// Age that is not known of a reading beside what the profile says: frames come anywhere within a
/// cycle. [s; derived: half a control period of 10 ms]
inline constexpr double kWitnessPhase_s = 0.005;

// A change of task in motion (task_change.cpp)

/// Time for which the machine is still, and the same task asked for, before it begins. [s; chosen:
/// not tried]
inline constexpr double kStandstill_s = 0.2;
/// Travel up to which a drive is still. [m; chosen: more than what soil, and a linkage that rings
/// down, make it give on its oil; not tried]
inline constexpr double kStandstill_m = 0.01;

// The tool at its mark (mark_check.cpp)

/// Time for which a touch counts as said. [s; derived: three periods of TouchedPoint]
inline constexpr double kTouchHolds_s = 0.3;
/// Time for which the tool is still before a touch is taken. [s; chosen: oil rings down; not tried]
inline constexpr double kMarkRest_s = 0.5;
/// Way up to which the tool is still. [m; chosen: a stroke's noise, times the links; not tried]
inline constexpr double kMarkRest_m = 0.005;
/// Checks that are counted. [-; size: EcuChecks.Checks]
inline constexpr int kMostMarkChecks = 250;

}  // namespace graben
