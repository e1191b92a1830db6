#include "firmware/dozer/travel/track_control.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {
/// More than leakage and slip ever take.
constexpr double kMostIntegral_mps = 0.4;
constexpr double kMostAcceleration_mps2 = 2.0;
}  // namespace

TrackCommand control_track(const DozerProfile& profile, const TrackState& last, double wanted_mps,
                           double measured_mps, double engine_radps, double period_s) {
  TrackCommand command;
  command.state = last;
  command.state.last_wanted_mps = wanted_mps;
  const double error_mps = wanted_mps - measured_mps;
  const double acceleration_mps2 = period_s > 0.0
                                       ? std::clamp((wanted_mps - last.last_wanted_mps) / period_s,
                                                    -kMostAcceleration_mps2, kMostAcceleration_mps2)
                                       : 0.0;
  const double speed_mps = wanted_mps + profile.hst.response_s * acceleration_mps2 +
                           profile.travel.track_gain * error_mps + last.integral_mps;
  const double most_mps = track_speed_max_mps(profile.hst, engine_radps);
  if (std::abs(speed_mps) < most_mps) {
    command.state.integral_mps =
        std::clamp(last.integral_mps + profile.travel.track_integral_ps * error_mps * period_s,
                   -kMostIntegral_mps, kMostIntegral_mps);
  }
  command.displacements = displacements_for(profile.hst, engine_radps, speed_mps);
  return command;
}

}  // namespace graben
