#include "firmware/safety/gate.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// Only the way from neutral is limited: towards neutral, and through it on a reversal, a spool may
/// always go at once.
double limited(double wanted, double last, double change_max) {
  const double open = std::max(0.0, std::signbit(wanted) ? -last : last);  // on wanted's side
  const double limit = open + change_max;
  return std::clamp(wanted, -limit, limit);
}

}  // namespace

GateResult gate(const ExcavatorProfile& profile, const GateState& last, bool active,
                const std::array<double, kAxisCount>& spool_m, double period_s) {
  GateResult result;
  if (!active) {
    return result;
  }
  const double change_max = profile.control.spool_rate_ps * std::max(0.0, period_s);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    if (!std::isfinite(spool_m[i]) || !std::isfinite(change_max)) {
      return {false, Fault::kCommandNotFinite, {}, {}};
    }
    if (!last.opening[i].intact()) {
      return {false, Fault::kMemoryCorrupt, {}, {}};
    }
    const double wanted = std::clamp(spool_m[i] / profile.valve.spool_travel_m, -1.0, 1.0);
    const double opening = limited(wanted, last.opening[i].value(), change_max);
    result.state.opening[i] = opening;
    if (opening != 0.0 && std::abs(opening) >= profile.control.spool_threshold) {
      result.duty_ratio[i] = std::copysign(
          std::clamp(profile.valve.spool_to_duty.at(std::abs(opening)), 0.0, 1.0), opening);
    }
  }
  result.enable = true;
  return result;
}

}  // namespace graben
