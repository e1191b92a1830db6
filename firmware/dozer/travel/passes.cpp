// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/passes.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// Before what is left, to get under way and bring the blade down.
constexpr double kRunUp_m = 1.2;
/// More than what is allowed, for the noise of what is measured.
constexpr double kWorthIt_m = 0.005;
constexpr double kLessDeep = 0.5;
constexpr double kClear_m = 0.25;
constexpr double kClear_mps = 0.2;
constexpr double kStands_mps = 0.05;
constexpr double kFastestBack_mps = 1.0;

/// Every pass goes on to the design's end: what the blade carries is dumped behind it.
double end_m(const GradeDesign& design) {
  return design.point[static_cast<unsigned>(std::max(design.count, 1) - 1)].x_m;
}

void note(const GradeDesign& design, const PassSituation& now, PassState& state) {
  const double first_m = design.point[0].x_m;
  if (now.edge_x_m < first_m || now.edge_x_m > end_m(design) ||
      now.error_m <= design.tolerance_m + kWorthIt_m) {
    return;
  }
  state.from_m = state.left ? std::min(state.from_m, now.edge_x_m) : now.edge_x_m;
  state.left = true;
  state.not_deep = state.not_deep || now.pass_error_m > design.tolerance_m + kWorthIt_m;
}

/// The next pass begins as the machine stands before what is left.
void begin_pass(const GradeDesign& design, PassState& state) {
  state.phase = PassPhase::kCut;
  const double step_m = state.step_m > 0.0 ? state.step_m : design.pass_depth_m;
  // What it could not cut in one pass, it takes in smaller ones.
  state.deep_m += state.not_deep ? kLessDeep * step_m : step_m;
  state.step_m = state.not_deep ? kLessDeep * step_m : step_m;
  state.not_deep = false;
  ++state.pass;
  state.left = false;
}

void clear_blade(double wanted_m, double period_s, PassState& state) {
  const double step_m = kClear_mps * std::max(0.0, period_s);
  const double last_m = state.clear_m;
  state.clear_m += std::clamp(wanted_m - state.clear_m, -step_m, step_m);
  state.clear_mps = period_s > 0.0 ? (state.clear_m - last_m) / period_s : 0.0;
}

}  // namespace

PassState next_pass(const GradeDesign& design, const PassState& last, const PassSituation& now,
                    double period_s) {
  PassState state = last;
  const bool stands = std::abs(now.velocity_mps) < kStands_mps;
  if (state.phase == PassPhase::kCut) {
    // The blade on its way down at the beginning is no ground that is left.
    if (state.clear_m <= 0.0) {
      note(design, now, state);
    }
    if (now.edge_x_m >= end_m(design) && !state.finished) {
      const bool again = state.left && state.pass < design.passes_most;
      state.finished = !again;
      state.phase = again ? PassPhase::kStop : PassPhase::kCut;
    }
  } else if (state.phase == PassPhase::kStop && stands && state.clear_m >= kClear_m) {
    state.phase = PassPhase::kReturn;
  } else if (state.phase == PassPhase::kReturn && now.edge_x_m <= state.from_m - kRunUp_m) {
    state.phase = PassPhase::kTurn;
  } else if (state.phase == PassPhase::kTurn && stands) {
    begin_pass(design, state);
  }
  clear_blade(state.phase == PassPhase::kCut ? 0.0 : kClear_m, period_s, state);
  return state;
}

double pass_floor_m(const GradeDesign& design, const PassState& state) {
  return design.ground_m - state.deep_m - (state.step_m > 0.0 ? state.step_m : design.pass_depth_m);
}

double pass_speed_mps(const PassState& state, const PassSituation& now, double desired_mps,
                      double deceleration_mps2) {
  if (state.phase != PassPhase::kReturn) {
    return 0.0;
  }
  const double way_m = std::max(0.0, now.edge_x_m - (state.from_m - kRunUp_m));
  const double braked_mps = std::sqrt(2.0 * deceleration_mps2 * way_m) + kStands_mps;
  return -std::min({desired_mps, kFastestBack_mps, braked_mps});
}

}  // namespace graben
