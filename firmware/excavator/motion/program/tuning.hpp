// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about programs, their plans and how they are followed: each was chosen.

namespace graben {

// What is planned (line_plan.cpp, drive_plan.cpp, task_program.cpp)

/// Way of a line, see way_m(), below which it is none. [m; chosen: rounding; not tried]
inline constexpr double kLineWayLeast_m = 1e-6;
/// Change of a drive below which a move leaves it alone, of the swing as many rad. [m; chosen:
/// rounding; not tried]
inline constexpr double kDriveChangeLeast = 1e-9;
/// Error of a normal's length, which has to be 1. [-; chosen: rounding; not tried]
inline constexpr double kNormalLengthOff = 1e-6;
/// Upward part of a design's normal below which it is refused: raising a dig straight up would lead
/// too far. [-; chosen: not tried]
inline constexpr double kDesignUpLeast = 0.2;
/// Distance of two places of the teeth that count as the same. [m; chosen: rounding; not tried]
inline constexpr double kSamePose_m = 1e-6;
/// Difference of two attitudes or swings that count as the same. [rad; chosen: rounding; not tried]
inline constexpr double kSamePose_rad = 1e-6;
/// Level way that a dig needs to tell a full bucket by what its edge has passed. [m; chosen: not
/// tried]
inline constexpr double kFillLevelWay_m = 0.3;
/// Way by which a range or a fence may be passed, of the swing as many rad: a pose may stand on it.
/// [m; chosen: rounding; not tried]
inline constexpr double kBarTolerance = 1e-6;

// The way to a program's first pose (approach.cpp)

/// Height above the first pose that an approach comes to; half of it where that is barred. [m;
/// chosen: not tried]
inline constexpr double kApproachLift_m = 0.8;
/// Distance of the teeth from the first pose below which they go there at once. [m; chosen: not
/// tried]
inline constexpr double kApproachNear_m = 0.3;
/// Share of the drives' limits that the approach keeps to. [-; chosen: not tried]
inline constexpr double kApproachPace = 0.3;
/// Share of a cylinder's stroke that counts as out, or folded in. [-; chosen: clear of its end; not
/// tried]
inline constexpr double kApproachNearlyOut = 0.92;
/// Share of the boom's stroke that counts as half way up. [-; chosen: the middle; not tried]
inline constexpr double kApproachHalfOut = 0.5;
/// Distance from a keep-out beyond which it need not be exact. [m; chosen: more than any margin and
/// what a point goes between two poses; not tried]
inline constexpr double kApproachFar_m = 0.6;
/// Closing over a whole leg up to which it leads away. [m; chosen: rounding; not tried]
inline constexpr double kApproachLeaves_m = 1e-6;

// Arriving at the end of a step (task_run.cpp, dig_move.cpp)

/// Distance of the teeth from a line's end at which they have arrived. [m; chosen: not tried]
inline constexpr double kSettled_m = 5e-3;
/// The same of a move, or the approach, that a line follows: it begins where the move ends. [m;
/// chosen: not tried]
inline constexpr double kLineBegins_m = 0.01;
/// The same of any other move. [m; chosen: not tried]
inline constexpr double kMoveArrived_m = 0.02;
/// Time that the teeth have to stay so near: a platform that swings through its place is not there
/// yet. [s; chosen: not tried]
inline constexpr double kCalm_s = 0.2;
/// Time that a step's end is waited for. Then a step within kMissedMost_m goes on and counts as
/// missed: the next one corrects what is left, its way was looked at from that end, and fences hold
/// in motion. [s; chosen: 2 was tried, steps ended up to 67 mm off]
inline constexpr double kArriveMost_s = 10.0;
/// Distance up to which a late step goes on. One that is farther off does not, for the next may
/// rely on it as a swing on the lift before it: it waits until the stall watch stops the machine.
/// [m; chosen: not tried]
inline constexpr double kMissedMost_m = 0.03;
/// Distance at which a move of a program in layers has arrived: the next leads on from wherever it
/// ends. [m; chosen: 0.03 was tried]
inline constexpr double kMoveSettled_m = 0.05;
/// Time after which such a move goes on wherever it is. [s; chosen: 1.5 was tried, for all steps]
inline constexpr double kSettleMost_s = 2.0;

// Following a program (task_follow.cpp)

/// Planned speed of the teeth below which all of their error counts as behind. [m/s; chosen: not
/// tried]
inline constexpr double kTeethStand_mps = 0.02;
/// Share of the fastest drive's speed below which a move leaves a drive to its corrections: its
/// load would hold up all others. [-; chosen: not tried]
inline constexpr double kMoveTrifle = 1e-3;
/// Distance of the teeth from where a wait left them up to which the task goes on; from elsewhere
/// it begins anew. [m; chosen: the operator may move the machine a little meanwhile; not tried]
inline constexpr double kWaitStillThere_m = 0.1;

// Steps that end early, and rounds (step_run.cpp, task_run.cpp)

/// Rate at which a step that its `until` ends comes to rest, in rates of its pace. [-; chosen: not
/// tried]
inline constexpr double kStepBrakes = 4.0;
/// Time that a force has to be there to end a step. [s; chosen: not tried]
inline constexpr double kStepForceHolds_s = 0.2;
/// Distance of drives, m and rad alike, up to which a step begins where it was planned to. [-;
/// chosen: not tried]
inline constexpr double kStepSamePlace = 1e-4;
/// Rounds in a row that are done again no deeper, because force or a full bucket ended their dig;
/// then what is left stays up. [-; chosen: not tried]
inline constexpr int kAgainMost = 8;

}  // namespace graben
