#include "firmware/excavator/safety/excavator_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/hydraulics/flow.hpp"

namespace graben {
namespace {
constexpr double kSwashServo_s = 0.5;
}

bool watch_swash(const ExcavatorProfile& profile, bool commanded, double period_s,
                 std::array<double, kPumpCount>& swash_ratio, SwashState& state) {
  bool disagrees = false;
  for (unsigned j = 0; j < kPumpCount; ++j) {
    const double wanted = profile.dig_swash_ratio[j];
    const bool off =
        commanded && std::abs(swash_ratio[j] - wanted) > profile.safety.swash_tolerance;
    state[j] = off ? state[j] + period_s : 0.0;
    if (state[j] > kSwashServo_s) {
      disagrees = true;
      swash_ratio[j] = std::min(swash_ratio[j], wanted);
    }
  }
  return disagrees;
}

void watch(const ExcavatorProfile& profile, DriveRows drives, const LastCommands<kDriveCount>& last,
           double period_s, ExcavatorWatchState& state, ExcavatorValid& valid) {
  const bool checked = last.moving && valid.fault == Fault::kNone;
  const FaultSet stops =
      watch_drives(drives, profile.bus, last, valid.drive, period_s, state.drives, valid);
  std::array<double, kPumpCount> swash_ratio = valid.swash_ratio;
  if (watch_swash(profile, checked && last.enable && profile.bus.swash_feedback, period_s,
                  swash_ratio, state.swash)) {
    degrade(Fault::kSwashDisagrees, valid);
  }
  stop(stops, valid);
  state.slowing =
      slow_down(profile.safety.degraded_speed_ratio, state.slowing, last.moving, period_s, valid);
  for (unsigned j = 0; j < kPumpCount; ++j) {
    valid.pump_flow_m3ps[j] = pump_flow_m3ps(profile.pump[j], valid.engine_radps, swash_ratio[j]);
  }
}

}  // namespace graben
