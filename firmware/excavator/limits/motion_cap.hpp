// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What ends of drives and fences leave of a motion, in every cycle.

#include "firmware/drives/velocity_cap.hpp"
#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/fences/fence_margin.hpp"
#include "firmware/excavator/limits/tuning.hpp"

namespace graben {

/// A cap, and which drives it is for: 0 for one that has to stand, else 1.
struct MotionCap : VelocityCap {
  DriveVector share = DriveVector::Ones();
};

/// One factor on the whole velocity before the ends of the drives (approach_ends) and before the
/// fences, which what is nearest to them is stopped at, held_margin_m() before it, with
/// line.acceleration_mps2. Beyond a fence whatever leads no further is free: the motion as a whole,
/// or else those drives of it that by themselves do not lead further. `then_m` and `velocity_mps`
/// are travels. What is not finite or can't be is 0, and no limit named.
///
/// `coast_m` is what the swing turns on by its own momentum, as swing_coast_m() has it: before
/// fences it is taken to be there already. `zero_m`: heights over a design are seen too high by so
/// much.
[[nodiscard]] MotionCap motion_cap(const ExcavatorProfile& profile, DriveRows drives,
                                   const SwingKinematics& kinematics, const FenceView& fences,
                                   const DriveVector& then_m, const DriveVector& velocity_mps,
                                   double coast_m = 0.0, double zero_m = 0.0);

/// How far the platform turns on by what it turns faster than it was asked to (m/s at the lever):
/// it lags behind its spool, and swings about its place.
[[nodiscard]] inline double swing_coast_m(double measured_mps, double asked_mps) {
  return kPlatformLag_s * (measured_mps - asked_mps);
}

}  // namespace graben
