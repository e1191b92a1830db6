#pragma once
/// Each track's speed: steady-state feed-forward (9) and PI, then the displacements that give it.

#include "firmware/dozer/hydrostatic.hpp"

namespace graben {

/// Of one track.
struct TrackState {
  double integral_mps = 0.0;
  double last_wanted_mps = 0.0;
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
