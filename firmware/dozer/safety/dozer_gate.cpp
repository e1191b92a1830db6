#include "firmware/dozer/safety/dozer_gate.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/slew_limit.hpp"

namespace graben {
namespace {

/// Largest changes within this cycle.
struct Changes {
  double opening = 0.0;
  double pump = 0.0;
  double motor = 0.0;
};

Changes changes_in(const DozerProfile& profile, double period_s) {
  const double time_s = std::max(0.0, period_s);
  return {profile.control.spool_rate_ps * time_s, profile.hst.pump_rate_ps * time_s,
          profile.hst.motor_rate_ps * time_s};
}

bool is_finite(const DozerCommand& wanted, const Changes& changes) {
  bool finite = std::isfinite(wanted.opening) && std::isfinite(changes.opening) &&
                std::isfinite(changes.pump) && std::isfinite(changes.motor);
  for (unsigned i = 0; i < kTrackCount; ++i) {
    finite = finite && std::isfinite(wanted.pump_ratio[i]) && std::isfinite(wanted.motor_ratio[i]);
  }
  return finite;
}

bool is_intact(const DozerGateState& state) {
  bool intact = state.opening.intact();
  for (unsigned i = 0; i < kTrackCount; ++i) {
    intact = intact && state.pump_ratio[i].intact() && state.motor_ratio[i].intact();
  }
  return intact;
}

DozerGateResult refused(Fault fault) {
  DozerGateResult result;
  result.fault = fault;
  return result;
}

}  // namespace

DozerGateResult gate(const DozerProfile& profile, const DozerGateState& last, bool active,
                     const DozerCommand& wanted, double period_s) {
  if (!active) {
    return {};
  }
  const Changes changes = changes_in(profile, period_s);
  if (!is_finite(wanted, changes)) {
    return refused(Fault::kCommandNotFinite);
  }
  if (!is_intact(last)) {
    return refused(Fault::kMemoryCorrupt);
  }
  DozerGateResult result;
  const double opening =
      limited(std::clamp(wanted.opening, -1.0, 1.0), last.opening.value(), changes.opening);
  result.duty_ratio =
      spool_duty(profile.implement.spool_to_duty, profile.control.spool_threshold, opening);
  result.state.opening = opening;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    result.pump_ratio[i] = limited(std::clamp(wanted.pump_ratio[i], -1.0, 1.0),
                                   last.pump_ratio[i].value(), changes.pump);
    result.motor_ratio[i] =
        std::max(std::clamp(wanted.motor_ratio[i], profile.hst.motor_ratio_min, 1.0),
                 last.motor_ratio[i].value() - changes.motor);
    result.state.pump_ratio[i] = result.pump_ratio[i];
    result.state.motor_ratio[i] = result.motor_ratio[i];
  }
  result.enable = true;
  return result;
}

}  // namespace graben
