#pragma once
/// Body speed to track speeds (8), and the body's largest speed that both tracks can follow (13).

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

}  // namespace graben
