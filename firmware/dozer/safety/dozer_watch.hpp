#pragma once
/// The dozer against what it was told: all watches, and what they take away.

#include "firmware/dozer/safety/transmission_watch.hpp"
#include "firmware/drives/cylinder_watch.hpp"
#include "firmware/drives/spool_follow.hpp"
#include "firmware/safety/degrade.hpp"

namespace graben {

struct DozerWatchState {
  SpoolState spool;
  int echo_cycles = 0;  ///< In a row, that the echo has differed.
  CylinderState blade;
  TransmissionWatchState transmission;
  SlowingState slowing;
  bool closing = false;    ///< It was in motion, and the spool has not been in its middle since.
  bool returning = false;  ///< It was in motion, and some pump has not been near 0 since.
};

/// What the last cycle did.
struct DozerLastCycle {
  bool moving = false;  ///< Armed or Active.
  bool enable = false;
  double blade_duty_ratio = 0.0;
  std::array<double, kTrackCount> pump_ratio{};
  std::array<double, kTrackCount> motor_ratio = {1.0, 1.0};
  double asked_mps = 0.0;  ///< What the blade's spool was opened for; extension is positive.
};

/// The inputs as they came, with the watches' faults, and the operator's speed times
/// `safety.degraded_speed` while anything is degraded; `state` goes on by a cycle.
///
/// Outside motion the machine may be moved by hand: blade and transmission are then not judged, and
/// every watch begins afresh. Only the spool and the displacements are, until they have been
/// neutral once or the operator has taken over in manual mode: what stays open or stroked when the
/// deadman is let go is stuck or runs away. What degrades goes on doing so for 0.5 s.
[[nodiscard]] ValidDozerInputs watch(const DozerProfile& profile, DozerWatchState& state,
                                     const DozerLastCycle& cycle, const ValidDozerInputs& inputs,
                                     double period_s);

/// Whether the blade's spool is near its middle: the machine is not being moved by hand.
[[nodiscard]] bool spool_centred(const DozerProfile& profile, const ValidDozerInputs& valid);

}  // namespace graben
