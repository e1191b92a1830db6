#include "firmware/excavator/safety/excavator_validation.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/swing.hpp"
#include "firmware/hydraulics/flow.hpp"

namespace graben {
namespace {

/// All drives' signals alike: the swing as the travel at its lever, extending to the left.
std::array<DriveInputs, kDriveCount> drive_inputs(const ExcavatorInputs& inputs,
                                                  const SwingProfile& swing) {
  return {inputs.axis[kBoom], inputs.axis[kArm], inputs.axis[kBucket],
          swing_inputs(inputs.swing, swing)};
}

}  // namespace

ExcavatorValid validate(const ExcavatorProfile& profile, DriveRows drives,
                        const ExcavatorInputs& inputs, bool moving, TimeUs now_us,
                        Span<Believed> accepted) {
  ExcavatorValid valid;
  const Freshness fresh(profile.control.sensor_timeout_s, now_us);
  read_machine(profile.bus, inputs, {profile.pump[0].rated_speed_radps, profile.safety.idle_radps},
               fresh, now_us, valid);
  read_drives(drives, drive_inputs(inputs, profile.swing), moving, fresh, accepted, valid.drive,
              valid.faults);
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    if (profile.bus.swash_feedback) {
      read_required({&inputs.swash_ratio[j], &valid.swash_ratio[j], Fault::kSwashMissing,
                     Fault::kSensorError},
                    fresh, valid.faults);
    }
  }
  sort_faults(moving, {{Fault::kStrokeJump, Fault::kStrokeMissing}}, valid);
  return valid;
}

namespace {

constexpr double kSwashServo_s = 0.5;
/// Lag of a pump that takes its time.
constexpr double kSwashLag_s = 0.25;

}  // namespace

bool watch_swash(const ExcavatorProfile& profile, bool commanded,
                 const std::array<double, kPumpCount>& wanted_ratio, double period_s,
                 std::array<double, kPumpCount>& swash_ratio, SwashStates& state) {
  const double newest = std::min(period_s / kSwashLag_s, 1.0);
  bool disagrees = false;
  for (unsigned j = 0; j < kPumpCount; ++j) {
    const double wanted = wanted_ratio[j];
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

void watch(const ExcavatorProfile& profile, DriveRows drives, const LastCommands<kDriveCount>& last,
           const std::array<double, kPumpCount>& swash_ratio, double period_s,
           ExcavatorWatchState& state, ExcavatorValid& valid) {
  const bool checked = last.moving && valid.fault == Fault::kNone;
  const FaultSet stops =
      watch_drives(drives, profile.bus, last, valid.drive, period_s, state.drives, valid);
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
