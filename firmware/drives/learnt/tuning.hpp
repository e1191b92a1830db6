// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements of what is learnt of valves at work: each was chosen or measured.

namespace graben {

// Learnt valves (learnt_valve.cpp). Openings are shares of the travel outside the dead band.

/// Standard deviation of where a dead band ends, before anything is learnt. [-; chosen: a machine
/// as found; not tried]
inline constexpr double kLearntEdgeSpread = 0.03;
/// Standard deviation of how a valve opens, before anything is learnt. [-; chosen: 0.12 tried
/// before]
inline constexpr double kLearntBendSpread = 0.09;
/// Most that a dead band's end is moved. [-; chosen: over two kLearntEdgeSpread; not tried]
inline constexpr double kLearntEdgeMost = 0.07;
/// Most by which the way of opening is bent. [-; chosen: over three kLearntBendSpread; not tried]
inline constexpr double kLearntBendMost = 0.3;
/// Growth of the edge's variance. [1/s; chosen: nothing is known any more after 15 minutes; not
/// tried]
inline constexpr double kLearntEdgeDrift_ps = 1e-6;
/// Growth of the bend's variance. [1/s; chosen: nothing is known any more after 14 minutes; not
/// tried]
inline constexpr double kLearntBendDrift_ps = 1e-5;
/// Low-pass of the openings and speeds that are compared. [s; chosen: not tried]
inline constexpr double kLearntFilter_s = 0.15;
/// Standard deviation of a compared opening, in each cycle. [-; chosen: 25 cycles under one
/// low-pass say as much as one would; not tried]
inline constexpr double kLearntOpeningNoise = 0.1;
/// Standard deviation of a compared speed, in each cycle. [m/s; chosen: as with
/// kLearntOpeningNoise; not tried]
inline constexpr double kLearntSpeedNoise_mps = 0.02;
/// Asked speed from which a valve is learnt. [m/s; chosen: not tried]
inline constexpr double kLearntLeastSpeed_mps = 0.010;
/// Asked opening from which a valve is learnt. [-; chosen: not tried]
inline constexpr double kLearntLeastOpening = 0.02;
/// Ratio of speed to asked speed, or the other way, beyond which it is not the valve's doing. [-;
/// chosen: not tried]
inline constexpr double kLearntMostRatio = 4.0;
/// Ratio of the two up to which it counts, where any motion does. [-; measured: 4, 8 and 16 tried
/// on seven cells of `cells.py --map`, ringing at most 4.8, 3.6 and 3.8 mm]
inline constexpr double kLearntCountedRatio = 8.0;
/// Slowest of the two from which any motion counts. [m/s; measured: 0.5, 2 and 4 mm/s tried on
/// seven cells of `cells.py --map --speed 0.1`, largest error 19, 20 and 25 mm for 17]
inline constexpr double kLearntCreeps_mps = 0.001;
/// Share of its relief from which a load presses on a drive. [-; measured: 0.6 tried, soil's push
/// is learnt from, and 2 of 20 loops of `campaign dig --errors all --speed 0.1 --soil` are stopped;
/// 0.35, boom and bucket in the air come to 0.41, and a cell of the map is]
inline constexpr double kLearntPressed = 0.45;
/// Time since one has pressed after which the machine is in the air. [s; measured: `campaign dig
/// --profile excavator_12t --errors all --speed 0.1 --soil`: 2 tried, 30 of 40 loops close instead
/// of 34, as many as without]
inline constexpr double kLearntInAir_s = 10.0;
/// Distance of an opening from its low-pass beyond which it changes too fast to be compared. [-;
/// chosen: not tried]
inline constexpr double kLearntSteady = 0.08;
/// Factor on the opening's exponent where the bypass closes over the opening too. [-; chosen: there
/// a speed hangs on the opening more steeply; not tried]
inline constexpr double kLearntSteeper = 4.0;

// A motor's dead band (learnt_valve.cpp)

/// Rate at which a motor's edge is moved. [1/s; chosen: 0.15 tried before]
inline constexpr double kMotorEdgeRate_ps = 0.10;
/// Time for which a motor has stood under an open spool before its edge is moved. [s; chosen: 0.1
/// tried before, it learnt falsely: 28 mm on the paper's line instead of 20]
inline constexpr double kMotorUnmoved_s = 0.4;
/// Time from setting off in which a motor that is too fast shows its edge. [s; chosen: later its
/// load may drive it; not tried]
inline constexpr double kMotorSetsOff_s = 0.5;
/// Asked speed, in speeds at which a motor still stands, from which it should move. [-; chosen:
/// less is asked of what is to stand; without it tried, it learnt falsely]
inline constexpr double kMotorAskedLeast = 5.0;

// A cylinder that stands under an open spool, where the bypass meters (learnt_valve.cpp)

/// Share of the opening for a slow speed at which a drive sets off. [-; chosen: not tried]
inline constexpr double kStandingSetsOffShare = 0.96;
/// Opening, asked and measured, from which a spool is open. [-; chosen: over kLearntEdgeSpread; not
/// tried]
inline constexpr double kStandingFeltOpening = 0.05;
/// Asked opening from which nothing is learnt of a standing drive. [-; chosen: beyond it the edge
/// says less than a tenth of what is missed; not tried]
inline constexpr double kStandingMostClosing = 0.9;
/// Asked speed from which a drive that stands should move. [m/s; chosen: over kStandingStill_mps;
/// not tried]
inline constexpr double kStandingLeastAsked_mps = 0.008;
/// Speed below which a drive stands. [m/s; chosen: not tried]
inline constexpr double kStandingStill_mps = 0.003;
/// Time for which a drive has stood before its edge is moved. [s; chosen: four cycles; not tried]
inline constexpr double kStandingStood_s = 0.04;
/// Share of the edge's distance that is gone in a cycle. [-; chosen: not tried]
inline constexpr double kStandingShare = 0.3;
/// Fastest that the edge is moved. [1/s; chosen: the line needs time to show what the spool has
/// reached, so little is overshot; 0.5 tried before]
inline constexpr double kStandingRate_ps = 0.1;

// A cylinder that stands in the air under a spool at its edge (learnt_valve.cpp)

/// Asked speed from which it should creep. [m/s; chosen: not tried]
inline constexpr double kStillLeastAsked_mps = 0.002;
/// Speed below which it stands. [m/s; chosen: under kLearntCreeps_mps, from which it is compared;
/// not tried]
inline constexpr double kStill_mps = 0.0005;
/// Time for which it has stood before its edge is moved. [s; chosen: steps of a stroke of 0.1 mm
/// come so far apart at 0.3 mm/s; not tried]
inline constexpr double kStillStood_s = 0.3;
/// How fast the edge is moved. [1/s; measured: `cells.py --map --speed 0.1`: 80 of 80 cells end,
/// without 79; no other rate was tried]
inline constexpr double kStillRate_ps = 0.02;

}  // namespace graben
