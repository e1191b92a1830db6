// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/cut_force.hpp"
#include "firmware/excavator/motion/dig/dig_phases.hpp"
#include "firmware/excavator/motion/dig/layer_height.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"

namespace graben {
namespace {

/// What the teeth spring down by when the ground bears them no more.
double springs_m(const LayerPlan& plan, const CutSeen& seen) {
  return seen.force_known ? plan.give_down_mpn * std::max(0.0, seen.force_n.y()) : 0.0;
}

bool lets_off(const DigCycle& cycle, TaskState& state) {
  DigRun& run = state.dig;
  const double seen_m = seen_height_m(cycle.program, cycle.seen, state);
  rise(cycle, seen_m + kLetsOff_m, kEnters_mps, state);
  run.held_s += cycle.period_s;
  return springs_m(cycle.plan(), cycle.seen) < kEntersSpringFree_m || run.held_s > kLetsOff_s ||
         seen_m > run.stood_m + kLifted_m;
}

}  // namespace

void EnterPhase::enter(const DigCycle& /*cycle*/, int /*step*/, TaskState& state) {
  DigRun& run = state.dig;
  const Cut& cut = state.dug.cuts.cut;
  run.share = cut.from_share;
  run.seen_share = cut.from_share;
  run.height_m = cut.enters_m;
  run.height_mps = 0.0;
  run.rate_ps = 0.0;
  run.give_m = 0.0;
  state.dug.cuts.filled_m3 = 0.0;
  run.cut_s = 0.0;
  run.heavy_s = 0.0;
  run.held_s = 0.0;
  run.eases = false;
  run.weighed_kg = 0.0;
}

bool EnterPhase::go_on(const DigCycle& cycle, TaskState& state) {
  DigRun& run = state.dig;
  if (run.eases) {
    return lets_off(cycle, state);
  }
  const CutSeen& seen = cycle.seen;
  const Cut& cut = state.dug.cuts.cut;
  const double target_m = wanted_height_m(cycle.program, state);
  const double seen_m = seen_height_m(cycle.program, seen, state);
  // Teeth that are off to a side, their platform still swinging, are held up by nothing.
  CutSeen over = seen;
  over.behind_m = std::max(0.0, seen_m - run.height_m);
  const double force = force_share(cycle.plan(), cut_line(cycle.program, state), seen, true);
  const double heavy = heaviness(cycle.plan(), force / state.dug.cuts.force, over);
  const double springs = springs_m(cycle.plan(), seen);
  const bool stops = heavy > 1.0 || kThrows * springs > seen_m + kEntersSpringMost_m;
  const double over_m = std::max(0.0, run.height_m - cut.stands_m - kEntersSlowFrom_m);
  const double down_mps = std::min(
      kEntersFalls_mps, std::sqrt(kEnters_mps * kEnters_mps + 2.0 * kHeightChange_mps2 * over_m));
  rise(cycle, stops ? std::max(target_m, seen_m) : target_m, down_mps, state);
  const bool arrived = run.height_m - target_m < kAtLayer_m;
  if (stops || arrived) {
    run.held_s += cycle.period_s;
  }
  const bool down = seen_m - target_m < (cut.thin ? kDown_m : kRoughDown_m);
  if (!(arrived && down) && !(run.held_s > kEntersHeld_s)) {
    return false;
  }
  run.eases = springs > kEntersSpringFree_m;
  run.stood_m = seen_m;
  run.held_s = 0.0;
  return !run.eases;
}

void EnterPhase::leave(const DigCycle& cycle, TaskState& state) {
  enter_phase<CutsPhase>(cycle, state.step, state);
}

}  // namespace graben
