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

// Second sensors of joints (second_sensors.cpp)

/// Silence of SecondStrokes after which it is missing. [s; chosen: four of its frames and some
/// delay; not tried]
inline constexpr double kSecondStrokeSilent_s = 0.09;
/// The same of SecondSwing. [s; chosen: three of its frames and some delay; not tried]
inline constexpr double kSecondSwingSilent_s = 0.16;

}  // namespace graben
