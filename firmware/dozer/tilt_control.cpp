// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/tilt_control.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/tuning.hpp"
#include "firmware/drives/velocity_cap.hpp"

namespace graben {
namespace {

/// At one moment: how far the edge's slope is off, and the cylinder's velocity that changes it by
/// `wanted_ps` against the design.
struct Asked {
  double error = 0.0;
  double per_tilt = 1.0;
  double follows_ps = 0.0;  ///< The design's change less what the body's roll does already.
};

Asked asked_at(const GradeProfile& design, const TiltSituation& at) {
  const EdgeSlope edge = edge_slope(at.body_rotation, at.blade_angle_rad, at.tilt_rad);
  const CrossSample wanted = slope_along_edge(design, at.edge_x_m, at.askew_rad);
  return {edge.slope - wanted.slope, std::max(edge.per_tilt, kTiltLeastAnswer),
          wanted.change_pm * at.speed_mps -
              design.at(at.edge_x_m).slope * std::cos(at.askew_rad) * at.askew_rate_radps -
              edge.per_roll * at.roll_rate_radps};
}

}  // namespace

double cross_error(const GradeProfile& design, const TiltSituation& at) {
  return asked_at(design, at).error;
}

TiltCommand control_tilt(const TiltProfile& profile, const DriveRow& drive,
                         const TiltKinematics& tilt, const GradeProfile& design,
                         const TiltState& last, const TiltSituation& now, const TiltSituation& then,
                         bool fed, double period_s) {
  const Asked at_once = asked_at(design, now);
  const Asked later = asked_at(design, then);
  TiltCommand command;
  command.state = last;
  command.error = at_once.error;
  command.feed_forward_mps =
      tilt.stroke_rate_mprad(now.tilt_rad) * at_once.follows_ps / at_once.per_tilt;
  const double back_ps = -profile.gain_ps * later.error - last.integral_radps;
  const double free_mps =
      tilt.stroke_rate_mprad(then.tilt_rad) * (later.follows_ps + back_ps) / later.per_tilt;
  const double most_mps = end_speed_mps(drive, tilt.stroke_m(now.tilt_rad), free_mps);
  command.at_end = std::abs(free_mps) > most_mps;
  command.velocity_mps = std::clamp(free_mps, -most_mps, most_mps);
  if (fed && !command.at_end) {
    command.state.integral_radps =
        std::clamp(last.integral_radps + profile.integral_ps2 * command.error * period_s,
                   -profile.integral_most_radps, profile.integral_most_radps);
  }
  return command;
}

}  // namespace graben
