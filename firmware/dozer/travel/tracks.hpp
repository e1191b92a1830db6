// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The tracks: body speed to track speeds, the transmission between displacements and speeds (9),
/// and the control of each track's speed.

#include <algorithm>
#include <array>

#include "firmware/dozer/dozer_profile.hpp"

namespace graben {

/// u_l r and u_r r of (8), m/s, for the forward speed and the heading rate (left turn positive).
[[nodiscard]] inline std::array<double, kTrackCount> track_speeds_mps(const DozerBody& body,
                                                                      double speed_mps,
                                                                      double heading_radps) {
  const double turn_mps = heading_radps * body.half_gauge_m;
  return {speed_mps - turn_mps, speed_mps + turn_mps};
}

/// v_v,max of (13) for each track, m/s, from the fastest that each can run.
[[nodiscard]] inline std::array<double, kTrackCount> body_speeds_max_mps(
    const DozerBody& body, const std::array<double, kTrackCount>& track_max_mps,
    double heading_radps) {
  const double turn_mps = heading_radps * body.half_gauge_m;
  return {track_max_mps[kLeft] + turn_mps, track_max_mps[kRight] - turn_mps};
}

/// Displacement ratios of one path: epsilon_p in -1 .. 1, epsilon_m in motor_ratio_min .. 1.
struct Displacements {
  double pump_ratio = 0.0;
  double motor_ratio = 1.0;
};

/// Track speed u_j r of (9): what the displacements give at this engine speed, m/s. 0 for a motor
/// ratio that is not above 0.
[[nodiscard]] double track_speed_mps(const HstProfile& hst, double engine_radps, double pump_ratio,
                                     double motor_ratio);

/// Fastest track speed at this engine speed: epsilon_p = 1, epsilon_m = epsilon_m,min.
[[nodiscard]] double track_speed_max_mps(const HstProfile& hst, double engine_radps);

/// The inverse of (9): the pump first with the motor at full displacement, which gives the most
/// torque, then the motor. A speed beyond the fastest gets the fastest; without engine speed the
/// pump is at 0.
[[nodiscard]] Displacements displacements_for(const HstProfile& hst, double engine_radps,
                                              double speed_mps);

/// Of one track.
struct TrackState {
  double integral_mps = 0.0;
  double last_wanted_mps = 0.0;
  double expected_mps = 0.0;  ///< What has to have come of it by now.
};

struct TrackCommand {
  Displacements displacements;
  TrackState state;
};

/// Displacements that bring the track to `wanted_mps`: the inverse of (9) of what is wanted, a
/// displacement's lag ahead, and of the PI's correction. The integral is bounded and stands still
/// while the transmission can give no more.
[[nodiscard]] TrackCommand control_track(const DozerProfile& profile, const TrackState& last,
                                         double wanted_mps, double measured_mps,
                                         double engine_radps, double period_s);

}  // namespace graben
