// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is found of a dozer from its logs, each value with its standard deviation. SI units; ratios
/// are of the full travel or displacement.

#include <array>
#include <string>
#include <vector>

#include "app/identify/machine/estimate.hpp"
#include "firmware/dozer/dozer_signals.hpp"

namespace graben::identify {

/// One side of a spool of the blade.
struct BladeSideEstimate {
  OpeningCurve curve;  ///< Flow over the spool's travel.
  Estimate edge;       ///< Of the curve.
  Estimate dead_time_s;
  Estimate lag_s;             ///< From its command to the drive's speed, dead time apart.
  double driven_least = 0.0;  ///< Least and most duty that moved it; both 0: none did.
  double driven_most = 0.0;

  [[nodiscard]] bool known() const { return driven_most > 0.0; }
};

struct BladeDriveEstimate {
  BladeSideEstimate extend;
  BladeSideEstimate retract;
  Estimate valve_flow_m3ps;  ///< Of the spool fully open.

  [[nodiscard]] BladeSideEstimate& side(bool extends) { return extends ? extend : retract; }
  [[nodiscard]] const BladeSideEstimate& side(bool extends) const {
    return extends ? extend : retract;
  }
};

/// A track to one side, on the level with nothing before the blade.
struct TrackSideEstimate {
  Estimate speed_factor;  ///< Of what (9) gives by the profile, with the measured displacements.
  double slip = 0.0;      ///< Share of the track's speed that the body lacks.
  double most_pa = 0.0;   ///< Higher line's pressure, largest while it was tried.
};

struct TravelEstimate {
  std::array<TrackSideEstimate, kTrackCount> forward;
  std::array<TrackSideEstimate, kTrackCount> back;
  Estimate pump_dead_time_s;
  Estimate pump_lag_s;
  Estimate motor_dead_time_s;
  Estimate motor_lag_s;
  double driven_least = 0.0;  ///< Displacements of the pumps at which they were judged.
  double driven_most = 0.0;

  [[nodiscard]] bool known() const { return driven_most > 0.0; }
  /// Of both tracks, both ways.
  [[nodiscard]] Estimate speed_factor() const;
};

struct DozerEstimate {
  std::array<BladeDriveEstimate, 2> blade;  ///< Lift and tilt.
  Estimate pump_flow_factor;                ///< Of the profile's implement pump.
  TravelEstimate travel;
  std::vector<std::string> missing;  ///< What the logs do not support, a sentence each.
};

}  // namespace graben::identify
