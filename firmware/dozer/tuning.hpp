// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers of the dozer's blade, tilt and pump that were chosen, each with why.

namespace graben {

// Lift and tilt as drives (blade.cpp, blade.hpp)

/// Way that the oil may move a blade cylinder whose stroke stands still, before the sensor counts
/// as frozen. [m; chosen: 50 to 80 mm of the cutting edge; no pressure tells a sensor that is stuck
/// from a blade that the ground holds; not tried]
inline constexpr double kBladeUnseen_m = 0.015;
/// Largest distance of a blade cylinder's stroke from all that its oil can have done. [m; chosen:
/// 50 to 80 mm of the cutting edge, for the reason of kBladeUnseen_m; not tried]
inline constexpr double kBladeOff_m = 0.015;
/// Largest speed of lift and tilt towards an end of their stroke, per metre left. [1/s; chosen: the
/// cylinder meets its end at a speed near 0; not tried]
inline constexpr double kBladeEndGain_ps = 4.0;

// Blade on the grade (blade_control.cpp)

/// Descent of an edge that is above the design, per metre of way. [-; measured: tried on all soils;
/// twice as steep, the edge rides on the ground instead of cutting it; `sweep.py`: grade's
/// rmse_error_true_m 2.7; x0.7 2.77, x1.3 2.67]
inline constexpr double kBladeSinkSlope = 0.1;
/// Share of the task's tolerance that an edge may be too high and still come down at
/// kBladeSinkSlope; the rest is taken back by the feedback's gain. [-; chosen: tried on all soils
/// with kBladeSinkSlope]
inline constexpr double kBladeNoHurry = 0.5;

// Travel and blade of a cycle (estimation/situation.cpp, limits/limits.cpp, motion/motion.cpp)

/// Time from a lower wanted speed to a slower machine: displacements, drive line, PI of the tracks.
/// [s; measured: 0.2 tried before; 0.04 more since the drive's lag behind a falling speed is known;
/// `sweep.py`: grade's max_error_true_m 11.1; x0.7 12, x1.3 11.2]
inline constexpr double kTravelLead_s = 0.24;
/// Share of the task's tolerance that the blade may leave standing on purpose; the rest is for what
/// nobody foresees. [-; measured: tried 0.40, 0.33, 0.31 and 0.30; at 2000 rpm the edge is 11.0 mm
/// off the grade with 0.30, 9.9 mm with this; `sweep.py`: grade's rmse_error_true_m 2.7; x0.7 2.33,
/// x1.3 3.21]
inline constexpr double kGradeLiftShare = 0.29;

// Flow that the implement's pump gives (flow_share.cpp)

/// Lower bound of the pump's flow share, measured over modelled flow. [-; measured: a pump that
/// gives less is broken, and a blade that moves so slowly is held by something else; `sweep.py`:
/// grade's max_error_true_m 11.1; x0.7 11.1, x1.3 11.7]
inline constexpr double kFlowShareLeast = 0.8;
/// Low-pass of the flow share. [s; chosen: as long as kFlowShareCounted_s; not tried]
inline constexpr double kFlowShareLearn_s = 0.1;
/// Time over which the oil that is due and the oil that is taken are summed up. [s; chosen: long
/// against a stroke's resolution, short against one raise of the blade; not tried]
inline constexpr double kFlowShareCounted_s = 0.1;
/// Time that the blade has to rise fast before the flow share is learnt. [s; chosen: half of
/// kFlowShareCounted_s; not tried]
inline constexpr double kFlowShareWarm_s = 0.05;
/// Share of the modelled flow that a blade has to ask for before the flow share is learnt. [-;
/// measured: with less the valves hold the flow, not the pump; `sweep.py`: grade's max_error_true_m
/// 11.1; x0.7 11.1, x1.3 11.5]
inline constexpr double kFlowShareFast = 0.8;
/// Share of the due oil below which the pump counts as giving less. [-; measured: a sound pump
/// gives all, less what strokes resolve; `sweep.py`: grade's edge_jerk_rms_mps3 15.5; x0.7 15.5,
/// x1.3 14.6]
inline constexpr double kFlowShareComes = 0.96;

// Bounds that a division needs (mobile_jacobian.cpp, tilt.cpp, tilt_control.cpp)

/// Lever of the lift's joint along the design's normal, below which the joint is not asked to move
/// the edge. [m; chosen: far below the lever of any pose of a blade; not tried]
inline constexpr double kBladeLeastLever_m = 0.05;
/// Share of the edge's direction across the track, below which the edge's slope is computed with
/// this share. [-; chosen: an edge turned by 84 degrees, which no machine reaches; not tried]
inline constexpr double kEdgeLeastAcross = 0.1;
/// Change of the edge's slope per tilt angle, below which the tilt is computed with this value. [-;
/// chosen: a blade that hardly turns its edge across the track; not tried]
inline constexpr double kTiltLeastAnswer = 0.2;

}  // namespace graben
