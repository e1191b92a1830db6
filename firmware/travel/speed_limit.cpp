#include "firmware/travel/speed_limit.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/hydraulics/hydrostatic.hpp"
#include "firmware/travel/track_speeds.hpp"

namespace graben {
namespace {

constexpr double kNoFlow_m3ps = 1e-9;
constexpr double kBraking = 1.25;

void take_lower(double speed_mps, Limit limit, double& allowed_mps, Limit& holds) {
  if (speed_mps < allowed_mps) {
    allowed_mps = speed_mps;
    holds = limit;
  }
}

/// v_max,imp of (11), over the normalised flow of (10).
double implement_speed_mps(const DozerProfile& profile, const SpeedDemand& demand) {
  const double normalised_m3pm =
      demand.required_flow_m3ps / std::max(demand.measured_mps, profile.travel.speed_min_mps);
  return demand.available_flow_m3ps / std::max(normalised_m3pm, kNoFlow_m3ps);
}

/// Algorithm 1: how fast v_c may rise, m/s^2.
double rise_mps2(const DozerProfile& profile, double last_mps, const SpeedDemand& demand) {
  const bool off_home = std::abs(demand.blade_angle_rad) > profile.travel.threshold_rad;
  const bool has_room = demand.ahead.lowest_mps > last_mps;
  return off_home && !has_room ? 0.0 : profile.travel.acceleration_max_mps2;
}

}  // namespace

SpeedChoice next_speed(const DozerProfile& profile, double last_mps, const SpeedDemand& demand,
                       double period_s) {
  const double track_max_mps = track_speed_max_mps(profile.hst, demand.engine_radps);
  const std::array<double, kTrackCount> body_max_mps =
      body_speeds_max_mps(profile.body, {track_max_mps, track_max_mps}, demand.heading_radps);
  SpeedChoice choice;
  choice.allowed_mps = std::min(body_max_mps[kLeft], body_max_mps[kRight]);
  const auto slower =
      static_cast<std::uint8_t>(body_max_mps[kLeft] <= body_max_mps[kRight] ? 0 : 1);
  Limit holds{LimitKind::kTransmissionFlow, slower};
  if (profile.travel.policy == SpeedPolicy::kBounded) {
    take_lower(implement_speed_mps(profile, demand), {LimitKind::kImplementFlow, 0},
               choice.allowed_mps, holds);
    take_lower(demand.ahead.speed_mps, {LimitKind::kAhead, 0}, choice.allowed_mps, holds);
  }
  choice.allowed_mps = std::max(choice.allowed_mps, profile.travel.speed_min_mps);
  const double target_mps = std::min(demand.desired_mps, choice.allowed_mps);
  const double rise = profile.travel.policy == SpeedPolicy::kBounded
                          ? rise_mps2(profile, last_mps, demand)
                          : profile.travel.acceleration_max_mps2;
  choice.speed_mps =
      std::clamp(target_mps, last_mps - kBraking * profile.travel.deceleration_max_mps2 * period_s,
                 last_mps + rise * period_s);
  if (choice.speed_mps < demand.desired_mps) {
    choice.limit = target_mps > choice.speed_mps ? Limit{LimitKind::kRise, 0} : holds;
  }
  return choice;
}

}  // namespace graben
