// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/layer_tare.hpp"

#include <algorithm>

namespace graben {
namespace {

/// Of a drive's stroke, and of what is left of it.
constexpr double kMoves = 0.12;
constexpr double kMovesOfLeft = 0.5;

double way_out_m(const ExcavatorProfile& profile, int axis, const DriveVector& from) {
  const double stroke_m = profile.geometry.cylinder[static_cast<unsigned>(axis)].stroke_m;
  return std::min(kMoves * stroke_m, kMovesOfLeft * std::max(0.0, stroke_m - from[axis]));
}

}  // namespace

bool tares_next(const TaskProgram& program, int step, const LayerState& layers) {
  return !layers.tared && layers.weighed_kg > 0.0 &&
         program.step[static_cast<unsigned>(step)].kind == StepKind::kReturnToDig;
}

DrivePlan tare_move(const ExcavatorProfile& profile, const TaskStep& step, TarePart part,
                    const DriveVector& from) {
  DriveVector to = from;
  if (part == TarePart::kRaises) {
    to[kBoom] += way_out_m(profile, kBoom, from);
    to[kArm] += way_out_m(profile, kArm, from);
  } else {
    const double stroke_m = profile.geometry.cylinder[kArm].stroke_m;
    to[kArm] -= std::min(kMoves * stroke_m, std::max(0.0, from[kArm]));
  }
  return plan_drives(drive_limits(profile), from, to, {step.pace_ratio, 0.0});
}

}  // namespace graben
