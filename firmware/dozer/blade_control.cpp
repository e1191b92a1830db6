// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/blade_control.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/tuning.hpp"
#include "firmware/drives/velocity_cap.hpp"

namespace graben {
namespace {

Eigen::Vector3d normal_of(const GradeSample& design) {
  return Eigen::Vector3d(-design.slope, 0.0, 1.0).normalized();
}

/// (5), (6) with this velocity of the edge along the design's normal.
double cylinder_mps(const BladeKinematics& blade, const GradeProfile& design,
                    const BladeSituation& at, double edge_x_m, double along_normal_mps) {
  return blade.stroke_rate_mprad(at.angle_rad) *
         joint_rate_radps(blade, at.body, at.angle_rad, at.body_velocity,
                          normal_of(design.at(edge_x_m)), along_normal_mps);
}

/// What the lift asks of the edge's velocity.
double lifting_mps(const BladeSituation& at) {
  return at.lift.slope * at.body_velocity[0] + at.lift.rate_mps;
}

/// The feedback's most downwards, with the edge so far above where it is to be.
double sink_most_mps(const DozerProfile& profile, double speed_mps, double above_m) {
  const double hurry_m = std::max(0.0, above_m - kBladeNoHurry * profile.grade.tolerance_m);
  return kBladeSinkSlope * std::max(0.0, speed_mps) + profile.control.blade_gain_ps * hurry_m;
}

double error_of(const BladeKinematics& blade, const GradeProfile& design, const BladeSituation& at,
                double& edge_x_m) {
  const Eigen::Vector3d edge_m = edge_in_world_m(blade, at.body, at.angle_rad);
  edge_x_m = edge_m.x();
  return grade_error_m(design, edge_m.x(), edge_m.z() - at.aside_m);
}

}  // namespace

BladeCommand control_blade(const DozerProfile& profile, const DriveRow& drive,
                           const BladeKinematics& blade, const GradeProfile& design,
                           const BladeState& last, const BladeSituation& now,
                           const BladeSituation& then, double available_flow_m3ps,
                           double period_s) {
  const DozerControl& control = profile.control;
  BladeCommand command;
  command.state = last;
  double now_x_m = 0.0;
  double then_x_m = 0.0;
  command.error_m = error_of(blade, design, now, now_x_m);
  const double then_m = error_of(blade, design, then, then_x_m);
  command.off_m = command.error_m - now.lift.height_m;
  command.feed_forward_mps = cylinder_mps(blade, design, now, now_x_m, lifting_mps(now));
  const double above_m = then_m - then.lift.height_m;
  const double back_mps = -control.blade_gain_ps * above_m - last.integral_mps;
  const double sink_mps = sink_most_mps(profile, then.body_velocity[0], above_m);
  command.sinks = back_mps < -sink_mps;
  const double free_mps = cylinder_mps(blade, design, then, then_x_m,
                                       lifting_mps(then) + std::max(back_mps, -sink_mps));
  const double most_mps = end_speed_mps(drive, blade.stroke_m(now.angle_rad), free_mps);
  command.at_end = std::abs(free_mps) > most_mps;
  command.velocity_mps = std::clamp(free_mps, -most_mps, most_mps);
  const bool fed = inflow_m3ps(profile.blade, command.velocity_mps) <= available_flow_m3ps;
  if (fed && !command.at_end && !command.sinks) {
    command.state.integral_mps =
        std::clamp(last.integral_mps + control.blade_integral_ps2 * command.off_m * period_s,
                   -control.blade_integral_most_mps, control.blade_integral_most_mps);
  }
  return command;
}

}  // namespace graben
