// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about the excavator's validation and watches: each was chosen.

namespace graben {

/// Time that a window of strokes counts: those of all drives come by turns. [s; chosen: not tried]
inline constexpr double kWindowHolds_s = 1.0;
/// Drives that duties may be tried on at once. [-; chosen: not tried]
inline constexpr int kTriedMost = 2;
/// Time that a swash may be off what was commanded: its servo takes time. [s; chosen: not tried]
inline constexpr double kSwashServo_s = 0.5;
/// Lag of the slowest pump that counts as sound. [s; chosen: not tried]
inline constexpr double kSwashLag_s = 0.25;

// Supply of drives (supply_watch.cpp)

/// Time that a drive stands open and unfed until its pump gives nothing. [s; chosen: a line fills
/// sooner, an engine takes longer to start; not tried]
inline constexpr double kSupplyStarved_s = 0.3;
/// Travel beyond the dead band's end from which a spool is open. [-; chosen: over
/// kLearntEdgeSpread; not tried]
inline constexpr double kSupplyOpenBeyond = 0.05;
/// Share of the asked speed below which a drive stands. [-; chosen: not tried]
inline constexpr double kSupplyStandsShare = 0.3;
/// Share of it below which a drive whose side has no pressure is unfed. [-; chosen: one that goes
/// on at all is fed, if by less than its valve's model says; 0.3 tried, 2 of 5200 sound draws on
/// the 12 t were stopped at 0.18 and 0.33 of what was asked]
inline constexpr double kSupplyStarvedShare = 0.1;
/// Asked speed from which a drive is looked at. [m/s; chosen: not tried]
inline constexpr double kSupplyLeastAsked_mps = 0.004;
/// Pressure below which a side has none. [Pa; chosen: not tried]
inline constexpr double kSupplyNone_pa = 0.5e6;
/// Way that a drive is behind, all others that are asked standing too, from which their pumps give
/// nothing. [m; measured: 15 mm in soil at a tenth of the speed, 8 at 0.3 of it, 4 else: `campaign
/// dig --draws 8 --errors all --soil --speed 0.1`; an engine that stands shows 35 to 90]
inline constexpr double kSupplyUnmoved_m = 0.025;
/// Low-pass of a drive's speed. [s; chosen: noise of a stroke is far below kSupplyLeastAsked_mps;
/// not tried]
inline constexpr double kSupplySpeed_s = 0.1;

// Second sensors of joints (second_sensors.cpp)

/// Silence of SecondStrokes after which it is missing. [s; chosen: four of its frames and some
/// delay; not tried]
inline constexpr double kSecondStrokeSilent_s = 0.09;
/// The same of SecondSwing. [s; chosen: three of its frames and some delay; not tried]
inline constexpr double kSecondSwingSilent_s = 0.16;

}  // namespace graben
