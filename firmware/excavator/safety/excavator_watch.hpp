#pragma once
/// The excavator against its commands: the watches of its drives, and its pumps'.

#include "firmware/drives/drive_watch.hpp"
#include "firmware/excavator/safety/excavator_validation.hpp"
#include "firmware/safety/degrade.hpp"

namespace graben {

/// How long each pump's swash has differed from its command, s.
using SwashState = std::array<double, kPumpCount>;

/// True where a pump's swash has been off its command by more than `safety.swash_tolerance` for
/// longer than 0.5 s, which its servo takes at most; then `swash_ratio`, with which the flow is
/// reckoned, becomes the smaller of the two. Not `commanded`, nothing is asked of it.
[[nodiscard]] bool watch_swash(const ExcavatorProfile& profile, bool commanded, double period_s,
                               std::array<double, kPumpCount>& swash_ratio, SwashState& state);

struct ExcavatorWatchState {
  DriveWatchState<kDriveCount> drives;
  SwashState swash{};
  SlowingState slowing;
};

/// Adds the watches' faults to `valid`, and the pumps' flow; takes off the operator's speed
/// (`safety.degraded_speed`) while anything is degraded, and for 0.5 s after. `state` goes on by a
/// cycle. See watch_drives().
void watch(const ExcavatorProfile& profile, DriveRows drives, const LastCommands<kDriveCount>& last,
           double period_s, ExcavatorWatchState& state, ExcavatorValid& valid);

}  // namespace graben
