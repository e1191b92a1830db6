#pragma once
/// Slowing down before the end of a cylinder.

#include <Eigen/Core>

#include "firmware/core/codes.hpp"
#include "firmware/machine/excavator_profile.hpp"

namespace graben {

/// A factor (0 .. 1) on the wanted velocity, all axes alike, so that its direction stays.
struct VelocityCap {
  double factor = 1.0;
  Limit limit;
};

/// Slows down so that no cylinder nears its end faster than control.stroke_end_gain_ps times what
/// is left of its stroke.
[[nodiscard]] VelocityCap stroke_end_cap(const ExcavatorProfile& profile,
                                         const Eigen::Vector3d& strokes_m,
                                         const Eigen::Vector3d& velocity_mps);

}  // namespace graben
