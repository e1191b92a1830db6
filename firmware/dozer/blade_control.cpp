#include "firmware/dozer/blade_control.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/blade.hpp"
#include "firmware/drives/velocity_cap.hpp"

namespace graben {
namespace {

/// Low-pass of the body's acceleration; shorter lets the gyro's noise through.
constexpr double kAcceleration_s = 0.03;

Eigen::Vector3d normal_of(const GradeSample& design) {
  return Eigen::Vector3d(-design.slope, 0.0, 1.0).normalized();
}

/// What the body alone does to the edge's height, and how that changes.
void follow_body(const BladeState& last, double carried_mps, double period_s, BladeState& state) {
  state.carried_mps = carried_mps;
  state.has_last = true;
  if (last.has_last && period_s > 0.0) {
    const double rate_mps2 = (carried_mps - last.carried_mps) / period_s;
    const double share = period_s / (period_s + kAcceleration_s);
    state.carried_rate_mps2 = last.carried_rate_mps2 + share * (rate_mps2 - last.carried_rate_mps2);
  }
}

}  // namespace

BladeCommand control_blade(const DozerProfile& profile, const DriveRow& drive,
                           const BladeKinematics& blade, const GradeProfile& design,
                           const BladeState& last, const BladeSituation& now, double period_s) {
  const DozerControl& control = profile.control;
  const double ahead_s = control.response_s + control.dead_time_s;
  BladeCommand command;
  command.state = last;
  const Eigen::Vector3d edge_m = edge_in_world_m(blade, now.body, now.angle_rad);
  command.error_m = grade_error_m(design, edge_m.x(), edge_m.z());
  const Vector6d carried = body_jacobian(blade, now.body, now.angle_rad) * now.body_velocity;
  follow_body(last, carried[2], period_s, command.state);
  const double stroke_rate = blade.stroke_rate_mprad(now.angle_rad);
  command.feed_forward_mps =
      stroke_rate * joint_rate_radps(blade, now.body, now.angle_rad, now.body_velocity,
                                     normal_of(design.at(edge_m.x())), 0.0);
  const Eigen::Vector3d normal = normal_of(design.at(edge_m.x() + carried[0] * ahead_s));
  const double wanted_mps = -control.blade_gain_ps * command.error_m - last.integral_mps -
                            normal.z() * command.state.carried_rate_mps2 * ahead_s;
  const double free_mps = stroke_rate * joint_rate_radps(blade, now.body, now.angle_rad,
                                                         now.body_velocity, normal, wanted_mps);
  const double most_mps = end_speed_mps(drive, blade.stroke_m(now.angle_rad), free_mps);
  command.at_end = std::abs(free_mps) > most_mps;
  command.velocity_mps = std::clamp(free_mps, -most_mps, most_mps);
  const bool fed = inflow_m3ps(profile.blade, command.velocity_mps) <= now.available_flow_m3ps;
  if (fed && !command.at_end) {
    command.state.integral_mps =
        std::clamp(last.integral_mps + control.blade_integral_ps2 * command.error_m * period_s,
                   -control.blade_integral_most_mps, control.blade_integral_most_mps);
  }
  return command;
}

}  // namespace graben
