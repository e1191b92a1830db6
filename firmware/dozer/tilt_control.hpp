// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The blade's slope across the track: feed-forward of the body's roll and of the design ahead, and
/// feedback.

#include "firmware/dozer/tilt.hpp"

namespace graben {

/// State from cycle to cycle.
struct TiltState {
  double integral_radps = 0.0;
};

/// Where the blade is, measured or foretold.
struct TiltSituation {
  Eigen::Matrix3d body_rotation = Eigen::Matrix3d::Identity();
  double roll_rate_radps = 0.0;
  double blade_angle_rad = 0.0;  ///< theta_1
  double tilt_rad = 0.0;
  double edge_x_m = 0.0;
  double speed_mps = 0.0;  ///< Along x.
  double askew_rad = 0.0;  ///< See BladeSituation, as the next.
  double askew_rate_radps = 0.0;
};

/// Slope of the edge over the design's there.
[[nodiscard]] double cross_error(const GradeProfile& design, const TiltSituation& at);

struct TiltCommand {
  double velocity_mps = 0.0;      ///< Of the tilt cylinder; extension is positive.
  double feed_forward_mps = 0.0;  ///< What roll and design alone ask for now.
  double error = 0.0;             ///< Slope of the edge over the design's, now.
  bool at_end = false;            ///< Slowed by the end of the stroke.
  TiltState state;
};

/// The rate of the tilt that takes the error back and follows the design's cross slope while the
/// body rolls, for `then`: the moment at which the cylinder answers. `now` is measured, and what
/// stays of its error is integrated, unless the pump can give no more (not `fed`) or the end of the
/// stroke slows the cylinder. `last` is that of a cycle ago; a default one where there was none.
[[nodiscard]] TiltCommand control_tilt(const TiltProfile& profile, const DriveRow& drive,
                                       const TiltKinematics& tilt, const GradeProfile& design,
                                       const TiltState& last, const TiltSituation& now,
                                       const TiltSituation& then, bool fed, double period_s);

}  // namespace graben
