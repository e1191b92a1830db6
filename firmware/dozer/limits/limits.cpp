// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/limits/limits.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/travel/tracks.hpp"
#include "firmware/dozer/tuning.hpp"

namespace graben {
namespace {

/// v_c on the way back from a pass.
SpeedChoice return_speed(const TravelProfile& travel, const DozerEstimates& estimates,
                         double desired_mps, double period_s, const SpeedState& last) {
  const double wanted_mps = pass_speed_mps(estimates.pass, estimates.in_pass, desired_mps,
                                           0.5 * travel.deceleration_max_mps2);
  SpeedChoice choice;
  const double last_mps = last.speed_mps;
  const bool slower = std::abs(wanted_mps) < std::abs(last_mps);
  const double step_mps =
      (slower ? travel.deceleration_max_mps2 : travel.acceleration_max_mps2) * period_s;
  choice.state.speed_mps = last_mps + std::clamp(wanted_mps - last_mps, -step_mps, step_mps);
  choice.allowed_mps = std::abs(wanted_mps);
  return choice;
}

/// v_c of this cycle and what it is chosen from.
SpeedChoice choose_speed(const DozerModel& machine, const DozerValid& valid,
                         const DozerEstimates& estimates, const Preview& preview,
                         const BladeMotion& motion, double curvature_pm, double period_s,
                         const SpeedState& last) {
  const DozerProfile& profile = machine.profile;
  const double desired_mps = profile.travel.speed_desired_mps * valid.speed_override_ratio;
  if (estimates.pass.phase != PassPhase::kCut) {
    return return_speed(profile.travel, estimates, desired_mps, period_s, last);
  }
  SpeedDemand demand;
  demand.desired_mps = desired_mps;
  demand.off_m = motion.off_m(machine);
  demand.measured_mps = valid.velocity_mps;
  demand.required_flow_m3ps = motion.required_flow_m3ps;
  demand.available_flow_m3ps = motion.available_flow_m3ps;
  demand.engine_radps = valid.engine_radps;
  demand.heading_radps = curvature_pm * last.speed_mps;
  demand.blade_angle_rad = machine.blade.angle_rad(valid.blade().stroke_m);
  demand.ahead = preview.limit(
      estimates.position.position_m + profile.control.pose_latency_s * valid.velocity_mps,
      last.speed_mps, lift_most_m(profile), kTravelLead_s);
  demand.ahead.speed_mps = std::min(demand.ahead.speed_mps, estimates.fall.speed_mps);
  return next_speed(profile, last, demand, period_s);
}

}  // namespace

Travel flow_limited(const DozerModel& machine, const DozerValid& valid,
                    const DozerEstimates& estimates, const Preview& preview,
                    const BladeMotion& motion, double period_s, const TravelLimitState& state) {
  const DozerProfile& profile = machine.profile;
  const GradeProfile& design = estimates.design;
  Travel travel;
  if (design.curves()) {
    const double reach_m = machine.reach_m();
    travel.off_track_m = edge_course(design, valid.position_m, valid.course, reach_m).offset_m;
    travel.steering = steer(design, state.steering,
                            {valid.position_m, reach_m, state.speed.speed_mps, valid.velocity_mps,
                             valid.course, profile.control.learns},
                            period_s);
  }
  travel.speed = choose_speed(machine, valid, estimates, preview, motion,
                              travel.steering.curvature_pm, period_s, state.speed);
  double& speed_mps = travel.speed.state.speed_mps;
  if (valid.external.speed_ratio < 1.0) {
    // At once, whatever acceleration is comfortable.
    const double most_mps = valid.external.speed_ratio * profile.travel.speed_desired_mps;
    speed_mps = std::clamp(speed_mps, -most_mps, most_mps);
  }
  travel.track_mps = {speed_mps, speed_mps};
  if (design.curves()) {
    travel.track_mps = steered_mps(profile.body, speed_mps,
                                   {believed_track_mps(profile.hst, valid, kLeft),
                                    believed_track_mps(profile.hst, valid, kRight)},
                                   period_s, travel.steering);
  }
  return travel;
}

void go_on(const Travel& travel, bool active, TravelLimitState& state) {
  state.speed = active ? travel.speed.state : SpeedState{};
  state.steering = active ? travel.steering : SteeringState{};
}

}  // namespace graben
