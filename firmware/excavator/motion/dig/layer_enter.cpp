// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/layer_height.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/cut_force.hpp"

namespace graben {
namespace {

constexpr double kFalls_mps = 0.8;
/// From so far over the soil on it comes down slower.
constexpr double kSlowsFrom_m = 0.05;
constexpr double kEnters_mps = 0.3;
/// A cut's height is reached this near to it, by the plan and by the teeth: of the last cut, and of
/// others.
constexpr double kAtLayer_m = 2e-3;
constexpr double kDown_m = 0.008;
constexpr double kRoughDown_m = 0.02;
constexpr double kHeld_s = 1.0;
/// What springs by less is let be; and what would spring by more through the design is not pressed.
constexpr double kSpringFree_m = 0.010;
constexpr double kSpringMost_m = 0.020;
/// Oil that is let go throws its load farther than it gives under it, and is softer than its file
/// says.
constexpr double kThrows = 3.0;
/// The plan goes so far up over the teeth to let off.
constexpr double kLetsOff_m = 0.10;
constexpr double kLetsOff_s = 0.8;
constexpr double kLifted_m = 0.010;

/// What the teeth spring down by when the ground bears them no more.
double springs_m(const LayerPlan& plan, const CutSeen& seen) {
  return seen.force_known ? plan.give_down_mpn * std::max(0.0, seen.force_n.y()) : 0.0;
}

void begin_cutting(const TaskProgram& program, const CutSeen& seen, TaskState& state) {
  LayerState& layers = state.layers;
  const double least_m = wanted_height_m(program, layers);
  if (layers.eases) {
    layers.height_m = std::max(least_m, seen_height_m(program, seen, state));
    layers.height_mps = 0.0;
    layers.eases = false;
  }
  // What it can't be pressed down to is come down to on the way.
  layers.give_m = std::max(0.0, layers.height_m - least_m);
  layers.phase = CutPhase::kCuts;
  layers.entered = seen.teeth;
  layers.held_s = 0.0;
}

void let_off(const LayerCycle& cycle, const CutSeen& seen, TaskState& state) {
  LayerState& layers = state.layers;
  const double seen_m = seen_height_m(cycle.program, seen, state);
  rise(cycle, seen_m + kLetsOff_m, kEnters_mps, state);
  layers.held_s += cycle.period_s;
  if (springs_m(cycle.program.layers, seen) < kSpringFree_m || layers.held_s > kLetsOff_s ||
      seen_m > layers.stood_m + kLifted_m) {
    begin_cutting(cycle.program, seen, state);
  }
}

}  // namespace

void enter_on(const LayerCycle& cycle, const CutSeen& seen, TaskState& state) {
  LayerState& layers = state.layers;
  if (layers.eases) {
    let_off(cycle, seen, state);
    return;
  }
  const LayerPlan& plan = cycle.program.layers;
  const Cut& cut = layers.cuts.cut;
  const double target_m = wanted_height_m(cycle.program, layers);
  const double seen_m = seen_height_m(cycle.program, seen, state);
  // Teeth that are off to a side, their platform still swinging, are held up by nothing.
  CutSeen over = seen;
  over.behind_m = std::max(0.0, seen_m - layers.height_m);
  const double heavy =
      heaviness(force_share(plan, cut_line(cycle.program, state), seen, true), over);
  const double springs = springs_m(plan, seen);
  const bool stops = heavy > 1.0 || kThrows * springs > seen_m + kSpringMost_m;
  const double over_m = std::max(0.0, layers.height_m - cut.stands_m - kSlowsFrom_m);
  const double down_mps = std::min(
      kFalls_mps, std::sqrt(kEnters_mps * kEnters_mps + 2.0 * kHeightChange_mps2 * over_m));
  rise(cycle, stops ? std::max(target_m, seen_m) : target_m, down_mps, state);
  const bool arrived = layers.height_m - target_m < kAtLayer_m;
  if (stops || arrived) {
    layers.held_s += cycle.period_s;
  }
  const bool down = seen_m - target_m < (cut.thin ? kDown_m : kRoughDown_m);
  if ((arrived && down) || layers.held_s > kHeld_s) {
    layers.eases = springs > kSpringFree_m;
    layers.stood_m = seen_m;
    layers.held_s = 0.0;
    if (!layers.eases) {
      begin_cutting(cycle.program, seen, state);
    }
  }
}

}  // namespace graben
