#pragma once
/// Slowing down before the end of a cylinder, of the swing's range, before a fence.

#include "firmware/drives/stroke_end.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/tasks/fence.hpp"

namespace graben {

/// Each limit stands this far behind what it guards, so that it slows to nothing there and not at
/// the very place. At the place itself the machine may still close at stroke_end_gain times it,
/// which is what makes sliding along possible: a line along a fence, or a move that ends where a
/// cylinder does, closes now and then at the size of rounding, of the curvature within a cycle, of
/// a feedback's correction. With the limit at the place itself, any of them would stop the whole
/// machine, let it go and stop it again. A feedback weaker than stroke_end_gain towards a plan that
/// is not beyond the limit is never slowed at all.
///
/// All are a part of the millimetre by which a limit may be overrun.
inline constexpr double kFenceSlack_m = 0.2e-3;
inline constexpr double kStrokeSlack_m = 0.05e-3;   ///< Half of what a stroke sensor resolves.
inline constexpr double kSwingSlack_rad = 0.02e-3;  ///< 0.2 mm of teeth 10 m away.

/// Closing slower than this, m/s or rad/s, is rounding: free even beyond a limit.
inline constexpr double kStandsStill = 1e-9;

/// One factor on the whole velocity (strokes m/s, swing rad/s), so that its direction stays, and
/// what holds it: kStrokeEnd with the drive, kSwingEnd, kFence with its index.
///
/// A limit at `distance` (slack included) lets the machine close at most at
/// min(control.stroke_end_gain_ps * distance, sqrt(2 * deceleration * distance)), not at all
/// beyond; moving away is free. Deceleration: of the cylinder, line.cylinder_acceleration_mps2; of
/// the swing, swing.acceleration_max_radps2; of a point before a fence, line.acceleration_mps2.
///
/// `then` is where the drives will be when all that is under way has arrived (strokes_then): of a
/// machine with dead time and lag, that place is what the velocity moves at once, so that nothing
/// overshoots. The swing is looked at where the machine has one. Not finite: 0, and no limit named.
[[nodiscard]] VelocityCap soft_limit(const ExcavatorProfile& profile,
                                     const SwingKinematics& kinematics, const FenceSet& fences,
                                     const DriveVector& then, const DriveVector& velocity);

}  // namespace graben
