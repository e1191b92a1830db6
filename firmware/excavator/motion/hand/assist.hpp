// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The design under the bucket that Task::kAssist holds its edge on, in the plane of the boom: x
/// outwards, y up, from the boom foot's pin.

#include "firmware/excavator/fences/fence.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"

namespace graben {

/// A line that no corner of the edge is to be under while its middle is on it.
struct AssistLine {
  bool known = false;                             ///< There is a design.
  Eigen::Vector2d up = Eigen::Vector2d::UnitY();  ///< Of length 1, out of the ground.
  double from_foot_m = 0.0;                       ///< Of the pin to the line, along `up`.

  [[nodiscard]] double height_m(const TipPose& tip) const {
    return up.x() * tip.x_m + up.y() * tip.y_m - from_foot_m;
  }
  /// Outwards, along the surface.
  [[nodiscard]] Eigen::Vector2d along() const { return {up.y(), -up.x()}; }
};

/// The design is the last of a program's fences. `shown_off_m`: the edge is shown so much too far
/// outwards and up. The line lies assist.offset over the design.
[[nodiscard]] AssistLine assist_line(const ExcavatorProfile& profile, const FenceSet& fences,
                                     double swing_rad, const Eigen::Vector2d& shown_off_m);

}  // namespace graben
