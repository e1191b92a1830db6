// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about the limits on a motion: each was chosen.

namespace graben {

// Corrections (limits.cpp)

/// Share of a move that its corrections must leave to be kept: with less the move goes on without
/// them. [-; chosen: a small correction that needs more pressure than its pump has would never be
/// made, and no line is off in a move; not tried]
inline constexpr double kMoveHeldUp = 0.3;

/// Share of their corrections that the other drives keep while a blocked one lets its oil off or
/// rests. [-; measured: `campaign dig --obstacle --draws 20`, rocks that hold for 2 to 4.2 s:
/// largest error 28 / 30 mm in the median of the 22 t and 12 t machine, without any 59 / 76; 1.0:
/// single draws at 128 and 168]
inline constexpr double kEasedCorrects = 0.5;
/// Rest of a blocked drive after which the others correct less. [s; measured: `campaign dig
/// --obstacle --draws 20`, rocks that hold for 2 to 4.2 s: direction after them 26 / 25 deg p95,
/// 22 t and 12 t; from 0 on 41 / 51, with corrections for the whole rest 66 / 80]
inline constexpr double kEasedStillFrom_s = 0.5;
/// Time in which they then fade out. [s; measured: `campaign dig --obstacle --draws 20`, the same
/// rocks: 26 / 25 deg; 0.3 s 27 / 28]
inline constexpr double kEasedStills_s = 0.6;
/// Factor on control.lambda_rise_reserve while Assist holds the edge on its design. [-; measured:
/// `campaign assist`: at 1 lambda follows the boom's ringing pressure, and the 12 t machine's boom
/// swings: RMSE (p95) 14.3 mm instead of 11.1; at 3 10.7, but a third of the lever takes 6 %
/// longer]
inline constexpr double kAssistReserve = 2.0;
/// Speed of a path from which on spools park as they do on a fast one. [m/s; chosen: what the
/// parking was chosen at; not tried]
inline constexpr double kParkingPath_mps = 0.5;

// Fences (motion_cap.hpp)

/// Way by which a fence stands behind what it guards. At the place itself the machine may still
/// close at stroke_end_gain times it, which is what makes sliding along a fence possible, see
/// approach_ends(): a feedback weaker than stroke_end_gain towards a plan that is not beyond the
/// fence is never slowed. [m; chosen: a part of the millimetre by which a limit may be overrun; not
/// tried]
inline constexpr double kFenceSlack_m = 0.2e-3;
/// Time for which the platform goes on at what it turns faster than asked: it is heavy, its oil
/// soft. [s; chosen: it lags 0.15 to 0.4 s behind its spool; 0.3 was tried]
inline constexpr double kPlatformLag_s = 0.4;

}  // namespace graben
