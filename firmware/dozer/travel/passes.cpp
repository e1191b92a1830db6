// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/passes.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/travel/tuning.hpp"

namespace graben {
namespace {

void note(const GradeDesign& design, const PassSituation& now, double period_s, PassState& state) {
  state.error_m += (now.error_m - state.error_m) * period_s / (kPassErrorFilter_s + period_s);
  // Before where the last pass first left something, the ground is as it is to be, whatever an edge
  // that is still on its way down does over it.
  const double from_m = state.pass > 1 ? state.due_m : design.begin_m();
  if (now.edge_x_m < from_m || now.edge_x_m > design.end_m() ||
      state.error_m <= design.tolerance_m + kPassWorthIt_m) {
    return;
  }
  state.from_m = state.left ? std::min(state.from_m, now.edge_x_m) : now.edge_x_m;
  state.left = true;
  state.left_m2 +=
      (state.error_m - design.tolerance_m) * std::max(0.0, now.velocity_mps * period_s);
}

/// At its end.
bool is_another_worth_it(const GradeDesign& design, PassState& state) {
  const bool lowers =
      state.last_left_m2 <= 0.0 || state.left_m2 <= kPassLowers * state.last_left_m2;
  state.vain = lowers ? 0 : state.vain + 1;
  return state.left && state.vain < kPassVainMost && state.pass < design.passes_most;
}

/// How hard it is, all the way.
void feel(const GradeDesign& design, const PassSituation& now, double period_s, PassState& state) {
  if (now.edge_x_m >= design.begin_m() && now.edge_x_m <= design.end_m()) {
    const double way_m = std::max(0.0, now.velocity_mps * period_s);
    state.most_push = std::max(state.most_push, now.push);
    state.lifted_m2 += now.lift_m * way_m;
    state.way_m += way_m;
  }
}

/// The next pass begins as the machine stands before what is left.
void begin_pass(const GradeDesign& design, PassState& state) {
  const double depth_m = state.depth_m > 0.0 ? state.depth_m : design.pass_depth_m;
  const double step_m = state.step_m > 0.0 ? state.step_m : design.pass_depth_m;
  const double lifted_m = state.way_m > 0.0 ? state.lifted_m2 / state.way_m : 0.0;
  const double lacked = std::min(1.0, kPassLiftCounts * lifted_m / step_m);
  const double spare = std::clamp(kPassFullPush / std::max(state.most_push, 0.1), 1.0, kPassDeeper);
  state.step_m =
      std::max(kPassLeastStep_m, step_m * (lacked > kPassLacked ? kPassLessDeep : spare));
  state.depth_m = depth_m + std::max(kPassLeastStep_m, (1.0 - lacked) * state.step_m);
  state.most_push = 0.0;
  state.lifted_m2 = 0.0;
  state.way_m = 0.0;
  state.down = false;
  state.due_m = state.from_m;
  state.phase = PassPhase::kCut;
  ++state.pass;
  state.left = false;
  state.last_left_m2 = state.vain > 0 ? std::min(state.last_left_m2, state.left_m2) : state.left_m2;
  state.left_m2 = 0.0;
  state.error_m = 0.0;
}

void clear_blade(double wanted_m, double period_s, PassState& state) {
  const double step_m = kPassClear_mps * std::max(0.0, period_s);
  const double last_m = state.clear_m;
  state.clear_m += std::clamp(wanted_m - state.clear_m, -step_m, step_m);
  state.clear_mps = period_s > 0.0 ? (state.clear_m - last_m) / period_s : 0.0;
}

}  // namespace

PassState next_pass(const GradeDesign& design, const PassState& last, const PassSituation& now,
                    double period_s) {
  PassState state = last;
  const bool stands = std::abs(now.velocity_mps) < kPassStands_mps;
  if (state.phase == PassPhase::kCut) {
    state.down = state.down || now.edge_x_m >= state.due_m ||
                 (state.clear_m <= 0.0 && now.error_m <= design.tolerance_m);
    // The blade on its way down at the beginning is no ground that is left.
    if (state.down) {
      note(design, now, period_s, state);
      feel(design, now, period_s, state);
    }
    // Every pass goes on to the design's end: what the blade carries is dumped behind it.
    if (now.edge_x_m >= design.end_m() && !state.finished) {
      const bool again = is_another_worth_it(design, state);
      state.finished = !again;
      state.phase = again ? PassPhase::kStop : PassPhase::kCut;
    }
  } else if (state.phase == PassPhase::kStop && stands && state.clear_m >= kPassClear_m) {
    state.phase = PassPhase::kReturn;
  } else if (state.phase == PassPhase::kReturn && now.edge_x_m <= state.from_m - kPassRunUp_m) {
    state.phase = PassPhase::kTurn;
  } else if (state.phase == PassPhase::kTurn && stands) {
    begin_pass(design, state);
  }
  clear_blade(state.phase == PassPhase::kCut ? 0.0 : kPassClear_m, period_s, state);
  return state;
}

double pass_floor_m(const GradeDesign& design, const PassState& state) {
  return design.ground_m - (state.depth_m > 0.0 ? state.depth_m : design.pass_depth_m);
}

double pass_speed_mps(const PassState& state, const PassSituation& now, double desired_mps,
                      double deceleration_mps2) {
  if (state.phase != PassPhase::kReturn) {
    return 0.0;
  }
  const double way_m = std::max(0.0, now.edge_x_m - (state.from_m - kPassRunUp_m));
  const double braked_mps = std::sqrt(2.0 * deceleration_mps2 * way_m) + kPassStands_mps;
  return -std::min({desired_mps, kPassFastestBack_mps, braked_mps});
}

}  // namespace graben
