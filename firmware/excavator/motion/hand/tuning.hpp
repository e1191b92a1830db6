// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about motion by the operator's levers: each was chosen.

namespace graben {

/// Acceleration of teeth that the operator steers, in accelerations of a line. [-; chosen: not
/// tried]
inline constexpr double kHandBrisk = 4.0;
/// Time from rest until the attitude turns at its fastest. [s; chosen: not tried]
inline constexpr double kHandAttitudeRise_s = 0.6;
/// Time ahead at which there has to be a pose: else the teeth stop. [s; chosen: not tried]
inline constexpr double kHandAhead_s = 0.05;
/// Distance from a cylinder's end at which a line ends. [m; chosen: nearer, cushions bend it; not
/// tried]
inline constexpr double kLineEnds_m = 0.05;

/// Fastest that Assist draws the edge along a design. [m/s; measured: `campaign assist`: at 0.8 a
/// third of the lever is capped, and the largest error falls by 2 mm of 30]
inline constexpr double kAssistFastest_mps = 1.5;
/// Factor on assist.window where the edge is in it already. [-; chosen: not tried]
inline constexpr double kAssistKeeps = 1.2;
/// Way along the design on which the distance to it falls to a third. [m; measured: `campaign
/// assist`: at 0.5 the largest error rises by 3 mm of 30]
inline constexpr double kAssistOnto_m = 0.2;
/// Steepest way onto it. [-; chosen: not tried]
inline constexpr double kAssistSteepest = 0.5;
/// Rate at which its acceleration grows with its speed, from that of a line. [1/s; measured:
/// `campaign assist`: at once 1 m/s2, a boom that moves before the arm does lifts the edge by 57 mm
/// instead of 37; at 3, by 50]
inline constexpr double kAssistGrows_ps = 1.5;
/// Periods of the slower mode of boom and arm on their oil in which the edge stops once the arm's
/// lever rests. [-; measured: `campaign assist --surfaces`: the edge is within 15 mm of where it
/// comes to rest after 0.18 s (p95, 22 t), after 0.41 s at 1; two steps half a period apart, which
/// leave this mode at rest, make the next one ring: 0.28 s]
inline constexpr double kAssistStopPeriods = 0.5;
/// Most speed that it loses in a radian of that mode. [m/s; measured: `campaign assist --surfaces`:
/// without it the boom rings by more than 15 mm for up to 1.4 s after the fastest ways down a
/// slope]
inline constexpr double kAssistStop_mps = 0.2;
/// Longest stop; so it is where the mode is not known. [s; chosen: not tried]
inline constexpr double kAssistStopMost_s = 0.3;
/// Distance off its line at which it goes half as fast. [m; measured: `campaign assist`: at 0.008
/// the way takes 1.9 times as long as the flow allows, at 0.025 the largest error is 6 mm of 30
/// more]
inline constexpr double kAssistSlow_m = 0.015;
/// Rate at which it speeds up again after that; it slows at once. [1/s; chosen: not tried]
inline constexpr double kAssistPace_ps = 3.0;
/// Distance under the design at which its fence stands while Assist holds the edge on it. [m;
/// measured: `campaign assist`: at 0.03 it held corrections back, and the boom swung by 0.1 m
/// at 2.4 Hz; at 1 the deepest cut was 97 mm instead of 55]
inline constexpr double kAssistFence_m = 0.3;
/// Way along a surface before and behind a place over which its slope is taken there: half of what
/// a kink is rounded over. [m; chosen: as design.rounding's own value; not tried]
inline constexpr double kAssistKink_m = 0.05;
/// Places of a surface that are looked at ahead, kAssistKink_m twice apart. [-; size: the way to
/// rest from some 1.2 m/s]
inline constexpr int kAssistAheadSteps = 8;
/// Deceleration before a kink or the border. [m/s2; chosen: as that of a line; not tried]
inline constexpr double kAssistBrakes_mps2 = 1.0;
/// Acceleration across the design with which the edge is led round a kink. [m/s2; chosen: not
/// tried]
inline constexpr double kAssistTurns_mps2 = 1.0;
/// Least share by which a turn's tangent is divided: from about 84 deg on it is as sharp as that.
/// [-; chosen: not tried]
inline constexpr double kAssistSteepKink = 0.1;
/// Turn of the design below which it has no kink. [rad; chosen: above what heights are
/// rounded by; not tried]
inline constexpr double kAssistStraight_rad = 0.02;

}  // namespace graben
