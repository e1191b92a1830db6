// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "firmware/excavator/motion/dig/dig_phases.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"

namespace graben {
namespace {

double way_out_m(const ExcavatorProfile& profile, int axis, const DriveVector& from) {
  const double stroke_m = profile.geometry.cylinder[static_cast<unsigned>(axis)].stroke_m;
  return std::min(kTareMoves * stroke_m, kTareMovesOfLeft * std::max(0.0, stroke_m - from[axis]));
}

/// The boom up and the arm in; then the arm out again.
DriveVector tared(const ExcavatorProfile& profile, TarePart part, const DriveVector& from) {
  DriveVector to = from;
  if (part == TarePart::kRaises) {
    to[kBoom] += way_out_m(profile, kBoom, from);
    to[kArm] += way_out_m(profile, kArm, from);
  } else {
    const double stroke_m = profile.geometry.cylinder[kArm].stroke_m;
    to[kArm] -= std::min(kTareMoves * stroke_m, std::max(0.0, from[kArm]));
  }
  return to;
}

}  // namespace

void TarePhase::enter(const DigCycle& cycle, int step, TaskState& state) {
  const DriveVector from = drives_now(cycle, state);
  DigRun& run = state.dig;
  run.tares = run.tares == TarePart::kRaises ? TarePart::kReaches : TarePart::kRaises;
  const double pace_ratio = cycle.program.step[static_cast<unsigned>(step)].pace_ratio;
  run.move = plan_drives(drive_limits(cycle.profile), from, tared(cycle.profile, run.tares, from),
                         {pace_ratio, 0.0});
  run.tared = true;
}

bool TarePhase::go_on(const DigCycle& cycle, TaskState& state) {
  state.time_s += state.pace_ratio * cycle.advance_s;
  state.settle_s += cycle.period_s;
  const double end_s = state.dig.move.ramp.duration_s;
  if (state.settle_s > kTaresMost_s) {
    return true;
  }
  if (state.time_s < end_s) {
    return false;
  }
  state.time_s = end_s;
  state.settle_s += cycle.period_s;
  return cycle.seen.behind_m < kPassed_share * cycle.plan().bucket_m ||
         state.settle_s >= kSettleMost_s;
}

void TarePhase::leave(const DigCycle& cycle, TaskState& state) {
  if (state.dig.tares == TarePart::kRaises) {
    enter_phase<TarePhase>(cycle, state.step, state);
  } else {
    state.dig.tares = TarePart::kNone;
    enter_step(cycle, state.step, state);
  }
}

}  // namespace graben
