#include "firmware/drives/drive_gate.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/slew_limit.hpp"

namespace graben {

GateResult gate(const ExcavatorProfile& profile, const GateState& last, bool active,
                const std::array<double, kDriveCount>& spool_m, double period_s) {
  GateResult result;
  if (!active) {
    return result;
  }
  const double change_max = profile.control.spool_rate_ps * std::max(0.0, period_s);
  for (unsigned i = 0; i < static_cast<unsigned>(profile.drive_count); ++i) {
    if (!std::isfinite(spool_m[i]) || !std::isfinite(change_max)) {
      return {false, Fault::kCommandNotFinite, {}, {}};
    }
    if (!last.opening[i].intact()) {
      return {false, Fault::kMemoryCorrupt, {}, {}};
    }
    const double wanted = std::clamp(spool_m[i] / profile.valve.spool_travel_m, -1.0, 1.0);
    const double opening = limited(wanted, last.opening[i].value(), change_max);
    result.state.opening[i] = opening;
    result.duty_ratio[i] =
        spool_duty(profile.valve.spool_to_duty, profile.control.spool_threshold, opening);
  }
  result.enable = true;
  return result;
}

}  // namespace graben
