#pragma once
/// The dozer against what it was told: all watches, and what they take away.

#include "firmware/dozer/safety/transmission_watch.hpp"
#include "firmware/drives/drive_watch.hpp"
#include "firmware/safety/degrade.hpp"

namespace graben {

struct DozerWatchState {
  DriveWatchState<kBladeCount> drives;
  TransmissionWatchState transmission;
  SlowingState slowing;
  bool returning = false;  ///< It was in motion, and some pump has not been near 0 since.
};

/// Commands of the last cycle.
struct DozerLastCommands {
  LastCommands<kBladeCount> drives;
  SentRatios ratios;
};

/// Adds the watches' faults to `valid`; takes off the operator's speed (`safety.degraded_speed`)
/// while anything is degraded, and for 0.5 s after. `state` goes on by a cycle. See watch_drives():
/// the displacements are checked outside motion too, until they have been neutral once or the
/// operator has taken over in manual mode; what stays stroked when the deadman is let go runs away.
void watch(const DozerProfile& profile, DriveRows drives, const DozerLastCommands& last,
           double period_s, DozerWatchState& state, DozerValid& valid);

}  // namespace graben
