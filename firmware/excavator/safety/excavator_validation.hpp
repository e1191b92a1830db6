#pragma once
/// The excavator's signals -> machine state: freshness, validity and plausibility, then the watches
/// of its drives and pumps.

#include "firmware/drives/drive_validation.hpp"
#include "firmware/drives/drive_watch.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/excavator_signals.hpp"
#include "firmware/safety/common_inputs.hpp"

namespace graben {

/// Inputs that may be used; what the machine does not have stays 0. Of the swing motor the left
/// port counts as cap, the right one as rod side.
struct ExcavatorValid : CommonValid {
  std::array<ValidDrive, kDriveCount> drive{};
  std::array<double, kPumpCount> swash_ratio{};
  std::array<double, kPumpCount> pump_flow_m3ps{};  ///< v omega tan(alpha) of (25).

  [[nodiscard]] DriveVector strokes_m() const {
    return {drive[0].stroke_m, drive[1].stroke_m, drive[2].stroke_m, drive[3].stroke_m};
  }
};

/// A signal is missing when it was never valid or is older than control.sensor_timeout_s. `moving`:
/// the mode of the last cycle was Armed or Active; then what only degrades does not stop, and a
/// stroke that changed faster than its drive can is rejected: the last one ages until it is
/// missing, or the strokes come back to it. `accepted` keeps that from cycle to cycle. Another
/// machine's swing signals are not looked at.
[[nodiscard]] ExcavatorValid validate(const ExcavatorProfile& profile, DriveRows drives,
                                      const ExcavatorInputs& inputs, bool moving, TimeUs now_us,
                                      Span<Believed> accepted);

/// Time that each pump's swash has differed from its command, s.
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
