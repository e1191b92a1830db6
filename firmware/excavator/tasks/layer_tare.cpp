// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/tasks/layer_tare.hpp"

#include <algorithm>

namespace graben {
namespace {

/// Of the boom's stroke, and of what is left of it.
constexpr double kRises = 0.12;
constexpr double kRisesOfLeft = 0.5;

}  // namespace

bool tares_next(const TaskProgram& program, int step, const LayerState& layers) {
  return !layers.tared && layers.weighed_kg > 0.0 &&
         program.step[static_cast<unsigned>(step)].kind == StepKind::kReturnToDig;
}

DrivePlan tare_move(const ExcavatorProfile& profile, const TaskStep& step,
                    const DriveVector& from) {
  const double stroke_m = profile.geometry.cylinder[kBoom].stroke_m;
  const double left_m = std::max(0.0, stroke_m - from[kBoom]);
  DriveVector to = from;
  to[kBoom] += std::min(kRises * stroke_m, kRisesOfLeft * left_m);
  return plan_drives(drive_limits(profile), from, to, {step.pace_ratio, 0.0});
}

}  // namespace graben
