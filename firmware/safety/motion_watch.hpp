#pragma once
/// Whether the cylinders move as their spools let them.

#include <array>

#include "firmware/machine/excavator_profile.hpp"
#include "firmware/safety/validation.hpp"

namespace graben {

/// What the watch needs of the last cycle, for each cylinder.
struct MotionWatchState {
  struct Axis {
    int direction = 0;       ///< Where the spool lets the oil go; 0 while it is closed.
    double since_s = 0.0;    ///< Since it has been so.
    double anchor_m = 0.0;   ///< Furthest that the cylinder was allowed to come.
    double still_m = 0.0;    ///< Stroke at its last change.
    double unmoved_m = 0.0;  ///< What it was asked to move since then.
  };
  std::array<Axis, kAxisCount> axis{};
};

struct MotionWatchResult {
  FaultSet faults;  ///< kUncommandedMotion, kStrokeStuck
  MotionWatchState state;
};

/// Uncommanded: with its spool closed a cylinder leaves the place where it came to rest, or it runs
/// back against its open spool, by more than `safety.uncommanded_m`. What oil gives way under a
/// load is less; leakage, which creeps, is forgotten within seconds.
///
/// Stuck: with its spool open in the direction asked for, a stroke stands still to within its
/// resolution while `safety.stuck_m` were asked of it. `asked_mps` is what the spools were
/// opened for.
[[nodiscard]] MotionWatchResult watch_motion(const ExcavatorProfile& profile,
                                             const MotionWatchState& last, const ValidInputs& valid,
                                             const Eigen::Vector3d& asked_mps, double period_s);

}  // namespace graben
