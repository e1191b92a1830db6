// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/speed_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/dozer/travel/tracks.hpp"
#include "firmware/dozer/travel/tuning.hpp"
#include "firmware/drives/velocity_cap.hpp"

namespace graben {
namespace {

/// v_max,imp of (11), over the normalised flow of (10).
double implement_speed_mps(const DozerProfile& profile, const SpeedDemand& demand,
                           double required_flow_m3ps) {
  const double normalised_m3pm =
      required_flow_m3ps / std::max(demand.measured_mps, profile.travel.speed_min_mps);
  return demand.available_flow_m3ps / std::max(normalised_m3pm, kSpeedNoFlow_m3ps);
}

double low_passed(double last, double now, double time_s, double period_s) {
  return last + (now - last) * period_s / (time_s + period_s);
}

/// How fast with the edge so far off the grade.
double on_grade_speed_mps(const DozerProfile& profile, const SpeedDemand& demand,
                          double off_grade_m) {
  const double share =
      (kSpeedOffGrade - off_grade_m / profile.grade.tolerance_m) / (kSpeedOffGrade - kSpeedOnGrade);
  const double least_mps = profile.travel.speed_min_mps;
  return share >= 1.0 ? std::numeric_limits<double>::infinity()
                      : least_mps + std::max(0.0, share) * (demand.desired_mps - least_mps);
}

/// Algorithm 1: where v_c may rise to. A body that is tipping needs more and more flow, which its
/// rest on the ground ahead does not show; so the measured flow has its reserve here too.
double room_mps(const DozerProfile& profile, const SpeedDemand& demand, double implement_mps,
                double target_mps) {
  if (profile.travel.policy == SpeedPolicy::kConstant) {
    return target_mps;
  }
  const bool off_home = std::abs(demand.blade_angle_rad) > profile.travel.threshold_rad;
  const double ahead_mps = off_home ? demand.ahead.lowest_mps : target_mps;
  const double held_mps = std::min(ahead_mps, profile.travel.flow_share * implement_mps);
  return std::min(target_mps, std::max(held_mps, profile.travel.speed_min_mps));
}

SpeedState followed(const DozerProfile& profile, const SpeedState& last, double desired_mps,
                    double target_mps, double room_mps, double period_s) {
  const TravelProfile& travel = profile.travel;
  SpeedState state = last;
  if (target_mps < last.speed_mps) {
    const double slowest_mps =
        last.speed_mps - kSpeedBraking * travel.deceleration_max_mps2 * period_s;
    state.speed_mps = std::max(target_mps, slowest_mps);
    state.rising = false;
    state.since_fall_s = 0.0;
    return state;
  }
  state.since_fall_s = std::min(last.since_fall_s + period_s, kSpeedPause_s);
  // Up to what is desired nothing will hold it again soon.
  const bool is_worth_it =
      room_mps > last.speed_mps * (1.0 + kSpeedWorthIt) || room_mps >= desired_mps;
  state.rising = room_mps > last.speed_mps &&
                 (last.rising || (is_worth_it && state.since_fall_s >= kSpeedPause_s));
  if (state.rising) {
    state.speed_mps = std::min(room_mps, last.speed_mps + travel.acceleration_max_mps2 * period_s);
  }
  return state;
}

/// What keeps v_c below v_d. Below what is allowed now it gets faster as fast as it may, or waits
/// as there is no room ahead.
Limit why_slower(const SpeedState& state, double target_mps, const Limit& holds) {
  if (target_mps <= state.speed_mps) {
    return holds;
  }
  return state.rising ? Limit{LimitKind::kRise, 0} : Limit{LimitKind::kAhead, 0};
}

}  // namespace

SpeedChoice next_speed(const DozerProfile& profile, const SpeedState& last,
                       const SpeedDemand& demand, double period_s) {
  const double track_max_mps = track_speed_max_mps(profile.hst, demand.engine_radps);
  const std::array<double, kTrackCount> body_max_mps =
      body_speeds_max_mps(profile.body, {track_max_mps, track_max_mps}, demand.heading_radps);
  SpeedChoice choice;
  const auto slower =
      static_cast<std::uint8_t>(body_max_mps[kLeft] <= body_max_mps[kRight] ? kLeft : kRight);
  SpeedCap cap{std::min(body_max_mps[kLeft], body_max_mps[kRight]),
               {LimitKind::kTransmissionFlow, slower}};
  const double required_m3ps =
      low_passed(last.required_flow_m3ps, demand.required_flow_m3ps, kSpeedFlowFilter_s, period_s);
  const double off_grade_m =
      low_passed(last.off_grade_m, std::abs(demand.off_m), kSpeedErrorFilter_s, period_s);
  const double implement_mps = implement_speed_mps(profile, demand, required_m3ps);
  if (profile.travel.policy == SpeedPolicy::kBounded) {
    cap.tighten(implement_mps, {LimitKind::kImplementFlow, 0});
    cap.tighten(demand.ahead.speed_mps, {LimitKind::kAhead, 0});
    cap.tighten(on_grade_speed_mps(profile, demand, off_grade_m), {LimitKind::kOffGrade, 0});
  }
  choice.allowed_mps = std::max(cap.speed_mps, profile.travel.speed_min_mps);
  const double target_mps = std::min(demand.desired_mps, choice.allowed_mps);
  choice.state = followed(profile, last, demand.desired_mps, target_mps,
                          room_mps(profile, demand, implement_mps, target_mps), period_s);
  choice.state.required_flow_m3ps = required_m3ps;
  choice.state.off_grade_m = off_grade_m;
  if (choice.state.speed_mps < demand.desired_mps) {
    choice.limit = why_slower(choice.state, target_mps, cap.limit);
  }
  return choice;
}

}  // namespace graben
