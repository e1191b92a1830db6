#pragma once
/// Whether cylinders and swing move as their spools let them.

#include <array>

#include "firmware/drives/cylinder_watch.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/safety/excavator_validation.hpp"

namespace graben {

/// What the watch needs of the last cycle, for each drive.
struct MotionWatchState {
  std::array<CylinderState, kDriveCount> drive{};
};

struct MotionWatchResult {
  FaultSet faults;  ///< kUncommandedMotion, kStrokeStuck
  MotionWatchState state;
};

/// Each cylinder as watch_cylinder has it, with `safety.uncommanded_m` and `safety.stuck_m`; the
/// swing, whose mass takes time to stop, with its own figures.
/// `asked_mps` is what the spools were opened for.
[[nodiscard]] MotionWatchResult watch_motion(const ExcavatorProfile& profile,
                                             const MotionWatchState& last, const ValidInputs& valid,
                                             const DriveVector& asked_mps, double period_s);

}  // namespace graben
