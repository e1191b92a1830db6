// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/tracks.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/travel/tuning.hpp"

namespace graben {
namespace {

/// Track speed with pump and motor both at full displacement. 2 pi n_e / 60 of (9) is the engine's
/// angular speed.
double full_speed_mps(const HstProfile& hst, double engine_radps) {
  return engine_radps * hst.pump_m3prev / hst.motor_m3prev / hst.gear_ratio * hst.pump_efficiency *
         hst.motor_efficiency * hst.sprocket_radius_m;
}

}  // namespace

double track_speed_mps(const HstProfile& hst, double engine_radps, double pump_ratio,
                       double motor_ratio) {
  return motor_ratio > 0.0 ? full_speed_mps(hst, engine_radps) * pump_ratio / motor_ratio : 0.0;
}

double track_speed_max_mps(const HstProfile& hst, double engine_radps) {
  return track_speed_mps(hst, engine_radps, 1.0, hst.motor_ratio_min);
}

Displacements displacements_for(const HstProfile& hst, double engine_radps, double speed_mps) {
  const double full_mps = full_speed_mps(hst, engine_radps);
  if (!(full_mps > 0.0)) {
    return {};
  }
  const double share = speed_mps / full_mps;
  if (std::abs(share) <= 1.0) {
    return {share, 1.0};
  }
  return {std::copysign(1.0, share), std::max(hst.motor_ratio_min, 1.0 / std::abs(share))};
}

TrackCommand control_track(const DozerProfile& profile, const TrackState& last, double wanted_mps,
                           double measured_mps, double engine_radps, double period_s) {
  TrackCommand command;
  command.state = last;
  command.state.last_wanted_mps = wanted_mps;
  command.state.expected_mps +=
      (wanted_mps - last.expected_mps) * period_s / (kTrackExpectedLag_s + period_s);
  const double error_mps = command.state.expected_mps - measured_mps;
  const double acceleration_mps2 =
      period_s > 0.0 ? std::clamp((wanted_mps - last.last_wanted_mps) / period_s,
                                  -kTrackMostAcceleration_mps2, kTrackMostAcceleration_mps2)
                     : 0.0;
  const double speed_mps = wanted_mps + profile.hst.response_s * acceleration_mps2 +
                           profile.travel.track_gain * error_mps + last.integral_mps;
  const double most_mps = track_speed_max_mps(profile.hst, engine_radps);
  if (std::abs(speed_mps) < most_mps) {
    command.state.integral_mps =
        std::clamp(last.integral_mps + profile.travel.track_integral_ps * error_mps * period_s,
                   -kTrackMostIntegral_mps, kTrackMostIntegral_mps);
  }
  command.displacements = displacements_for(profile.hst, engine_radps, speed_mps);
  return command;
}

}  // namespace graben
