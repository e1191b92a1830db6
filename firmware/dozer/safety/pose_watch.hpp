// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Checks that what is measured of the body's motion fits together: position and velocity, height
/// and climb, pitch and its rate, roll and its rate, offset from the track and heading, heading and
/// yaw rate, the climb and the slope that it drives up, velocity and tracks. A sensor that is
/// frozen with a live counter shows only here.

#include "firmware/dozer/safety/dozer_validation.hpp"
#include "firmware/dozer/safety/tuning.hpp"

namespace graben {

/// A quantity's change less what another one says that it should have changed by, of late.
struct PoseResidual {
  double value = 0.0;
};

/// State from cycle to cycle; as constructed it begins with the next one.
struct PoseWatchState {
  bool has_begun = false;
  double position_m = 0.0;  ///< Of the last cycle ...
  double height_m = 0.0;
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
  double ahead_m = 0.0;     ///< Position against velocity.
  double climbed_m = 0.0;   ///< Height against climb.
  double turned_rad = 0.0;  ///< Pitch against its rate.
  double rolled_rad = 0.0;  ///< Roll against its rate.
  double offset_m = 0.0;
  double aside_m = 0.0;  ///< Offset from the track against heading and velocity.
  double heading_rad = 0.0;
  double yawed_rad = 0.0;  ///< Heading against the yaw rate, less what the track turns.
  double uphill_m = 0.0;   ///< Climb against the slope that the pitch says.
  double slipped_m = 0.0;  ///< Velocity against the tracks, slip taken off.
  double nods_rad = 0.0;   ///< As turned_rad, over a longer time: a slow drift.
  double rocks_rad = 0.0;  ///< The same of roll.
  double later_m = 0.0;    ///< As ahead_m, over a longer time: a pose that comes later and later.
  double behind_m = 0.0;   ///< The body's way less than the tracks', beyond what these may slip;
  double before_m = 0.0;   ///< and more.
};

/// Speed along the ground that speaks best for the measured velocity: of a track's sensor or of
/// what both transmissions give. One of them can be wrong without the velocity being so.
struct GroundSpeeds {
  double left_mps = 0.0;
  double right_mps = 0.0;
  double transmission_mps = 0.0;
  double way_mps = 0.0;  ///< Of the track whose sensor speaks best; it alone counts over a way.
  double traction_share = 0.0;  ///< Of the tracks, of the weight; 0: not known.
};

/// True: they do not fit. `curvature_pm`: of the track where the body is, to the left positive.
/// `state` goes on by a cycle.
[[nodiscard]] bool watch_pose(const DozerValid& valid, const GroundSpeeds& speeds,
                              double curvature_pm, double period_s, PoseWatchState& state);

}  // namespace graben
