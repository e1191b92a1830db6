#include "firmware/excavator/safety/swash_watch.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {
constexpr double kServo_s = 0.5;
}

SwashWatchResult watch_swash(const ExcavatorProfile& profile, const SwashWatchState& last,
                             bool commanded, const std::array<double, kPumpCount>& swash_ratio,
                             double period_s) {
  SwashWatchResult result;
  result.flow_swash_ratio = swash_ratio;
  if (!commanded) {
    return result;
  }
  for (unsigned j = 0; j < kPumpCount; ++j) {
    const double wanted = profile.dig_swash_ratio[j];
    const bool off = std::abs(swash_ratio[j] - wanted) > profile.safety.swash_tolerance;
    result.state[j] = off ? last[j] + period_s : 0.0;
    if (result.state[j] > kServo_s) {
      result.disagrees = true;
      result.flow_swash_ratio[j] = std::min(swash_ratio[j], wanted);
    }
  }
  return result;
}

}  // namespace graben
