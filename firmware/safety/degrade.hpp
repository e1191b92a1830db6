#pragma once
/// What the watches take away, whatever the machine: stop, go on slower, and still closing after
/// motion.

#include "firmware/safety/common_inputs.hpp"

namespace graben {

/// What degraded of late, and how long it still does.
struct SlowingState {
  FaultSet faults;
  double for_s = 0.0;
};

/// Adds faults that stop; what came in as the first stays it.
void stop(const FaultSet& faults, CommonValid& inputs);

/// Adds one that only slows.
void degrade(Fault fault, CommonValid& inputs);

/// The operator's speed times `speed_ratio` while anything is degraded, and for 0.5 s after: a
/// value that comes and goes must not make the machine jerk. Outside motion nothing is slowed or
/// remembered.
[[nodiscard]] SlowingState slow_down(double speed_ratio, const SlowingState& last, bool moving,
                                     double period_s, CommonValid& inputs);

/// Whether something has still to come to neutral after motion: not `centred` since, and the
/// operator has not taken over in manual mode. What is not known does not end it; with `unknown`,
/// `centred` is not.
[[nodiscard]] bool still_closing(bool last, bool centred, Fault unknown, const CommonValid& inputs);

}  // namespace graben
