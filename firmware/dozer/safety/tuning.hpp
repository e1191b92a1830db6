// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers of the dozer's validation and watches that were chosen, each with why.

namespace graben {

// Validation of the pose (dozer_validation.cpp). A coordinate is believed if it is near to where
// its last value and its measured rate put it.

/// Margin of a position or an offset from the track. [m; chosen: noise, resolution, and what the
/// velocity changes within a frame; not tried]
inline constexpr double kPositionMargin_m = 0.10;
/// Margin of a height. [m; chosen: noise, resolution, and what the climb changes within a frame;
/// not tried]
inline constexpr double kHeightMargin_m = 0.03;
/// Margin of a pitch, roll or heading. [rad; chosen: noise, resolution, and what the rate changes
/// within a frame; not tried]
inline constexpr double kPitchMargin_rad = 0.02;
/// Growth of these margins per second since the last frame, in m or rad. [1/s; chosen: the error of
/// a measured rate stays below it; not tried]
inline constexpr double kRateMargin_ps = 0.5;
/// Pitch or roll above which a pose is implausible. [rad; chosen: a body at 46 degrees lies on its
/// side, or its sensor does; not tried]
inline constexpr double kMostPitch_rad = 0.8;

// Pose against motion (pose_watch.cpp). A residual is what a coordinate changes beyond what its
// rate explains, summed up; above its limit the pose does not fit its motion.

/// Time constant with which all residuals but the slope's forget. [s; chosen: noise and offsets of
/// a rate do not add up; not tried]
inline constexpr double kPoseForget_s = 1.0;
/// Time constant with which the slope's residual forgets. [s; chosen: longer than kPoseForget_s, as
/// gentle slopes take longer to tell; not tried]
inline constexpr double kSlopeForget_s = 3.0;
/// Limit of the residual of position against velocity, and of offset against heading. [m; chosen:
/// above what a healthy body shows with its noise and the ground's roughness; not tried]
inline constexpr double kMostAhead_m = 0.05;
/// Time constant with which the slow residual of position against velocity forgets. [s; chosen: a
/// pose that comes 20 ms later each second is then 0.4 s of way off; not tried]
inline constexpr double kLaterForget_s = 20.0;
/// Limit of the slow residual of position against velocity. [m; chosen: what a pose that comes 20
/// ms later each second shows after 4 s at 1.6 m/s; not tried]
inline constexpr double kMostLater_m = 0.12;
/// Limit of the residual of height against climb. [m; chosen: above what a healthy body shows with
/// its noise and the ground's roughness; not tried]
inline constexpr double kMostClimbed_m = 0.02;
/// Limit of the residual of pitch or roll against its rate. [rad; chosen: above what a healthy body
/// shows with its noise and the ground's roughness; not tried]
inline constexpr double kMostTurned_rad = 0.012;
/// Limit of the residual of heading against yaw rate. [rad; chosen: twice the 7.0 mrad of healthy
/// runs on curved.xml (all errors, seeds 1 to 20, without soil and in sand), as two antennas a
/// metre apart are noisier than a pitch's unit; not tried]
inline constexpr double kMostYawed_rad = 0.015;
/// Limit of the residual of climb against the slope that the pitch shows. [m; chosen: above what a
/// healthy body shows with its noise and the ground's roughness; not tried]
inline constexpr double kMostUphill_m = 0.10;
/// Limit of the residual of velocity against the tracks, slip taken off. [m; chosen: above what a
/// healthy body shows with its noise and the ground's roughness; not tried]
inline constexpr double kMostSlipped_m = 0.06;
/// Share of the tracks' speed that may be slip. [-; chosen: twice kLoadMostSlip, at which the blade
/// rises; not tried]
inline constexpr double kPoseMostSlip = 0.3;
/// Time constant with which the slow residuals of pitch and roll forget. [s; chosen: a drift of
/// 8 mrad/s is seen after 2.4 s, a gyro that is off by 3 mrad/s is none; not tried]
inline constexpr double kDriftForget_s = 5.0;
/// Limit of the slow residuals of pitch and roll. [rad; chosen: kDriftForget_s times 3 mrad/s;
/// healthy bodies without a gyro's zero show 2.5 mrad, `campaign grade` as below; others not tried]
inline constexpr double kMostDrift_rad = 0.015;
/// Share of the tracks' way that may be slip while they hardly pull. [-; chosen: half of what is to
/// be seen; healthy tracks show 0.07 at most; not tried]
inline constexpr double kUnloadedSlip = 0.12;
/// Traction, as a share of the weight, from which more than that may be slip. [-; chosen: rolling
/// and a light cut; not tried]
inline constexpr double kSlipFromTraction = 0.25;
/// Traction beyond that, as a share of the weight, with which kPoseMostSlip may be. [-; chosen:
/// loose ground slips so from half of the weight on; not tried]
inline constexpr double kSlipOverTraction = 0.25;
/// Limit of the slip by way beyond what the traction explains. [m; chosen: twice the 0.155 of
/// healthy bodies that meet stones, 100 draws of `campaign grade --errors all`; without soil, in
/// clay and sand 0.011; 0.10 and 0.15 tried: seed 74 of these stopped]
inline constexpr double kMostSlips_m = 0.30;
/// Error of a measured velocity beside slip. [m/s; chosen: above the noise of velocity and track
/// speeds; not tried]
inline constexpr double kSlipMargin_mps = 0.1;
/// Distance from the body's origin to the point that it tips about: pitching climbs by that, too.
/// [m; chosen: some 0.4 of the contact of a 9 t machine's tracks; not tried]
inline constexpr double kTippingArm_m = 1.0;

// Displacements (displacement_watch.cpp)

/// Cycles in a row that a displacement has to be away before it has run away. [cycles; chosen: one
/// wrong frame may be seen in two cycles; not tried]
inline constexpr int kRunawayCycles = 3;

// Transmission and tracks (transmission_watch.cpp)

/// Time that a track may be off the speed of its displacements. [s; chosen: stopping at once from
/// 1.8 m/s is over 0.35 m/s for 0.09 s on the simulated machine; others not tried]
inline constexpr double kTrackOff_s = 0.3;
/// Share of a track's speed that losses may take which the profile does not know. [-; chosen: on
/// the simulated machine losses that the profile has wrong by as much again are 0.38 m/s at 2.6
/// m/s, where 0.35 and this allow 0.61; others not tried]
inline constexpr double kTrackLossShare = 0.1;
/// Time that a track's sensor has to be outvoted before it disagrees. [s; chosen: ten cycles; the
/// sensor is not followed meanwhile; not tried]
inline constexpr double kTrackOutvoted_s = 0.1;
/// Time that the tracks' errors have to be apart before they disagree. [s; chosen: twice
/// kTrackOutvoted_s, as this tells smaller errors; not tried]
inline constexpr double kTracksApart_s = 0.2;
/// Difference of two track speeds that a vote of three takes as equal, beside a share of them.
/// [m/s; chosen: above noise and lag of the sensors; not tried]
inline constexpr double kTrackVoteMargin_mps = 0.15;
/// Share of the speed that slip may take in a vote against the body's speed. [-; chosen: twice
/// kTrackLossShare, as slip is more than losses; not tried]
inline constexpr double kTrackSlipShare = 0.2;
/// Difference of the two tracks' errors that is none, beside a share of the speed. [m/s; chosen:
/// losses and slip are the same on both sides, sensors are not; not tried]
inline constexpr double kTracksApartMargin_mps = 0.1;
/// Share of the speed by which the tracks' errors may differ on a straight track. [-; chosen: a
/// sensor that shows less than its speed by this share turns the machine; not tried]
inline constexpr double kTracksApartShare = 0.05;
/// Share of the speed by which the tracks' errors may differ on a curve. [-; chosen: there one side
/// drives and the other brakes, and they leak and slip differently: with kTracksApartShare, tried
/// first, healthy tracks passed for a fault; a sensor that turned the machine would have it steer
/// back]
inline constexpr double kTracksApartOnCurve = 0.2;

/// Time that both tracks have to stand though they should run. [s; chosen: as kTrackOff_s; an
/// engine takes longer to start; not tried]
inline constexpr double kTrackStands_s = 0.3;
/// Share of the speed of their displacements below which they stand. [-; chosen: half of what is
/// left to tracks that lose a third; not tried]
inline constexpr double kTrackStandsShare = 0.3;
/// Speed of their displacements from which they should run. [m/s; chosen: above the zeros of pump
/// and track sensors; not tried]
inline constexpr double kTrackStandsFrom_mps = 0.1;
/// Traction beyond the slope's, as a share of the weight, from which it is a load that holds the
/// tracks. [-; chosen: half of what rolling takes; not tried]
inline constexpr double kTrackPressShare = 0.05;

// Rest (dozer_watch.cpp)

/// Track speed below which a track stands. [m/s; chosen: above the noise of its sensor; not tried]
inline constexpr double kTrackAtRest_mps = 0.05;
/// Way of a track that nobody asks to run from which it is seen to. [m; chosen: more
/// than sheared ground springs back; not tried]
inline constexpr double kTrackRest_m = 0.15;
/// Speed up to which a track that nobody asks to run may be the zero of its sensor. [m/s; chosen: a
/// few times what the plant draws; 0 tried, with which one of 5 mm/s was a runaway each 30 s]
inline constexpr double kTrackZero_mps = 0.02;
/// Time until tracks have come to rest after their last command. [s; measured: 0.75 s at most in
/// `fault_cases --machine dozer --seeds 20`]
inline constexpr double kTrackRest_s = 1.2;
/// Way that a track goes until then, over its speed. [s; measured: 0.20 m at most at 1.6 m/s in
/// `fault_cases --machine dozer --seeds 20`]
inline constexpr double kTrackCoast_s = 0.125;
/// Time after motion until a machine counts as at rest that does not know its tracks' speeds. [s;
/// chosen: with its pumps at 0 it has stopped by then; not tried]
inline constexpr double kCoasting_s = 1.0;

// Commissioning of the tracks (travel_guard.cpp): displacements tried on a transmission that nobody
// knows

/// Most way to either side that may be confirmed. [m; chosen: what a pose's frame holds; not tried]
inline constexpr double kTravelMostWay_m = 15.0;
/// Time from a displacement to the last of what it does. [s; chosen: slowest servo, 0.15 s of dead
/// time, two lags of 0.15 s, and a machine of 9 t that gives way on its ground; not tried]
inline constexpr double kTravelUnderWay_s = 0.8;
/// Time until a machine that nothing drives has come to rest. [s; chosen: not tried]
inline constexpr double kTravelComesToRest_s = 1.5;
/// Least time to stop the machine in, before its window's end. [s; chosen: servo's lag, its
/// braking from 1 m/s, and what its speed is measured late by; not tried]
inline constexpr double kTravelStops_s = 0.8;
/// Way outside the window that is a fault. [m; chosen: farther than a machine that is stopped in
/// time ever is; not tried]
inline constexpr double kTravelOutside_m = 0.10;
/// Way against its displacement, or without any, that is a fault. [m; chosen: with what it then
/// still goes the machine stays within 150 mm; not tried]
inline constexpr double kTravelWrong_m = 0.06;
/// Time constant with which that way is forgotten. [s; chosen: as kGuardForget_s; not tried]
inline constexpr double kTravelForget_s = 5.0;
/// Low-pass of the guard's speed. [s; chosen: as kGuardSpeed_s; not tried]
inline constexpr double kTravelSpeedLag_s = 0.08;
/// Displacement of the pumps that moves any machine. [-; chosen: no servo's dead zone is wider; not
/// tried]
inline constexpr double kTravelSurelyMoves = 0.2;
/// Time that a machine may stand at such a displacement. [s; chosen: twice what is under way; not
/// tried]
inline constexpr double kTravelStands_s = 1.6;
/// Time that a window of the commissioning counts: those of all drives come by turns. [s; chosen:
/// as the excavator's; not tried]
inline constexpr double kDozerWindowHolds_s = 1.0;

}  // namespace graben
