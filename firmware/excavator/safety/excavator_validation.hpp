// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator's signals -> machine state: freshness, validity and plausibility, then the watches
/// of its drives, pumps and second sensors.

#include "firmware/drives/drive_validation.hpp"
#include "firmware/drives/drive_watch.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/excavator_signals.hpp"
#include "firmware/excavator/safety/supply_watch.hpp"
#include "firmware/safety/common_inputs.hpp"
#include "firmware/safety/witness.hpp"

namespace graben {

/// True where the task is to move something by the operator's levers.
[[nodiscard]] inline bool is_by_lever(Task task) {
  return task == Task::kJog || task == Task::kCoordinated || task == Task::kAssist;
}

/// Inputs that may be used; what the machine does not have stays 0. Of the swing motor the left
/// port counts as cap, the right one as rod side.
struct ExcavatorValid : CommonValid {
  std::array<ValidDrive, kDriveCount> drive{};
  std::array<double, kPumpCount> swash_ratio{};
  std::array<double, kPumpCount> pump_flow_m3ps{};  ///< v omega tan(alpha) of (25).
  std::array<double, kDriveCount> lever_ratio{};    ///< 0 where they are not known.
  std::array<double, kAxisCount> tried_ratio{};     ///< The same of duties.
  std::array<StrokeWindow, kAxisCount> window{};    ///< As constructed where none is confirmed.

  [[nodiscard]] DriveVector strokes_m() const {
    return {drive[0].stroke_m, drive[1].stroke_m, drive[2].stroke_m, drive[3].stroke_m};
  }
  /// Nothing that moves by hand is asked for: every lever, every duty to try.
  [[nodiscard]] bool hands_rest() const;
};

/// A signal is missing when it was never valid or is older than control.sensor_timeout_s. `moving`:
/// the mode of the last cycle was Armed or Active; then what only degrades does not stop, and a
/// stroke that changed faster than its drive can is rejected: the last one ages until it is
/// missing, or the strokes come back to it. Levers and duties are the operator's: a task that goes
/// by them needs them as fresh. `accepted` keeps that from cycle to cycle. Another machine's swing
/// signals are not looked at. `strokes_m`, one an axis, go before those of the inputs: of a machine
/// that measures angles (imu_joints.hpp).
[[nodiscard]] ExcavatorValid validate(const ExcavatorProfile& profile, DriveRows drives,
                                      const ExcavatorInputs& inputs, bool moving, TimeUs now_us,
                                      Span<AcceptedStroke> accepted,
                                      Span<const Signal<double>> strokes_m = {nullptr, 0});

/// Of each pump from cycle to cycle.
struct SwashState {
  double off_s = 0.0;       ///< Time that its swash has not been where its commands send it.
  double slow_ratio = 0.0;  ///< Where a pump that takes its time would be.
};
using SwashStates = std::array<SwashState, kPumpCount>;

/// True where a pump's swash has been off its command by more than `safety.swash_tolerance` for
/// longer than kSwashServo_s, which its servo takes at most; then `swash_ratio`, with which the
/// flow is reckoned, becomes the smaller of the two. A command that moves is anything from
/// `wanted_ratio` to where a pump would be that lags behind it by 0.25 s. Not `commanded`, nothing
/// is asked of it.
[[nodiscard]] bool watch_swash(const ExcavatorProfile& profile, bool commanded,
                               const std::array<double, kPumpCount>& wanted_ratio, double period_s,
                               std::array<double, kPumpCount>& swash_ratio, SwashStates& state);

struct ExcavatorWatchState {
  DriveWatchState<kDriveCount> drives;
  SwashStates swash{};
  SuppliesState supply;
  SlowingState slowing;
};

/// Adds the watches' faults to `valid`, and the pumps' flow; takes off the operator's speed
/// (`safety.degraded_speed`) while anything is degraded, and for kSlowAfter_s after. `state` goes
/// on by a cycle. `swash_ratio` is what the last cycle told the pumps. See watch_drives(). Drives
/// that get nothing of their pumps (watch_supplies()) are kEngineDoubtful, which stops.
void watch(const ExcavatorProfile& profile, DriveRows drives, const LastCommands<kDriveCount>& last,
           const std::array<double, kPumpCount>& swash_ratio, double period_s,
           ExcavatorWatchState& state, ExcavatorValid& valid);

/// Of a machine's second sensors (second_sensors.cpp).
using SecondStates = std::array<WitnessState, kDriveCount>;

/// In every mode, of every joint that has a second sensor: kWitnessDisagrees where it contradicts
/// the first one, which stops; kWitnessMissing where it is not there, valid and in time. In motion
/// that slows; at rest it keeps from arming, unless the profile allows to work without it. A first
/// sensor that is lost is the validation's to find.
void watch_seconds(const ExcavatorProfile& profile, DriveRows drives, const ExcavatorInputs& inputs,
                   bool moving, TimeUs now_us, SecondStates& states, ExcavatorValid& valid);

}  // namespace graben
