// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Plans a dig step in layers: what fills the bucket, how deep and how hard it may be cut, and
/// whether the machine can be wherever a cut may lead it.

#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben {

/// Of step 0 of the program, whose line is planned. `place` is where the machine can't be, or has
/// BlindKind::kNone.
struct LayerPlanResult {
  LayerPlan plan;
  BlindPlace place;
};
[[nodiscard]] LayerPlanResult plan_layers(const ExcavatorProfile& profile,
                                          const SwingKinematics& kinematics,
                                          const ProgramRequest& request,
                                          const TaskProgram& program);

/// Force on the teeth along `way` (length 1, x outwards, y up) at which the first cylinder holds
/// against it with all that its pump's relief allows, N.
[[nodiscard]] double holding_force_n(const ExcavatorProfile& profile, const KinematicState& at,
                                     const Eigen::Vector2d& way);

}  // namespace graben
