// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/blade_load.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/travel/tuning.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

double low_passed(double last, double now, double period_s) {
  return last + (now - last) * period_s / (kLoadFilter_s + period_s);
}

}  // namespace

double traction_n(const DozerProfile& profile, const DozerValid& valid) {
  const HstProfile& hst = profile.hst;
  double sum_n = 0.0;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    const double drop_pa = std::max(0.0, valid.line_pressure_pa[i] - kLoadCharge_pa);
    sum_n += drop_pa * valid.motor_ratio[i] * hst.motor_m3prev / kTwoPi * hst.gear_ratio /
             hst.sprocket_radius_m;
  }
  return sum_n;
}

double push_n(const DozerProfile& profile, const DozerValid& valid) {
  return traction_n(profile, valid) -
         profile.body.mass_kg * kStandardGravity_mps2 * std::sin(valid.pitch_rad);
}

double slip_of(const DozerValid& valid) {
  const double track_mps = std::max(valid.track_speed_mps[kLeft], valid.track_speed_mps[kRight]);
  return std::clamp((track_mps - valid.velocity_mps) / std::max(track_mps, kSlipSlowest_mps), 0.0,
                    1.0);
}

double planned_share(const TravelProfile& travel, const PushState& load) {
  const double loaded = load.push_n / (kLoadReserveFrom * travel.push_max_n) - 1.0;
  return travel.flow_share * (1.0 - kLoadReserve * std::clamp(loaded, 0.0, 1.0));
}

PushState next_load(const DozerProfile& profile, const PushState& last, const DozerValid& valid,
                    double period_s) {
  PushState state;
  state.push_n = low_passed(last.push_n, push_n(profile, valid), period_s);
  state.slip = low_passed(last.slip, slip_of(valid), period_s);
  const double rising_nps =
      period_s > 0.0 ? std::max(0.0, state.push_n - last.push_n) / period_s : 0.0;
  state.rising_nps = low_passed(last.rising_nps, rising_nps, period_s);
  const double soon_n = state.push_n + kLoadSoon_s * state.rising_nps;
  const double too_much =
      std::max(soon_n / profile.travel.push_max_n - 1.0, state.slip / kLoadMostSlip - 1.0);
  const double wanted_mps =
      std::clamp(kLoadRise_mps * (too_much > 0.0 ? too_much : kLoadDown * too_much),
                 -kLoadMostRise_mps, kLoadMostRise_mps);
  state.lift_m = std::clamp(last.lift_m + wanted_mps * period_s, 0.0, kLoadMostLift_m);
  state.rate_mps = period_s > 0.0 ? (state.lift_m - last.lift_m) / period_s : 0.0;
  return state;
}

}  // namespace graben
