// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fourth stage of a dozer's cycle: how fast it may drive, so that flow, blade, ground ahead and
/// track let the edge keep the design, and what that is of each track.

#include "firmware/dozer/motion/motion.hpp"
#include "firmware/dozer/travel/course.hpp"
#include "firmware/dozer/travel/speed_limit.hpp"

namespace graben {

/// State from cycle to cycle.
struct TravelLimitState {
  SpeedState speed;
  SteeringState steering;  ///< Of a design whose track curves.
};

/// How the way is followed.
struct Travel {
  SpeedChoice speed;
  SteeringState steering;
  double off_track_m = 0.0;  ///< Of a track that curves, the edge's middle left of it.
  std::array<double, kTrackCount> track_mps{};
};

/// v_c of this cycle, on the way back from a pass too, and both tracks' speeds for it.
[[nodiscard]] Travel flow_limited(const DozerModel& machine, const DozerValid& valid,
                                  const DozerEstimates& estimates, const Preview& preview,
                                  const BladeMotion& motion, double period_s,
                                  const TravelLimitState& state);

/// After a cycle. Out of motion nothing is kept.
void go_on(const Travel& travel, bool active, TravelLimitState& state);

}  // namespace graben
