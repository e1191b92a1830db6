#pragma once
/// Slowing down before the end of a cylinder, or of the swing's range.

#include "firmware/core/codes.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben {

/// A factor (0 .. 1) on the wanted velocity, all drives alike, so that its direction stays.
struct VelocityCap {
  double factor = 1.0;
  Limit limit;
};

/// Slows down so that no cylinder nears its end faster than control.stroke_end_gain_ps times what
/// is left of its stroke; so does the swing with its range.
[[nodiscard]] VelocityCap stroke_end_cap(const ExcavatorProfile& profile,
                                         const DriveVector& strokes_m,
                                         const DriveVector& velocity_mps);

}  // namespace graben
