// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far the machine keeps from a fence: as far as it may be nearer than it is thought to be. In
/// the cycle and at planning alike; a planned way keeps some more, so that the cycle does not hold
/// what was planned.
///
///   held     the sum of what each drive's sensor may be off by does to the point, at its pose
///            (PointMotion::unsure_m), and what the machine gives on its oil and in its bearings
///            when it is stopped there (FenceProfile::give_m);
///   planned  the same, and what the teeth may be off their plan while it goes on
///            (FenceProfile::room_m, room_s).
///
/// A design surface is made, not kept away from: its margin is 0.

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/fences/fence.hpp"

namespace graben {

/// By how much each drive may be elsewhere than it is measured, m and rad.
[[nodiscard]] DriveVector unsure_drives(const ExcavatorProfile& profile);

/// Of what is nearest to the fence in `gap`.
[[nodiscard]] double held_margin_m(const FenceProfile& profile, const Fence& fence,
                                   const MachineMotion& motion, const FenceGap& gap);

/// The same of a way whose drives have `motion`'s rates by its share, which goes on by
/// `rate_ps` at most.
[[nodiscard]] double planned_margin_m(const FenceProfile& profile, const Fence& fence,
                                      const MachineMotion& motion, const FenceGap& gap,
                                      double rate_ps);

}  // namespace graben
