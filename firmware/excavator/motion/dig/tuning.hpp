// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements of digging in layers. Each says its unit, who chose it, and what else was tried.

#include <array>
#include <cstdint>

namespace graben {

// Ledger of cuts (dig_layers.cpp). Lengths named _share are shares of the bucket, teeth to pin
// (LayerPlan::bucket_m).
/// Least depth of a cut. [-; chosen: 0.06 m on the 12 t; not tried otherwise]
inline constexpr double kDepthLeast_share = 0.05;
/// Share of the line on which an even cut fills the bucket. [-; chosen: not tried otherwise]
inline constexpr double kFullAt = 0.8;
/// Height over all soil that the edge comes down to a cut from. [-; chosen: 0.25 m on the 12 t; not
/// tried otherwise]
inline constexpr double kEntersOver_share = 0.2;
/// Most that a bucket is let take, of what fills it, where that saves a round. [-; chosen: not
/// tried otherwise]
inline constexpr double kOverfill = 1.25;
/// Thickest last layer that a saved round may leave. [-; chosen: 0.085 m on the 12 t; not tried
/// otherwise]
inline constexpr double kSparedAt_share = 0.07;
/// Way before standing soil on which a cut begins, where there is room. [-; chosen: 0.25 m on the
/// 12 t; not tried otherwise]
inline constexpr double kRunUp_share = 0.2;
/// Depth of a cut through what stands out of its strip, of its usual depth. [-; chosen: not tried
/// otherwise]
inline constexpr double kBump = 1.5;
/// Mean heaviness of a cut over which the next is less deep. [-; chosen: not tried otherwise]
inline constexpr double kCutHeavy = 0.9;
/// Mean heaviness of a cut under which the next is deeper. [-; chosen: not tried otherwise]
inline constexpr double kCutLight = 0.5;
/// Depth after a light cut, of the depth before. [-; chosen: not tried otherwise]
inline constexpr double kDeeper = 1.15;
/// Depth after a heavy cut, of the depth before. [-; chosen: not tried otherwise]
inline constexpr double kShallower = 0.75;
/// Share of what a cut was to get under which it has given way and was too deep. [-; chosen: not
/// tried otherwise]
inline constexpr double kGaveWay = 0.5;
/// Depth, of the least, from which on more force is used in the place of less depth. [-; chosen:
/// not tried otherwise]
inline constexpr double kHarderFrom = 2.0;
/// Force that the next cut gives way to then, of that before. [-; chosen: not tried otherwise]
inline constexpr double kHarder = 1.25;
/// Most share of the cylinders' holding force that a cut takes so. [-; chosen: not tried otherwise]
inline constexpr double kForceMost = 0.8;
/// Share of the line that such a cut has gone: one that stands before says nothing of its depth.
/// [-; chosen: not tried otherwise]
inline constexpr double kGaveWayFrom = 0.5;
/// Least depth after such a cut, of the depth before. [-; chosen: not tried otherwise]
inline constexpr double kShallowest = 0.4;
/// Share of a full bucket under which a cut got next to nothing. [-; chosen: not tried otherwise]
inline constexpr double kLittle = 0.1;
/// Weight over that of the passed soil that tells of soil fallen in, of a full bucket. [-; derived:
/// three standard deviations of the payload estimate]
inline constexpr double kFallen = 0.05;
/// Error of the volume that an edge has passed, of itself. [-; chosen: not tried otherwise]
inline constexpr double kPassedOff = 0.15;
/// Weight of a sweep that tells of soil fallen in: it also brings the loose rest before it. [-;
/// chosen: not tried otherwise]
inline constexpr double kFallenToSweep = 0.15;
/// Share of a full bucket in one last cut that moves the soil beside it: it is swept after. [-;
/// chosen: not tried otherwise]
inline constexpr double kMovesSoil = 0.4;
/// Share of the line past a stopped cut that it still tells of. [-; chosen: not tried otherwise]
inline constexpr double kPastStop = 0.15;
/// Share of a full bucket that tells of a wall falling in at the line's beginning. [-; chosen: not
/// tried otherwise]
inline constexpr double kWallFalls = 0.55;
/// Sweeps of a strip after which its wall counts as falling in. [-; chosen: not tried otherwise]
inline constexpr std::uint8_t kWallSweeps = 2;
/// Fill from which a weighed bucket tells how much of the passed soil it keeps. [-; chosen: not
/// tried otherwise]
inline constexpr double kTells = 0.6;
/// Weight of one weighed round in that estimate. [-; chosen: not tried otherwise]
inline constexpr double kBelieved = 0.4;
/// Least share of the passed soil that is believed to be kept. [-; chosen: not tried otherwise]
inline constexpr double kYieldsLeast = 0.75;
/// Most share of the passed soil that can be kept. [-; derived: what is kept was passed]
inline constexpr double kYieldsMost = 1.0;
/// Soil over a cut that counts as left. [m; chosen: not tried otherwise]
inline constexpr double kRough_m = 0.03;
/// Soil over the design that counts as left. [m; chosen: well inside 30 mm, what sites ask for; not
/// tried otherwise]
inline constexpr double kFinish_m = 0.018;
/// The same at the design's end, where soil piles up before the wall that stays. [m; chosen: not
/// tried otherwise]
inline constexpr double kEnd_m = 0.035;
/// More than that in one place of a strip is let be. [m; chosen: not tried otherwise]
inline constexpr double kOnePlace_m = 0.008;
/// Height that the last cut keeps where its bucket is still steep. [m; chosen: not tried otherwise]
inline constexpr double kSteepHigher_m = 0.006;
/// Thickness of the last layer: its force is small, and so is what the teeth spring by. [-; chosen:
/// 0.06 m on the 12 t; not tried otherwise]
inline constexpr double kLastLayer_share = 0.05;
/// Thickest soil that is cut as the last layer: a bucket more for so little takes longer. [-;
/// chosen: 0.13 m on the 12 t; not tried otherwise]
inline constexpr double kThinMost_share = 0.105;
/// Cuts in a row that got next to nothing, after which the soil is left. [-; chosen: not tried
/// otherwise]
inline constexpr int kTriesMost = 3;
/// The same of the last layer: what one such cut has left, more would leave. [-; chosen: not tried
/// otherwise]
inline constexpr int kThinTriesMost = 1;
/// Most sweeps of a strip. [-; chosen: not tried otherwise]
inline constexpr int kSweepsMost = 16;
/// Cuts after which a task ends, whatever is left. [-; chosen: under the 255 of its counter; not
/// tried otherwise]
inline constexpr int kCutsMost = 250;

// Plan (layer_plan.cpp)
/// Share of the cylinders' holding force that a cut may take: the rest is for speed, friction and
/// weight. [-; chosen: not tried otherwise]
inline constexpr double kForceUsed = 0.45;
/// Most depth of a cut, whatever the force. [-; chosen: 0.35 m on the 12 t; not tried otherwise]
inline constexpr double kDepthMost_share = 0.28;
/// Attitude that a full bucket is lifted at. [rad; chosen: not tried otherwise]
inline constexpr double kCarry_rad = 0.15;
/// Way on which the bucket turns to its attitude, of its floor: its heel stays where the edge went
/// in. [-; chosen: not tried otherwise]
inline constexpr double kTurnsWay = 1.4;
/// Attitude of the bucket's floor as it goes down into the ground. [rad; derived: nearly upright,
/// pi / 2 less what its wall leans]
inline constexpr double kSteep_rad = 1.5;
/// Spring of teeth whose oil is not known. [m/N; chosen: a 12 t machine's; not tried otherwise]
inline constexpr double kGiveUnknown_mpn = 1e-6;
/// Height over the ground up to which a planned cut must reach. [-; chosen: 0.3 m on the 12 t; not
/// tried otherwise]
inline constexpr double kPlannedOver_share = 0.24;
/// Volume of loosened soil, of its volume in the ground: sand 1.1, clay 1.3. [-; chosen: between
/// the two; not tried otherwise]
inline constexpr double kSwell = 1.2;

// Poses (layer_pose.cpp)
/// Most speed that the bucket turns at along a cut. [rad/s; chosen: not tried otherwise]
inline constexpr double kCutTurn_radps = 0.5;
/// Last share of the turn's way, on which it comes to rest. [-; chosen: not tried otherwise]
inline constexpr double kTurnFades = 0.3;
/// Speed of a cut on the design itself. [m/s; chosen: not tried otherwise]
inline constexpr double kFinish_mps = 0.4;
/// Speed of a lift out of the ground. [m/s; chosen: not tried otherwise]
inline constexpr double kLiftSpeed_mps = 0.9;
/// Acceleration of a lift, of that of lines. [-; chosen: not tried otherwise]
inline constexpr double kLiftShare = 4.0;
/// Attitude of a bucket that is folded in to hold what it has. [rad; chosen: not tried otherwise]
inline constexpr double kFolded_rad = 0.4;
/// Angle of the floor over the design that keeps the heel off it while the bucket folds. [rad;
/// chosen: not tried otherwise]
inline constexpr double kHeelFree_rad = 0.25;
/// Shares of that turn that a lift tries, in this order. [-; chosen: not tried otherwise]
inline constexpr std::array<double, 4> kLiftTurns = {1.0, 0.6, 0.3, 0.0};
/// Shares of its height that a lift tries, in this order. [-; chosen: not tried otherwise]
inline constexpr std::array<double, 3> kLiftUps = {1.0, 0.7, 0.4};
/// Height that a bucket rises by as it folds. [-; chosen: 0.16 m on the 12 t; not tried otherwise]
inline constexpr double kFoldUp_share = 0.13;
/// Least height of a lift. [-; chosen: 0.4 m on the 12 t; not tried otherwise]
inline constexpr double kLiftLeast_share = 0.325;
/// Height over the ground at which a bucket is out of it. [-; chosen: 0.4 m on the 12 t; not tried
/// otherwise]
inline constexpr double kOutOfGround_share = 0.325;
/// Distance from where a cut went in within which teeth are still in its slot. [-; chosen: 0.3 m on
/// the 12 t; not tried otherwise]
inline constexpr double kSlot_share = 0.24;
/// Ways beyond the line that a falling wall is cut back by, the first that the machine can. [-;
/// chosen: 0.5, 0.35, 0.2, 0.1 m on the 12 t; not tried otherwise]
inline constexpr std::array<double, 4> kBeyond_shares = {0.4, 0.28, 0.16, 0.08};
/// Shares of the steep attitude with which a wall is cut back, the first that the machine can. [-;
/// chosen: not tried otherwise]
inline constexpr std::array<double, 2> kSteepBeyond = {1.0, 0.75};

// Height (layer_height.cpp)
/// Least share of a cycle by which a plan rises, whatever bars its way on. [-; chosen: not tried
/// otherwise]
inline constexpr double kRisesAtLeast = 0.25;
/// Hollow at the foot of a wall beyond the line: height times the bucket's length, over the way
/// squared. [-; chosen: up to where sand stands by itself; not tried otherwise]
inline constexpr double kFoot = 1.54;
/// Height that the edge keeps as it comes from such a foot. [m; chosen: not tried otherwise]
inline constexpr double kFootHigher_m = 0.012;
/// Share of the line on which it gives that height up. [-; chosen: not tried otherwise]
inline constexpr double kOffFoot = 0.06;
/// Speed at which a heavy cut gives way upwards. [m/s; chosen: not tried otherwise]
inline constexpr double kGives_mps = 0.15;
/// Acceleration of a cut's height. [m/s2; chosen: not tried otherwise]
inline constexpr double kHeightChange_mps2 = 1.0;

// Heaviness (cut_force.cpp)
/// Lambda below which a cut counts as stalled. [-; chosen: not tried otherwise]
inline constexpr double kStandsAt = 0.1;
/// Distance behind their plan at which teeth are as heavy as a cut may be. [-; chosen: 0.08 m on
/// the 12 t; not tried otherwise]
inline constexpr double kBehind_share = 0.065;
/// Heaviness at which a cut stands. [-; chosen: not tried otherwise]
inline constexpr double kHoldsAt = 1.4;

// Pace (dig_pace.cpp)
/// Rate at which a plan slows down, of that at which it gets on again. [-; chosen: not tried
/// otherwise]
inline constexpr double kSlowsFaster = 4.0;
/// Weight of teeth that sink under a last cut, against teeth that are late. [-; chosen: not tried
/// otherwise]
inline constexpr double kSinksShare = 2.5;
/// Share of their height over the design that teeth may be behind. [-; chosen: not tried otherwise]
inline constexpr double kOffOfHeight = 0.15;

// Move between cuts (dig_move.cpp)
/// Longest wait for a swinging platform before a cut. [s; chosen: not tried otherwise]
inline constexpr double kCutWaits_s = 10.0;
/// Density of ground in place, to weigh it by. [kg/m3; chosen: loam's; sand 1600, clay 1850; not
/// tried otherwise]
inline constexpr double kGround_kgpm3 = 1750.0;
/// Distance from a move's end at which the next one begins. [-; chosen: 0.2 m on the 12 t; not
/// tried otherwise]
inline constexpr double kPassed_share = 0.16;

// Tare of the empty bucket (dig_tare.cpp)
/// Way of a tare, of a cylinder's stroke. [-; chosen: not tried otherwise]
inline constexpr double kTareMoves = 0.12;
/// Most way of a tare, of the stroke that is left. [-; chosen: not tried otherwise]
inline constexpr double kTareMovesOfLeft = 0.5;
/// Longest part of a tare: a slower one has told what it can. [s; chosen: not tried otherwise]
inline constexpr double kTaresMost_s = 4.0;

// Touch of the ground (dig_touch.cpp)
/// Height over the ground that a touch begins and ends at: there the bucket can turn. [-; chosen:
/// 0.9 m on the 12 t; not tried otherwise]
inline constexpr double kTouchOver_share = 0.73;
/// Height over the ground from which the bucket comes down slowly. [m; chosen: not tried otherwise]
inline constexpr double kTouchSlowFrom_m = 0.07;
/// Height down to which the bucket is weighed in the air. [m; chosen: not tried otherwise]
inline constexpr double kTouchWeighed_m = 0.045;
/// Depth down to which teeth look for the ground. [m; derived: over kZeroMost_m]
inline constexpr double kTouchDeepest_m = 0.07;
/// The same of a plan that the teeth are late behind. [m; derived: twice kTouchDeepest_m]
inline constexpr double kTouchPlanDeepest_m = 0.14;
/// Largest error of height that is believed to be the sensors'. [m; chosen: not tried otherwise]
inline constexpr double kZeroMost_m = 0.065;
/// Speed of a touch down through the air. [m/s; chosen: not tried otherwise]
inline constexpr double kTouchFalls_mps = 0.8;
/// Speed of a touch near the ground. [m/s; chosen: not tried otherwise]
inline constexpr double kTouchSlow_mps = 0.04;
/// Speed of a touch up again. [m/s; chosen: not tried otherwise]
inline constexpr double kTouchRises_mps = 0.8;
/// Acceleration of a touch. [m/s2; chosen: not tried otherwise]
inline constexpr double kTouchChange_mps2 = 1.0;
/// Time constant of the bucket's weight in the air. [s; chosen: not tried otherwise]
inline constexpr double kTouchWeighs_s = 0.15;
/// Time constant of the force that the ground bears: one reading's noise is no weight. [s; chosen:
/// not tried otherwise]
inline constexpr double kTouchHeard_s = 0.2;
/// Force of a found ground, of that which a cut gives way to. [-; chosen: not tried otherwise]
inline constexpr double kTouchBears = 0.12;
/// Height of the teeth over their plan that tells of ground as well. [m; chosen: not tried
/// otherwise]
inline constexpr double kTouchHeldUp_m = 0.015;
/// Least force with that height: late teeth in the air are high too. [-; chosen: not tried
/// otherwise]
inline constexpr double kTouchBearsHeld = 0.05;

// Down to a cut (dig_enter.cpp)
/// Speed of the edge down through the air. [m/s; chosen: not tried otherwise]
inline constexpr double kEntersFalls_mps = 0.8;
/// Height over the soil from which it comes down slower. [m; chosen: not tried otherwise]
inline constexpr double kEntersSlowFrom_m = 0.05;
/// Speed of the edge into the soil. [m/s; chosen: not tried otherwise]
inline constexpr double kEnters_mps = 0.3;
/// Distance at which a plan has reached its cut's height. [m; chosen: not tried otherwise]
inline constexpr double kAtLayer_m = 2e-3;
/// The same of the teeth, in the last layer. [m; chosen: not tried otherwise]
inline constexpr double kDown_m = 0.008;
/// The same of the teeth, in other layers. [m; chosen: not tried otherwise]
inline constexpr double kRoughDown_m = 0.02;
/// Time after which teeth that do not get down begin their cut. [s; chosen: not tried otherwise]
inline constexpr double kEntersHeld_s = 1.0;
/// Spring of pressed teeth that is let be. [m; chosen: not tried otherwise]
inline constexpr double kEntersSpringFree_m = 0.010;
/// Spring through the design over which teeth are not pressed on. [m; chosen: not tried otherwise]
inline constexpr double kEntersSpringMost_m = 0.020;
/// Way that released oil throws its load, of the way it gives under it. [-; chosen: not tried
/// otherwise]
inline constexpr double kThrows = 3.0;
/// Height over the teeth that a plan rises to, to let the oil off. [m; chosen: not tried otherwise]
inline constexpr double kLetsOff_m = 0.10;
/// Longest time to let the oil off. [s; chosen: not tried otherwise]
inline constexpr double kLetsOff_s = 0.8;
/// Rise of the teeth that ends it. [m; chosen: not tried otherwise]
inline constexpr double kLifted_m = 0.010;

// Cut (dig_cut.cpp)
/// Weight of the soil under a pressed heel, against that before the edge. [-; chosen: not tried
/// otherwise]
inline constexpr double kBorne = 0.7;
/// Speed back down to the layer where a cut is light again. [m/s; chosen: not tried otherwise]
inline constexpr double kReturns_mps = 0.05;
/// Speed down the foot of a wall that is cut back. [m/s; chosen: not tried otherwise]
inline constexpr double kFootDown_mps = 0.25;
/// Heaviness under which a cut goes back down. [-; chosen: not tried otherwise]
inline constexpr double kEasy = 0.7;
/// Heaviness from which a cut slows down, until it stands at kHoldsAt. [-; chosen: not tried
/// otherwise]
inline constexpr double kSlowsAt = 0.9;
/// Speed under which a heavy cut does not get on. [m/s; chosen: not tried otherwise]
inline constexpr double kGetsOn_mps = 0.01;
/// Time after which such a cut is ended. [s; chosen: not tried otherwise]
inline constexpr double kCutHeld_s = 1.0;
/// The same at a wall. [s; chosen: not tried otherwise]
inline constexpr double kWallHeld_s = 0.6;
/// Longest wait for the teeth at the end of a cut or a lift. [s; chosen: not tried otherwise]
inline constexpr double kEndWait_s = 0.6;
/// Distance from a cut's end at which teeth have come to it. [m; chosen: not tried otherwise]
inline constexpr double kEndNear_m = 0.02;
/// Spring of teeth in a cut that is let be. [m; derived: kFinish_m]
inline constexpr double kCutSpringFree_m = 0.018;
/// Way that teeth are thrown by soil that breaks off before a steep bucket, of the way the oil
/// gives under it. [-; measured: `check_scaled.py --trench`: 60 t, 94 mm of spring, 175 mm thrown]
inline constexpr double kSteepThrows = 1.8;
/// Force that a cut may take at a wall, of that elsewhere: it breaks off and lets the teeth drop.
/// [-; chosen: not tried otherwise]
inline constexpr double kWallPulls = 0.55;

// Resumed dig (dig_resume.cpp)
/// Height over the ground under which teeth are lifted out before anything else. [-; chosen: 0.05 m
/// on the 12 t; not tried otherwise]
inline constexpr double kResumesOver_share = 0.04;
/// Way beyond the line's ends on which they are too. [-; chosen: where a falling wall is cut back;
/// not tried otherwise]
inline constexpr double kResumesBeyond_share = 0.5;
/// Way that a loaded bucket may have sunk or been moved meanwhile. [-; chosen: 0.3 m on the 12 t;
/// not tried otherwise]
inline constexpr double kStillThere_share = 0.24;

// Lift (dig_lift.cpp)
/// Distance from a lift's end at which teeth have come to it. [m; chosen: not tried otherwise]
inline constexpr double kLiftNear_m = 0.10;
/// Time after which a lift that is held looks for another way. [s; chosen: not tried otherwise]
inline constexpr double kLiftHeld_s = 0.5;
/// Force on a folded bucket that holds it, of that which a cut may take. [-; chosen: not tried
/// otherwise]
inline constexpr double kHeelMost = 1.5;

// Rounds of steps (step_round.cpp)
/// Least way towards the design in a round. [m; chosen: not tried otherwise]
inline constexpr double kLeastDeeper_m = 1e-3;
/// Pace of a move in the place of a line that has none. [-; chosen: not tried otherwise]
inline constexpr double kRoundMovePace = 0.5;
/// Length under which a line has no direction. [m; chosen: not tried otherwise]
inline constexpr double kLeastWay_m = 1e-6;

}  // namespace graben
