// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/fences/fence_margin.hpp"

namespace graben {

DriveVector unsure_drives(const ExcavatorProfile& profile) {
  const FenceProfile& fence = profile.fence;
  return {fence.stroke_error_m, fence.stroke_error_m, fence.stroke_error_m,
          profile.has_swing() ? fence.swing_error_rad : 0.0};
}

double held_margin_m(const FenceProfile& profile, const Fence& fence, const MachineMotion& motion,
                     const FenceGap& gap) {
  return fence.guard == FenceGuard::kTeeth ? 0.0 : motion.at(gap.point).unsure_m + profile.give_m;
}

double planned_margin_m(const FenceProfile& profile, const Fence& fence,
                        const MachineMotion& motion, const FenceGap& gap, double rate_ps) {
  if (fence.guard == FenceGuard::kTeeth) {
    return 0.0;
  }
  const double speed_mps = rate_ps * motion.at(gap.point).velocity_mps.norm();
  return held_margin_m(profile, fence, motion, gap) + profile.room_m + profile.room_s * speed_mps;
}

}  // namespace graben
