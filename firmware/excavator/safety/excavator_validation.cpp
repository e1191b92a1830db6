// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/safety/excavator_validation.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/safety/tuning.hpp"
#include "firmware/excavator/swing.hpp"
#include "firmware/hydraulics/flow.hpp"

namespace graben {
namespace {

/// No pressure is below nothing because of its zero.
double above_zero(double shown, double zero) {
  const double value = shown - zero;
  return zero > 0.0 && value < 0.0 ? 0.0 : value;
}

/// All drives' signals alike: the swing as the travel at its lever, extending to the left; each
/// sensor's zero taken off.
std::array<DriveInputs, kDriveCount> drive_inputs(const ExcavatorInputs& inputs,
                                                  const ExcavatorProfile& profile,
                                                  Span<const Signal<double>> strokes_m) {
  std::array<DriveInputs, kDriveCount> drives = {inputs.axis[kBoom], inputs.axis[kArm],
                                                 inputs.axis[kBucket],
                                                 swing_inputs(inputs.swing, profile.swing)};
  const SensorZeros& zero = profile.sensor_zero;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    DriveInputs& drive = drives[axis];
    if (strokes_m.count() > 0) {
      drive.stroke_m = strokes_m[static_cast<int>(axis)];
    }
    drive.stroke_m.value -= zero.stroke_m[axis];
    drive.cap_pressure_pa.value = above_zero(drive.cap_pressure_pa.value, zero.cap_pa[axis]);
    drive.rod_pressure_pa.value = above_zero(drive.rod_pressure_pa.value, zero.rod_pa[axis]);
  }
  return drives;
}

/// False: not all of them may be used, and they stay as they were.
template <std::size_t count>
bool read_all(const Signal<std::array<double, count>>& from, const Freshness& fresh,
              std::array<double, count>& to) {
  bool usable = fresh.holds(from);
  for (const double each : from.value) {
    usable = usable && std::isfinite(each);
  }
  if (usable) {
    to = from.value;
  }
  return usable;
}

/// What the operator's hands do, as far as the task goes by it.
void read_hands(const ExcavatorInputs& inputs, const Freshness& fresh, TimeUs now_us,
                ExcavatorValid& valid) {
  const bool has_levers = read_all(inputs.lever_ratio, fresh, valid.lever_ratio);
  const bool has_duties = read_all(inputs.tried_ratio, fresh, valid.tried_ratio);
  const bool by_lever = is_by_lever(valid.task);
  const bool tries = valid.task == Task::kCommission;
  if ((by_lever && !has_levers) || (tries && !has_duties)) {
    valid.faults.add(Fault::kOperatorMissing);
  }
  const auto at_rest = std::count(valid.tried_ratio.begin(), valid.tried_ratio.end(), 0.0);
  if (tries && kAxisCount - at_rest > kTriedMost) {
    valid.faults.add(Fault::kCommissionBound);
  }
  const Freshness lately(kWindowHolds_s, now_us);
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    if (lately.holds(inputs.window[axis])) {
      valid.window[axis] = inputs.window[axis].value;
    }
  }
}

}  // namespace

bool ExcavatorValid::hands_rest() const {
  const auto rests = [](double ratio) { return ratio == 0.0; };
  return std::all_of(lever_ratio.begin(), lever_ratio.end(), rests) &&
         std::all_of(tried_ratio.begin(), tried_ratio.end(), rests);
}

ExcavatorValid validate(const ExcavatorProfile& profile, DriveRows drives,
                        const ExcavatorInputs& inputs, bool moving, TimeUs now_us,
                        Span<AcceptedStroke> accepted, Span<const Signal<double>> strokes_m) {
  ExcavatorValid valid;
  const Freshness fresh(profile.control.sensor_timeout_s, now_us);
  read_machine(profile.bus, inputs, {profile.pump[0].rated_speed_radps, profile.safety.idle_radps},
               fresh, now_us, valid);
  read_hands(inputs, fresh, now_us, valid);
  read_drives(drives, drive_inputs(inputs, profile, strokes_m), moving, fresh, accepted,
              valid.drive, valid.faults);
  // Nothing but range, rate and age protects an IMU's frames.
  valid.stand_in = valid.stand_in || profile.imu.known();
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    if (profile.bus.swash_feedback && !profile.pump[j].regulator.sets_swash()) {
      read_required({&inputs.swash_ratio[j], &valid.swash_ratio[j], Fault::kSwashMissing,
                     Fault::kSensorError},
                    fresh, valid.faults);
    }
  }
  sort_faults(moving, {{Fault::kStrokeJump, Fault::kStrokeMissing}}, valid);
  return valid;
}

bool watch_swash(const ExcavatorProfile& profile, bool commanded,
                 const std::array<double, kPumpCount>& wanted_ratio, double period_s,
                 std::array<double, kPumpCount>& swash_ratio, SwashStates& state) {
  const double newest = std::min(period_s / kSwashLag_s, 1.0);
  bool disagrees = false;
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    const double wanted = wanted_ratio[j];
    if (profile.pump[j].regulator.sets_swash()) {
      swash_ratio[j] = 1.0;  // That far it goes where the drives need it.
      continue;
    }
    double& slow = state[j].slow_ratio;
    slow = commanded ? slow + newest * (wanted - slow) : wanted;
    if (!profile.bus.swash_feedback) {
      swash_ratio[j] = std::min(wanted, slow);
      continue;
    }
    const double tolerance = profile.safety.swash_tolerance;
    const bool off = commanded && (swash_ratio[j] < std::min(wanted, slow) - tolerance ||
                                   swash_ratio[j] > std::max(wanted, slow) + tolerance);
    state[j].off_s = off ? state[j].off_s + period_s : 0.0;
    if (state[j].off_s > kSwashServo_s) {
      disagrees = true;
      swash_ratio[j] = std::min(swash_ratio[j], wanted);
    }
  }
  return disagrees;
}

namespace {

/// While duties are tried nobody knows what is asked.
bool gets_nothing(DriveRows drives, const LastCommands<kDriveCount>& last, bool checked,
                  const ExcavatorValid& valid, double period_s, ExcavatorWatchState& state) {
  if (!checked || state.drives.tried_s > 0.0) {
    state.supply = {};
    return false;
  }
  bool held = any_blocked(state.drives.blocked);
  for (const BlockedState& drive : state.drives.blocked) {
    held = held || drive.strains || drive.less > 0.0;
  }
  return watch_supplies(drives, valid.drive, last.asked_mps, held, period_s, state.supply);
}

}  // namespace

void watch(const ExcavatorProfile& profile, DriveRows drives, const LastCommands<kDriveCount>& last,
           const std::array<double, kPumpCount>& swash_ratio, double period_s,
           ExcavatorWatchState& state, ExcavatorValid& valid) {
  const bool checked = last.moving && valid.fault == Fault::kNone;
  FaultSet stops =
      watch_drives(drives, profile.bus, last, valid.drive, period_s, state.drives, valid);
  if (gets_nothing(drives, last, checked, valid, period_s, state)) {
    stops.add(Fault::kEngineDoubtful);
  }
  std::array<double, kPumpCount> flowing_ratio = valid.swash_ratio;
  if (watch_swash(profile, checked && last.enable, swash_ratio, period_s, flowing_ratio,
                  state.swash)) {
    degrade(Fault::kSwashDisagrees, valid);
  }
  stop(stops, valid);
  state.slowing =
      slow_down(profile.safety.degraded_speed_ratio, state.slowing, last.moving, period_s, valid);
  for (unsigned j = 0; j < kPumpCount; ++j) {
    valid.pump_flow_m3ps[j] = pump_flow_m3ps(profile.pump[j], valid.engine_radps, flowing_ratio[j]);
  }
}

}  // namespace graben
