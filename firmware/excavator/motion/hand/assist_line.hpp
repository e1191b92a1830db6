// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The design under the bucket as Task::kAssist follows it: its section in the plane of the boom.

#include "firmware/drives/velocity_cap.hpp"
#include "firmware/excavator/fences/fence.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/excavator/motion/hand/tuning.hpp"

namespace graben {

/// A straight piece of that section, x outwards, y up, from the boom foot's pin. With the edge's
/// middle on that line none of its corners is under the design.
struct AssistLine {
  bool known = false;                             ///< There is a design here.
  Eigen::Vector2d up = Eigen::Vector2d::UnitY();  ///< Of length 1, out of the ground.
  double from_foot_m = 0.0;                       ///< Of the pin to the line, along `up`.

  [[nodiscard]] double height_m(const TipPose& tip) const {
    return up.x() * tip.x_m + up.y() * tip.y_m - from_foot_m;
  }
  /// Outwards, along the surface.
  [[nodiscard]] Eigen::Vector2d along() const { return {up.y(), -up.x()}; }
};

/// The section where the edge is, where it is to be, and what lies ahead. Of a plane both lines are
/// the same and nothing lies ahead.
struct AssistDesign {
  bool present = false;                    ///< The task has a design; it need not reach to here.
  bool lost = false;                       ///< It has one, and where that lies is not known.
  AssistLine now;                          ///< Under the edge as it is measured.
  AssistLine at;                           ///< Under the edge as it is planned.
  SpeedCap ahead{kAssistFastest_mps, {}};  ///< Along the design.

  /// The edge is beyond the design's border, or so near to it that its slope is not known.
  [[nodiscard]] bool beyond() const { return present && !(now.known && at.known); }
};

/// Where the section is looked at.
struct AssistView {
  double now_m = 0.0;  ///< x of the edge as it is measured, from the boom foot's pin,
  double at_m = 0.0;   ///< and as it is planned.
  double way = 0.0;    ///< Outwards: 1, inwards: -1; 0: nothing moves it.
};

/// The design is the last of a program's fences. `shown_off_m`: the edge is shown so much too far
/// outwards and up. The lines lie assist.offset over the design. Of a surface a line's slope is
/// that between kAssistKink_m before and behind where the edge is planned.
[[nodiscard]] AssistDesign assist_design(const ExcavatorProfile& profile, const FenceView& fences,
                                         double swing_rad, const Eigen::Vector2d& shown_off_m,
                                         const AssistView& view);

}  // namespace graben
