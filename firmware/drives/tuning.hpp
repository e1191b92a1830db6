// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements of this room: each value with its unit, why it is so, and what else was tried.

namespace graben {

// Blocked drives (blocked.cpp)

/// Share of the pump line's pressure from which the fed side strains. [-; measured: where hardly
/// any oil flows the fed side has most of the line's pressure; 0.7 tried before; `sweep.py`: soil's
/// max_error_true_m 65.8; x0.7 61.8, x1.3 62.1]
inline constexpr double kBlockedStrains = 0.8;
/// Share of the pump line's pressure under which a straining side no longer strains. [-; measured:
/// under kBlockedStrains, so that noise does not toggle it; 0.6 tried before; `sweep.py`: soil's
/// tip_jerk_rms_mps3 358; x0.7 358, x1.3 350]
inline constexpr double kBlockedStrainsYet = 0.7;
/// Share of the relief's pressure that a straining side has at least. [-; measured: lifting and
/// digging take less; `sweep.py`: soil's tip_jerk_rms_mps3 358; x0.7 321, x1.3 341]
inline constexpr double kBlockedReliefShare = 0.7;
/// Share of the asked speed below which a free drive counts as standing. [-; chosen: not tried]
inline constexpr double kBlockedStandsShare = 0.2;
/// Share of the asked speed from which a blocked drive counts as moving again. [-; chosen: over
/// kBlockedStandsShare, so that it does not toggle; not tried]
inline constexpr double kBlockedMovesShare = 0.5;
/// Asked speed up to which shares of it say nothing. [m/s; chosen: there lambda is as good as 0;
/// not tried]
inline constexpr double kBlockedLeastAsked_mps = 0.002;
/// Speed below which a drive stands where hardly any is asked. [m/s; chosen: not tried]
inline constexpr double kBlockedStill_mps = 0.001;
/// Low-pass of inlet pressure, asked and measured speed. [s; measured: ten cycles take out noise;
/// `sweep.py`: soil's max_error_true_m 65.8; x0.7 65.6, x1.3 63]
inline constexpr double kBlockedFilter_s = 0.1;
/// Time that a drive strains and stands until it counts as blocked. [s; chosen: 0.1 tried before]
inline constexpr double kBlockedKnown_s = 0.2;
/// Time in which the feedback of a blocked drive is faded out, and in again. [s; chosen: no step in
/// what is asked; not tried]
inline constexpr double kBlockedEase_s = 0.3;
/// Share of the relief's pressure from which a blocked drive lets its pressure off. [-; chosen:
/// near the relief the oil is a spring that throws the tool; not tried]
inline constexpr double kBlockedHardShare = 0.85;
/// Share of the relief's pressure down to which a blocked drive lets off. [-; chosen: the tool is
/// held and thrown less; 0.6 tried before]
inline constexpr double kBlockedLetOffShare = 0.75;
/// Time for which a blocked drive pushes before it may let off. [s; chosen: 0.5 tried before]
inline constexpr double kBlockedPushes_s = 0.1;
/// Longest time to let off, also where the pressure does not fall. [s; chosen: then the drive rests
/// all the same; not tried]
inline constexpr double kBlockedLetsOff_s = 1.0;
/// Time for which a drive rests after it has let off, before it pushes again. [s; measured:
/// `campaign dig --obstacle --draws 20`, rocks that hold for 2 to 4.2 s: error after them 29 / 26
/// mm p95, 22 t and 12 t; 1.5: 67 / 60, as a rock that lets go in the second push throws the tool]
inline constexpr double kBlockedRests_s = 3.0;
/// Speed backwards with which a blocked drive lets off. [m/s; chosen: slow, so that only pressure
/// is let off; not tried]
inline constexpr double kBlockedLetsOff_mps = 0.03;
/// Time for which the machine stays slower once a drive that had let off is blocked no more. [s;
/// chosen: its load may yet give way; not tried]
inline constexpr double kBlockedWary_s = 6.0;
/// Way beyond the place of blocking after which the drive is past it. [m; chosen: until then the
/// load's giving way is to throw little; not tried]
inline constexpr double kBlockedPast_m = 0.02;
/// Way towards the load after which it has given way. [m; measured: `campaign dig --obstacle
/// --draws 20`: letting off alone does not end it; 0.003 ends a rest by what the others correct:
/// one 22 t pushes anew too soon]
inline constexpr double kBlockedGaveWay_m = 0.005;

// Commissioning guard (commission_guard.cpp): duties tried on valves that nobody knows

/// Time from a duty to the last of what it does. [s; chosen: slowest machine, 0.25 s of dead time,
/// two lags of 0.15 s and its frames; not tried]
inline constexpr double kGuardUnderWay_s = 0.6;
/// Least time to stop a drive in, before its window's end. [s; chosen: dead time, lags, and what
/// its speed is measured late by; not tried]
inline constexpr double kGuardStops_s = 0.5;
/// Time until a drive that nothing drives has come to rest on its oil. [s; chosen: not tried]
inline constexpr double kGuardComesToRest_s = 0.4;
/// Way outside its window after which a drive is a fault. [m; chosen: farther than one that is
/// stopped in time ever is; not tried]
inline constexpr double kGuardOutside_m = 0.05;
/// Speed up to which an end of the cylinder may be met that the window reaches. [m/s; chosen: not
/// tried]
inline constexpr double kGuardTouch_mps = 0.03;
/// Time for which a drive may be pushed against its end. [s; chosen: not tried]
inline constexpr double kGuardTouch_s = 1.0;
/// Distance from an end within which a standing drive is at it. [m; chosen: whatever its sensor's
/// zero is off; not tried]
inline constexpr double kGuardEndZone_m = 0.015;
/// Low-pass of the guard's speed. [s; chosen: three strokes of noise are little in it, and it is
/// soon there; not tried]
inline constexpr double kGuardSpeed_s = 0.08;
/// Way against its duty, or without any, that is a fault. [m; chosen: with what it then still goes
/// a drive stays within 50 mm; not tried]
inline constexpr double kGuardWrong_m = 0.03;
/// The same way for as long as the duties go on, however slowly it is gone. [m; chosen: over
/// kGuardWrong_m and within 50 mm; not tried]
inline constexpr double kGuardWhole_m = 0.045;
/// Time constant with which wrong way is forgotten. [s; chosen: leakage and a sinking load, below
/// kGuardWrong_m in this time, go on; not tried]
inline constexpr double kGuardForget_s = 5.0;
/// Change of a stroke up to which its drive stands. [m; chosen: noise, and what the oil gives; not
/// tried]
inline constexpr double kGuardStill_m = 0.0005;
/// Duty beyond which every spool is open. [-; chosen: no edge is later; not tried]
inline constexpr double kGuardSurelyOpen = 0.65;
/// Duty beyond one that has moved the drive, at which it should move again. [-; chosen: leaves room
/// for another load; not tried]
inline constexpr double kGuardMoreThanMoved = 0.1;
/// Speed from which a duty has moved its drive. [m/s; chosen: faster than it creeps; not tried]
inline constexpr double kGuardMoves_mps = 0.01;
/// Way from which a duty has moved its drive. [m; chosen: more than its oil gives; not tried]
inline constexpr double kGuardMoved_m = 0.015;
/// Time beyond kGuardUnderWay_s that a drive may stand that should move. [s; chosen: not tried]
inline constexpr double kGuardStrained_s = 0.4;
/// Low-pass of the chamber pressures. [s; chosen: ten cycles take out noise; not tried]
inline constexpr double kGuardPressure_s = 0.1;
/// Time for which a duty is held where only pressures answer it. [s; chosen: friction wants more
/// than an edge; not tried]
inline constexpr double kGuardHolds_s = 1.0;
/// Rise of the duty after kGuardHolds_s. [1/s; chosen: slow, 30 s over the whole range; not tried]
inline constexpr double kGuardRise_ps = 0.03;
/// Duty up to which a drive may stand for ever. [-; chosen: no edge is earlier; not tried]
inline constexpr double kGuardSurelyClosed = 0.1;
/// Most duty beyond kGuardSurelyClosed times time at rest. [s; chosen: 10 s at 0.3; not tried]
inline constexpr double kGuardSpent_s = 2.0;
/// Share of the relief's pressure from which the fed side strains. [-; chosen: there hardly any oil
/// flows; not tried]
inline constexpr double kGuardStrains = 0.8;
/// Distance within which a window's end is the cylinder's end. [m; chosen: more than a frame
/// resolves; not tried]
inline constexpr double kGuardSame_m = 0.001;

// Direction watch (direction_watch.cpp)

/// Pressure by which a drive's own oil must push against its spool. [Pa; chosen: zeros of both
/// sides' sensors together; not tried]
inline constexpr double kDirectionZero_pa = 1.2e6;
/// Share of the travel by which a dead band's edge may be elsewhere. [-; chosen: it is known no
/// better, and nearer to it the oil moves a drive by itself; without it tried]
inline constexpr double kDirectionEdgeBand = 0.03;
/// Way with its spool that may be set against way back, in bounds of the fault. [-; chosen: a drive
/// that shakes on soft oil first goes with its spool; not tried]
inline constexpr double kDirectionCredit = 4.0;
/// Time constant in which it is forgotten that a side has let off. [s; chosen: a drive rings on
/// soft oil with periods of 0.2 s and less, a fall over seconds is its load's; not tried]
inline constexpr double kDirectionSpringFor_s = 0.5;

// Gate (drive_gate.cpp)

/// Largest rise of a tried duty, of its whole range. [1/s; chosen: full within 40 ms, a step to
/// whoever looks at a drive's answer; not tried]
inline constexpr double kTriedDutyRate_ps = 25.0;

// Servo (drive_servo.cpp)

/// Time constant with which a drive that its load holds forgets what it is behind. [s; chosen: not
/// tried]
inline constexpr double kServoForget_s = 0.3;

// Strokes (drive_validation.cpp)

/// Longest time for which a stroke is carried on from its frame. [s; chosen: a frame's 10 ms and
/// what the bus adds; not tried]
inline constexpr double kStrokeFramePeriod_s = 0.012;
/// Low-pass of a stroke's speed. [s; chosen: carried on for a frame, its noise stays below the
/// stroke's; not tried]
inline constexpr double kStrokeSpeed_s = 0.03;

// Tried duties (drive_watch.cpp)

/// Time after the last tried duty for which the valve's model judges nothing. [s; chosen: more than
/// kGuardUnderWay_s; not tried]
inline constexpr double kTriedFor_s = 1.0;

// Speed that the oil allows (flow_speed.cpp)

/// Share of the travel by which a dead band's end and the spool's sensor may be off. [-; chosen:
/// where a dead band ends at best, 3 %, and its sensor; 0.025 tried before]
inline constexpr double kFlowTravelBand = 0.035;
/// Share by which a metering edge's area may be off. [-; chosen: not tried]
inline constexpr double kFlowAreaBand = 0.12;
/// Standard deviations of a learnt opening that are left to it. [-; chosen: 3.0 tried before]
inline constexpr double kFlowSpreads = 2.75;
/// Share by which a regeneration's coefficients may be off. [-; chosen: not tried]
inline constexpr double kFlowGalleryBand = 0.33;
/// Pressure by which a sensor's zero may be off. [Pa; chosen: 1.0e6 tried before]
inline constexpr double kFlowZero_pa = 1.2e6;
/// Most pressure of the return line. [Pa; chosen: 0.2e6 tried, it stops 2 of 1500 sound draws]
inline constexpr double kFlowReturn_pa = 0.5e6;
/// Share by which the flow of a valve that meters at its inlet may be off. [-; chosen: not tried]
inline constexpr double kFlowSupplyBand = 0.2;

// Flow watch (flow_watch.cpp)

/// Pressure below which the draining side may be empty, and neither carries nor pushes. [Pa;
/// chosen: more than kFlowZero_pa and an empty side's pressure; not tried]
inline constexpr double kFlowEmpty_pa = 1.5e6;
/// Share of the pressure sensors' range from which a pressure is not used. [-; chosen: nearer to
/// its end a port relief may be open; not tried]
inline constexpr double kFlowNearRail = 0.8;
/// Bulk modulus of the softest oil, with air in it. [Pa; chosen: not tried]
inline constexpr double kFlowSoftest_pa = 0.6e9;
/// Bulk modulus of the stiffest oil. [Pa; chosen: not tried]
inline constexpr double kFlowStiffest_pa = 2.0e9;
/// Oil in hoses and dead volume of a side, as travel. [m; chosen: not tried]
inline constexpr double kFlowHose_m = 0.15;
/// Newest pressure's share of the low-pass. [-; chosen: most of the noise is gone after 30 ms; not
/// tried]
inline constexpr double kFlowPressureShare = 0.3;
/// Change of a stroke up to which it stands. [m; chosen: more than resolution and noise; not tried]
inline constexpr double kFlowStill_m = 0.0003;
/// Time constant with which what a stroke is off is forgotten. [s; chosen: not tried]
inline constexpr double kFlowForget_s = 10.0;
/// Cycles with the same pressure after which its sensor is dead. [cycles; chosen: no living sensor
/// shows the same so often, unless its side is empty; not tried]
inline constexpr int kFlowSameCycles = 4;
/// Change of a pressure in a cycle beyond which that cycle is not used. [Pa; chosen: faster only
/// where something breaks loose, or the sensor does; not tried]
inline constexpr double kFlowStep_pa = 4.0e6;

// Motion and pressure watch (motion_watch.cpp)

/// Time constant of the anchor's creep after the stroke, and with which asked way is forgotten. [s;
/// chosen: leakage is no uncommanded motion, and no stuck stroke; not tried]
inline constexpr double kMotionForget_s = 10.0;
/// Change of a stroke up to which it stands. [m; chosen: more than the sensor's resolution and
/// noise; not tried]
inline constexpr double kMotionStill_m = 0.0005;
/// Time at its rail after which a pressure is wrong. [s; chosen: longer than any peak that a port
/// relief lets stand; not tried]
inline constexpr double kPressureRail_s = 0.3;
/// Way of a drive, to and fro, after which a pressure that stays the same is stuck. [m; chosen: not
/// tried]
inline constexpr double kPressureStuck_m = 0.06;
/// Step in which that way is counted. [m; chosen: more than a stroke sensor's noise; not tried]
inline constexpr double kPressureStep_m = 0.002;
/// Most that an empty chamber shows, which cavitates at one pressure for long. [Pa; chosen: not
/// tried]
inline constexpr double kEmptyChamber_pa = 0.2e6;
/// Most that an empty chamber shows where nobody knows the sensors' zeros yet. [Pa; chosen:
/// kEmptyChamber_pa, tried before, slowed commissioning]
inline constexpr double kEmptyUnknown_pa = 1.5e6;

// Spool parking (spool_parking.cpp)

/// Time constant with which reversals are forgotten. [s; chosen: not tried]
inline constexpr double kParkingForget_s = 3.0;
/// Corrected speed up to which a spool parks, per reversal in a second. [m; chosen: a fixed 6 mm/s
/// tried in the study before]
inline constexpr double kParkingPerReversal_m = 0.04;
/// Most of that speed, however often it reverses. [m/s; chosen: not tried]
inline constexpr double kParkingMost_mps = 0.04;
/// Speed of the path to the other side beyond which no spool stays parked. [m/s; chosen: there the
/// path itself turns; 0.006 of its speed tried, better on slow paths alone]
inline constexpr double kParkingPathReverses_mps = 0.003;
/// Share of the dead band at which a parked spool waits. [-; chosen: its edge is not known exactly;
/// not tried]
inline constexpr double kParkingWithin = 0.7;

// A drive's way against what was asked (way_watch.cpp)

/// Share by which a drive may be slower and faster than it was asked. [-; chosen: 0.1 to 0.4 tried,
/// no healthy drive of 160 comes to its bound; 0.15 sees more of a gain]
inline constexpr double kWayBand = 0.2;
/// Share of its fastest by which it may too. [-; chosen: 0 tried, a bucket is 105 mm off]
inline constexpr double kWayCreeps = 0.01;
/// Time constant with which a difference is forgotten. [s; chosen: 4 and 10 tried]
inline constexpr double kWayForget_s = 6.0;
/// Share of its relief with which its load may slow it. [-; chosen: an arm in soil falls 18 mm
/// short; 0.5 and 0.7 tried, 24 and 31 mm]
inline constexpr double kWayPresses = 0.35;

// Watch over drives at rest (rest_watch.cpp)

/// Way within which a drive stands still. [m; chosen: noise of strokes as bad as the fault cases
/// draw them; tried 0.002, where none came to rest]
inline constexpr double kRestNear_m = 0.01;
/// Share of that which its low-passed stroke may change while it stands. [-; chosen: 3 mm in
/// kRestStands_s is what creeps; 1 tried, with which the fault of a drive at 3 mm/s came and went]
inline constexpr double kRestStill = 0.3;
/// Time constant of that low-pass. [s; chosen: noise of 20 frames; not tried]
inline constexpr double kRestCalm_s = 0.2;
/// Time for which what was seen to move has to stand until that is its rest. [s; chosen: 5 tried,
/// with which nobody could arm for so long after a sensor's jump]
inline constexpr double kRestStands_s = 1.0;
/// Least time for which a drive is away from its rest before it is seen to move. [s; chosen: a
/// value that is wrong for some frames is no motion; not tried]
inline constexpr double kRestMoves_s = 0.3;
/// Factor on the way that a stopping drive's last command explains. [-; chosen: a drive may be as
/// much faster than it was asked to be; not tried]
inline constexpr double kRestCoast = 1.3;
/// Share of that way that still counts a cycle after a drive was asked for less. [-; chosen: some
/// is under way for half a second; 0 tried, with which one let go while it stops may be seen]
inline constexpr double kRestCoastKept = 0.98;

// Spool watch (spool_watch.cpp)

/// Cycles in a row after which a wrong spool is stuck. [cycles; chosen: two of its frames, which
/// come every second cycle; not tried]
inline constexpr int kSpoolWrongCycles = 4;
/// Cycles that a spool may be behind on its way out, beyond what is told of it. [cycles; chosen:
/// valves of 80 ms and commands that are 120 ms late come within 0.2 s, and
/// nothing moves meanwhile; not tried]
inline constexpr int kSpoolBehindCycles = 30;
/// Way of a spool below which it stands. [-; chosen: of its travel, above what its sensor shows at
/// rest; not tried]
inline constexpr double kSpoolMoves = 0.02;
/// Cycles that the valve side has to say what we say, unless its bus is slower. [cycles; chosen:
/// not tried]
inline constexpr int kEchoCycles = 12;
/// Latest start of a spool whose valve is not known. [s; chosen: the slowest valve, 0.25 s of dead
/// time, and room; not tried]
inline constexpr double kUnknownSpoolStarts_s = 0.45;
/// Longest of each of the two lags of such a spool. [s; chosen: the slowest valve, 0.15 s, and
/// room; not tried]
inline constexpr double kUnknownSpoolLag_s = 0.16;

// Caps on the velocity (velocity_cap.cpp)

/// Closing speed up to which a limit binds nothing, rad/s of a swing. [m/s; chosen: it is rounding,
/// free even beyond a limit; not tried]
inline constexpr double kStandsStill = 1e-9;

}  // namespace graben
