// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/layer_height.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"

namespace graben {
namespace {

/// Speed towards a height that comes to rest there.
double speed_towards(double from_m, double to_m, double speed_mps, double most_down_mps,
                     double period_s) {
  const double off_m = to_m - from_m;
  const double brakes_mps = std::sqrt(2.0 * kHeightChange_mps2 * std::abs(off_m));
  const double most_mps = off_m > 0.0 ? kGives_mps : most_down_mps;
  const double wanted_mps = std::copysign(std::min(most_mps, brakes_mps), off_m);
  const double change_mps = kHeightChange_mps2 * period_s;
  return std::clamp(wanted_mps, speed_mps - change_mps, speed_mps + change_mps);
}

}  // namespace

double seen_height_m(const TaskProgram& program, const CutSeen& seen, const TaskState& state) {
  const int strip = state.dug.cuts.cut.strip;
  const TeethLine line = line_over(program, strip, state.dug.zero_m);
  return turned(program.layers.up, strip_rad(program.layers, strip))
      .dot(seen.teeth.position_m - line.from.position_m);
}

double wanted_height_m(const TaskProgram& program, const TaskState& state) {
  const Cut& cut = state.dug.cuts.cut;
  const double share = state.dig.share;
  const double steep = cut.thin ? cut.steep * steepness(program, cut, share).share : 0.0;
  // The foot of a wall beyond the line: nothing has to be met there, and it may break off.
  const double beyond_m = std::max(0.0, -share * program.layers.way_m);
  // And where it ends, a heel that has stood on it comes down.
  const double on_foot = cut.from_share < 0.0 ? std::clamp(1.0 - share / kOffFoot, 0.0, 1.0) : 0.0;
  return cut.height_m + std::max(kSteepHigher_m * steep, kFootHigher_m * on_foot) +
         kFoot / program.layers.bucket_m * beyond_m * beyond_m;
}

void rise(const DigCycle& cycle, double target_m, double most_down_mps, TaskState& state) {
  DigRun& run = state.dig;
  run.height_mps =
      speed_towards(run.height_m, target_m, run.height_mps, most_down_mps, cycle.period_s);
  // The way up is free where the way down is barred.
  const double by_s = run.height_mps > 0.0
                          ? std::max(cycle.advance_s, kRisesAtLeast * cycle.period_s)
                          : state.pace_ratio * cycle.advance_s;
  const double height_m = run.height_m + by_s * run.height_mps;
  const TeethPose there =
      cut_pose(cycle.program, state.dug.cuts.cut, run.share, height_m + state.dug.zero_m);
  if (cycle.kinematics.drive_from_teeth(there).blind.kind == BlindKind::kNone) {
    run.height_m = height_m;
  } else {
    run.height_mps = 0.0;
  }
}

}  // namespace graben
