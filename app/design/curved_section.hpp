// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A surface along a track that curves in plan.

#include "app/design/plan_track.hpp"
#include "app/design/track_section.hpp"

namespace graben::design {

/// Every kSectionStep_m along the track: the height of the surface, `datum_m` lower, the slope
/// across it, at right angles to the track, between the places of the blade's ends, and the
/// track's curvature. Throws as along_track; for a blade that does not tilt, whose edge would lie
/// askew to the track; and for a track out of length.
[[nodiscard]] machines::DesignLine along_curved_track(const Surface& surface,
                                                      const PlanTrack& track, double datum_m,
                                                      const BladeAcross& blade);

inline constexpr double kSectionStep_m = 0.02;

}  // namespace graben::design
