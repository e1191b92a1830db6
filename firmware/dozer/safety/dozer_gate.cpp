// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/safety/dozer_gate.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// Largest changes within this cycle.
struct Changes {
  double pump = 0.0;
  double motor = 0.0;
};

Changes changes_in(const DozerProfile& profile, double period_s) {
  const double time_s = std::max(0.0, period_s);
  return {profile.hst.pump_rate_ps * time_s, profile.hst.motor_rate_ps * time_s};
}

bool is_finite(const DozerCommand& wanted, const Changes& changes) {
  bool finite = std::isfinite(changes.pump) && std::isfinite(changes.motor);
  for (unsigned i = 0; i < kTrackCount; ++i) {
    finite = finite && std::isfinite(wanted.pump_ratio[i]) && std::isfinite(wanted.motor_ratio[i]);
  }
  for (const double tried_ratio : wanted.tried_ratio) {
    finite = finite && std::isfinite(tried_ratio);
  }
  return finite;
}

DozerGateResult neutral(Fault fault, DozerGateState& state) {
  DozerGateResult result;
  result.fault = fault;
  state = {};
  return result;
}

}  // namespace

DozerGateResult gate_dozer(const DozerProfile& profile, DriveRows drives, bool active,
                           const DozerCommand& wanted, double period_s, DozerGateState& state) {
  const Changes changes = changes_in(profile, period_s);
  if (active && !is_finite(wanted, changes)) {
    return neutral(Fault::kCommandNotFinite, state);
  }
  DozerGateResult result;
  std::array<double, kBladeCount> duty_ratio{};
  if (active && wanted.tries) {
    step_duties(drives, wanted.tried_ratio, period_s, state.duty_ratio, duty_ratio);
    state.opening = {};
  } else if (active) {
    open_spools(drives, wanted.opening, period_s, state.opening, duty_ratio);
  }
  const GateResult blade =
      gate_duties(drives, active, duty_ratio, period_s, state.duty_ratio, result.duty_ratio);
  if (!blade.enable) {
    return neutral(blade.fault, state);
  }
  for (unsigned i = 0; i < kTrackCount; ++i) {
    result.pump_ratio[i] = slew_limited(std::clamp(wanted.pump_ratio[i], -1.0, 1.0),
                                        state.pump_ratio[i], changes.pump);
    result.motor_ratio[i] =
        std::max(std::clamp(wanted.motor_ratio[i], profile.hst.motor_ratio_min, 1.0),
                 state.motor_ratio[i] - changes.motor);
    state.pump_ratio[i] = result.pump_ratio[i];
    state.motor_ratio[i] = result.motor_ratio[i];
  }
  result.enable = true;
  return result;
}

}  // namespace graben
