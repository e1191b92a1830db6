// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/hand/assist.hpp"

#include <cmath>

namespace graben {

AssistLine assist_line(const ExcavatorProfile& profile, const FenceSet& fences, double swing_rad,
                       const Eigen::Vector2d& shown_off_m) {
  AssistLine line;
  const Fence& last = fences.fence[fences.count > 0 ? static_cast<unsigned>(fences.count - 1) : 0U];
  line.known = fences.count > 0 && last.guard == FenceGuard::kTeeth;
  if (!line.known) {
    return line;
  }
  const double cosine = std::cos(swing_rad);
  const double sine = std::sin(swing_rad);
  // The fence looks into the ground.
  const Eigen::Vector2d up(-last.normal.x() * cosine - last.normal.y() * sine, -last.normal.z());
  const double across = last.normal.x() * sine - last.normal.y() * cosine;
  const double corner_m = 0.5 * profile.geometry.body.bucket_width_m * std::abs(across);
  const double length = up.norm();
  line.up = up / length;
  line.from_foot_m = (corner_m - last.offset_m) / length + profile.assist.offset_m +
                     line.up.dot(shown_off_m - profile.geometry.boom_foot_m);
  return line;
}

}  // namespace graben
