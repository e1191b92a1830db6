// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers of the dozer's travel that were chosen, each with why: the model of the body on its
/// ground, the speed that the ground ahead allows, passes, loads and steering.

#include <array>

#include "firmware/dozer/safety/tuning.hpp"

namespace graben {

// Map of the ground (ground_map.cpp, ground_map.hpp)

/// Distance of x = 0 beyond which a place counts as this far. [m; chosen: more than any site, and
/// an int counts the lines of every grid up to it; not tried]
inline constexpr double kFurthest_m = 1e6;
/// Width of a cell of the map of the ground. [m; measured: five cells between two wheels of
/// dozer_9t; `sweep.py`: grade's max_error_true_m 11.1; x0.7 11.1, x1.3 12.5]
inline constexpr double kGroundCell_m = 0.05;
/// Height over the design above which an edge counts as in the air, which cuts nothing. [m; chosen:
/// more than control and sensors ever leave it; not tried]
inline constexpr double kEdgeInAir_m = 0.08;

// Body at rest and in motion (support.cpp, body_motion.cpp, body_motion.hpp)

/// Bound of the model's pitch. [rad; derived: kMostPitch_rad, beyond which no pitch is believed]
inline constexpr double kModelMostPitch_rad = kMostPitch_rad;
/// Largest change of height in a step of Newton's method towards rest. [m; chosen: steps stay small
/// against the wheels' spacing; not tried]
inline constexpr double kStandMostStep_m = 0.05;
/// Largest change of pitch in a step of Newton's method towards rest. [rad; chosen: some 60 mm at
/// the track's ends; not tried]
inline constexpr double kStandMostStep_rad = 0.05;
/// Change of height below which a stand is at rest. [m; chosen: the next step of Newton's method is
/// of the order of its square; not tried]
inline constexpr double kStandAtRest_m = 1e-4;
/// Change of pitch below which a stand is at rest. [rad; chosen: the next step of Newton's method
/// is of the order of its square; not tried]
inline constexpr double kStandAtRest_rad = 1e-4;
/// Distance before and behind a wheel's middle at which the model looks at the ground. [m;
/// measured: a wheel presses on 0.1 m of track to either side, whose mean is that of Gauss's two
/// points, 0.1 m over the root of 3; `sweep.py`: grade's max_error_true_m 11.1; x0.7 11.5, x1.3
/// 12.3]
inline constexpr double kHalfWheel_m = 0.0577;
/// Bound of the model's vertical speed. [m/s; chosen: no machine climbs or falls as fast, and the
/// model must not run away where the ground is not as it expects; not tried]
inline constexpr double kModelMostClimb_mps = 3.0;
/// Bound of the model's pitch rate. [rad/s; chosen: no machine tips as fast, and the model must not
/// run away where the ground is not as it expects; not tried]
inline constexpr double kModelMostRate_radps = 3.0;
/// Longest step of the body's model. [s; measured: it stays near the truth with it; `sweep.py`:
/// grade's max_error_true_m 11.1; x0.7 11.5, x1.3 12.5]
inline constexpr double kMotionStep_s = 0.02;
/// Low-pass of the accelerations that the body's model does not know of. [s; measured: long enough
/// for the noise of rates, short enough for the ground that passes below; `sweep.py`: grade's
/// edge_jerk_rms_mps3 15.5; x0.7 15.9, x1.3 15.5]
inline constexpr double kModelBias_s = 0.08;
/// Bound of the vertical acceleration that the body's model does not know of. [m/s2; chosen: half
/// of a free fall; not tried]
inline constexpr double kModelMostBias_mps2 = 5.0;
/// Bound of the pitch acceleration that the body's model does not know of. [rad/s2; chosen: as a
/// number equal to kModelMostBias_mps2; not tried]
inline constexpr double kModelMostBias_radps2 = 5.0;
/// Time in which rocking from side to side dies away, and noise of the roll's rate with it. [s;
/// chosen: the springs are stiff against roll; not tried]
inline constexpr double kRollRocking_s = 0.05;

// Reach of the blade over a design (grade_reach() in support.cpp)

/// Way between two places at which the blade's reach is checked. [m; chosen: less than the rounding
/// of a corner of 0.3 m, as in dozer_9t; not tried]
inline constexpr double kGradeReachStep_m = 0.2;
/// Bound of the lift's angle while the edge is sought on the design. [rad; chosen: beyond the reach
/// of any blade; not tried]
inline constexpr double kGradeReachMostAngle_rad = 1.0;
/// Height that an edge may have to go beyond the blade's reach. [m; chosen: some millimetres are
/// within any tolerance; not tried]
inline constexpr double kGradeReachTolerance_m = 0.008;

// Preview of the ground (preview.cpp, preview.hpp)

/// Distance between two stations of the preview. [m; measured: 50 stations to a preview of 2.5 m,
/// as in dozer_9t; `sweep.py`: grade's rmse_error_true_m 2.7; x0.7 2.69, x1.3 2.63]
inline constexpr double kPreviewStep_m = 0.05;
/// Speeds of the probes over the wanted one, the fastest first. [-; chosen: each some 0.62 of the
/// one before, down to 0.14 m/s of dozer_9t; five probes, down to 0.15, were tried before]
inline constexpr std::array<double, 6> kProbeShare = {1.0, 0.62, 0.39, 0.24, 0.15, 0.09};
/// Time ahead whose lowest limit a rising speed keeps to. [s; chosen: longer than the machine's
/// lag, so that a speed does not rise for a gap between two limits; not tried]
inline constexpr double kPreviewHold_s = 0.6;
/// Largest share of the flow that the tilt may take on the way ahead. [-; chosen: the lift keeps
/// the rest; not tried]
inline constexpr double kPreviewTiltShare = 0.6;
/// Speed that stands for no limit. [m/s; chosen: no machine of this kind is faster; not tried]
inline constexpr double kAnySpeed_mps = 10.0;
/// Change of the lift's angle below which the edge is on the design. [rad; chosen: the next step of
/// Newton's method finds the same; not tried]
inline constexpr double kPreviewOnDesign_rad = 1e-4;
/// Lift below which no ground counts as left. [m; measured: less is no stretch of its own;
/// `sweep.py`: grade's max_error_true_m 11.1; x0.7 11.1, x1.3 11.7]
inline constexpr double kPreviewNoLift_m = 1e-4;
/// Oil per metre of way that a tilt's speed is divided by at least. [m2; chosen: far below what a
/// tilt takes, only no division by 0; not tried]
inline constexpr double kPreviewNoOil_m2 = 1e-9;
/// Time in which a position summed up from velocity is drawn to the measured one. [s; measured:
/// long against the noise of positions; `sweep.py`: grade's max_error_true_m 11.1; x0.7 11.8, x1.3
/// 11.2]
inline constexpr double kPositionDrawn_s = 0.2;
/// Difference above which the measured position is taken at once. [m; chosen: more than noise and
/// slip make; not tried]
inline constexpr double kPositionApart_m = 0.1;

// Travel speed (speed_limit.cpp, speed_limit.hpp)

/// Share of the task's tolerance that the edge may be off before the machine slows down. [-;
/// chosen: what is left standing on purpose, kGradeLiftShare, stays below it; not tried]
inline constexpr double kSpeedOnGrade = 0.6;
/// Share of the task's tolerance that the edge is off at which the machine is at v_min. [-; chosen:
/// so that it begins with the blade on the grade; not tried]
inline constexpr double kSpeedOffGrade = 2.0;
/// Flow per metre of way that the available flow is divided by at least, in m3/s per m/s. [m3/s;
/// chosen: far below what a blade takes, only no division by 0; not tried]
inline constexpr double kSpeedNoFlow_m3ps = 1e-9;
/// Deceleration over the planned one where the plan was wrong. [-; measured: 1.25 was tried; with
/// 1.1 and what the transmission adds it stays below 1.5 m/s2, also as the blade goes in;
/// `sweep.py`: grade's max_error_true_m 11.1; x0.7 10.8, x1.3 11.2]
inline constexpr double kSpeedBraking = 1.1;
/// Low-pass of the flow that is measured as required. [s; chosen: it is for what the plan of the
/// ground ahead did not know; not tried]
inline constexpr double kSpeedFlowFilter_s = 0.1;
/// Low-pass of the edge's error that slows the machine. [s; chosen: noise of the edge's sensors
/// must not slow it; not tried]
inline constexpr double kSpeedErrorFilter_s = 0.1;
/// Share of the speed that a rise has to gain to be begun. [-; measured: a wanted speed must not
/// run up and down with every limit that it passes; `sweep.py`: grade's max_error_true_m 11.1; x0.7
/// 10.9, x1.3 11.1]
inline constexpr double kSpeedWorthIt = 0.10;
/// Time between a fall of the speed and its next rise. [s; chosen: for the reason of kSpeedWorthIt;
/// not tried]
inline constexpr double kSpeedPause_s = 0.3;

// Speed of the tracks (tracks.cpp)

/// Bound of the integral of a track's speed error. [m/s; chosen: more than leakage and slip ever
/// take; not tried]
inline constexpr double kTrackMostIntegral_mps = 0.4;
/// Bound of the acceleration that is fed forward to a track. [m/s2; chosen: above what the machine
/// brakes with; not tried]
inline constexpr double kTrackMostAcceleration_mps2 = 2.0;
/// Lag of a track's speed behind the wanted one, by oil, bus and the ground's shear, which the PI
/// does not make up for. [s; measured: with 0.07, tried before, the machine braked with 1.25 times
/// what was asked, up to 1.68 m/s2 in soil: the lag is longer as braking sets in; `sweep.py`:
/// grade's max_error_true_m 11.1; x0.7 12.4, x1.3 13.4]
inline constexpr double kTrackExpectedLag_s = 0.12;

// Body that falls over a crest (fall.cpp)

/// Time over which a fall is followed. [s; measured: no body tips for longer before its wheels are
/// down again; just below 30 steps of kMotionStep_s, so that their sum reaches it; `sweep.py`:
/// grade's max_error_true_m 11.1; x0.7 11.2, x1.3 18.8]
inline constexpr double kFallFollowed_s = 0.59;
/// Share of the task's tolerance that an edge may sink in a fall before the blade rises for it. [-;
/// chosen: the feedback makes it good; tried on all soils]
inline constexpr double kFallSinksAnyway = 0.2;
/// Share of the task's tolerance that the blade may rise for a fall. [-; chosen: what may be left
/// standing without another pass; tried on all soils]
inline constexpr double kFallMostLift = 0.8;
/// Speed with which the blade's lift for a fall grows. [m/s; chosen: as kPassClear_mps; not tried]
inline constexpr double kFallRise_mps = 0.2;
/// Speed with which the blade's lift for a fall goes back. [m/s; chosen: so slow that the edge cuts
/// its way down instead of riding on the ground; not tried]
inline constexpr double kFallSink_mps = 0.05;
/// Way over which the ground lets go of an edge that it bears. [m; chosen: tried on all soils;
/// shorter than a corner of the design is round]
inline constexpr double kFallLetsGo_m = 0.1;
/// Depth of a fall that a speed is divided by at least. [m; chosen: far below what counts, only no
/// division by 0; not tried]
inline constexpr double kFallNone_m = 1e-6;

// Load on the blade (blade_load.cpp)

/// Pressure of the line that drains. [Pa; measured: the charge pressure of the class, which the
/// profile does not have; that of dozer_9t.sim.toml; `sweep.py`: grade's max_error_true_m 11.1;
/// x0.7 11.8, x1.3 11.2]
inline constexpr double kLoadCharge_pa = 2.5e6;
/// Low-pass of push, its rise and slip. [s; measured: ten cycles, for the noise of pressures;
/// `sweep.py`: grade's max_error_true_m 11.1; x0.7 11.5, x1.3 11.4]
inline constexpr double kLoadFilter_s = 0.1;
/// Slip above which the blade rises. [-; chosen: beyond it the tracks dig themselves in, and give
/// hardly more; not tried]
inline constexpr double kLoadMostSlip = 0.15;
/// Time by which a rising load is foretold. [s; chosen: until the blade has answered; not tried]
inline constexpr double kLoadSoon_s = 0.3;
/// Track speed that slip is divided by at least. [m/s; chosen: 0.05 was tried; slower than this,
/// noise and a pose's latency pass for slip]
inline constexpr double kSlipSlowest_mps = 0.5;
/// Speed with which the blade rises for a load that is twice what it may be. [m/s; chosen: in
/// proportion to what is too much; not tried]
inline constexpr double kLoadRise_mps = 0.3;
/// Largest speed with which the blade rises for a load. [m/s; chosen: a bound for jumps of the
/// load; not tried]
inline constexpr double kLoadMostRise_mps = 0.25;
/// Share of kLoadRise_mps with which the blade comes down as the load falls. [-; chosen: slower
/// than it rises; not tried]
inline constexpr double kLoadDown = 0.6;
/// Largest height that a load lifts the blade by. [m; chosen: 0.6 was tried before passes had a
/// depth of their own]
inline constexpr double kLoadMostLift_m = 0.2;
/// Share of `push_max` above which a reserve of flow is kept, in full at twice that. [-; measured:
/// more than rolling, slopes and getting faster take; `sweep.py`: grade's max_error_true_m 11.1;
/// x0.7 11.4, x1.3 11.1]
inline constexpr double kLoadReserveFrom = 0.3;
/// Share of the flow that is the reserve of a loaded blade. [-; measured: tried on all soils; a
/// load tips the body as no preview knows; `sweep.py`: grade's max_error_true_m 11.1; x0.7 11.3,
/// x1.3 11.5]
inline constexpr double kLoadReserve = 0.25;

// Passes (passes.cpp)

/// Way between where the machine turns and what is left. [m; chosen: to get under way and bring the
/// blade down; not tried]
inline constexpr double kPassRunUp_m = 1.2;
/// Height beyond the task's tolerance from which on ground counts as left. [m; chosen: for the
/// noise of what is measured; not tried]
inline constexpr double kPassWorthIt_m = 0.005;
/// Low-pass of the edge's error that counts as ground left. [s; chosen: noise begins no pass; not
/// tried]
inline constexpr double kPassErrorFilter_s = 0.1;
/// Share of what the pass before has left, above which a pass counts as in vain. [-; chosen: a
/// twentieth is more than noise changes; not tried]
inline constexpr double kPassLowers = 0.95;
/// Passes in vain in a row that end the task. [-; chosen: with one, tried before, stones stayed:
/// what one pass has loosened the next one takes]
inline constexpr int kPassVainMost = 2;
/// Share of `push_max` that a pass is to take; with less the next one goes deeper. [-; chosen: a
/// tenth stays for hard places; not tried]
inline constexpr double kPassFullPush = 0.9;
/// Largest growth of a pass's step over the one before. [-; chosen: no more than so much at once;
/// not tried]
inline constexpr double kPassDeeper = 1.6;
/// Factor on the mean lift by a pass's load. [-; chosen: the lift is felt at its worst places, not
/// on average; not tried]
inline constexpr double kPassLiftCounts = 2.0;
/// Share of a pass's step that its load may have lifted the blade by, counted with kPassLiftCounts,
/// before the next pass goes less deep. [-; chosen: an eighth on average; not tried]
inline constexpr double kPassLacked = 0.25;
/// Factor on the step of a pass that goes less deep. [-; chosen: 0.5 was tried: halves of a step
/// never got below it]
inline constexpr double kPassLessDeep = 0.7;
/// Least step of a pass. [m; chosen: more than the task's tolerance, so that each pass gets on; not
/// tried]
inline constexpr double kPassLeastStep_m = 0.03;
/// Height of the blade over the design on the way back. [m; chosen: clear of the ground that a pass
/// has left; not tried]
inline constexpr double kPassClear_m = 0.25;
/// Speed with which the blade goes up to kPassClear_m and down again. [m/s; chosen: the way
/// takes 1.25 s; not tried]
inline constexpr double kPassClear_mps = 0.2;
/// Speed below which the machine stands between passes. [m/s; chosen: above the noise of a
/// velocity; not tried]
inline constexpr double kPassStands_mps = 0.05;
/// Largest speed backward. [m/s; chosen: below the speed forward of dozer_9t; not tried]
inline constexpr double kPassFastestBack_mps = 1.0;

// Steering on a curve (course.cpp, course.hpp)

/// Way within which the edge is led back to the track. [m; chosen: about the edge's distance from
/// the body's origin; not tried]
inline constexpr double kComeBack_m = 2.0;
/// Largest curvature that is asked of the machine. [1/m; chosen: a radius of 4 m, tighter than any
/// design's; not tried]
inline constexpr double kTightest_pm = 0.25;
/// Distance of an edge from its track, beyond the nearest that it was, at which the task is left.
/// [m; chosen: well above the 75 mm of the shipped curve as found; not tried]
inline constexpr double kMostOffTrack_m = 0.4;
/// Angle by which a design's curvature may have the edge lie askew. [rad; chosen: a radius of 8.9 m
/// for dozer_9t_tilt; not tried]
inline constexpr double kMostAskew_rad = 0.25;
/// Way backward in which an offset from the track halves, and with it the heading's share. [m;
/// chosen: half as long again as kComeBack_m; not tried]
inline constexpr double kCourseBackward_m = 3.0;
/// Time constant with which the tracks' slip of a turn is learnt. [s; chosen: long against
/// the noise of a yaw rate; not tried]
inline constexpr double kCourseTrim_s = 0.7;
/// Speed below which no slip of a turn is learnt. [m/s; chosen: a curvature is divided by the
/// speed; not tried]
inline constexpr double kCourseTrimLeast_mps = 0.15;
/// Bound of the curvature that the tracks lose by slipping. [1/m; chosen: about a quarter of
/// kTightest_pm; not tried]
inline constexpr double kCourseTrimMost_pm = 0.06;
/// Low-pass of what the outer track lags behind. [s; chosen: what a track lags while the machine
/// gets faster is no shortage; not tried]
inline constexpr double kCourseShort_s = 0.5;
/// Lag of the outer track that the inner one does not wait for. [m/s; chosen: above the noise of a
/// track's speed; not tried]
inline constexpr double kCourseNotShort_mps = 0.03;

}  // namespace graben
