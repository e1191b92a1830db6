// SPDX-License-Identifier: Apache-2.0
/// Walls that fall in, and are cut back beyond the line.

#include "firmware/excavator/motion/dig/cut_force.hpp"
#include "firmware/excavator/motion/dig/dig_run.hpp"
#include "firmware/excavator/motion/dig/layer_height.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"
#include "tests/unit/firmware/layer_machine.hpp"

using namespace graben::layer_test;

/// Where the last cut goes along; from `beyond_m` before its line on.
TaskState last_cut(const TaskProgram& program, double beyond_m) {
  TaskState state = run_until(program, begun(program), [](const TaskState& at) {
    return in_cut(at) && at.dug.cuts.cut.thin;
  });
  DigRun& run = state.dig;
  state.dug.cuts.cut.from_share = -beyond_m / program.layers.way_m;
  run.share = state.dug.cuts.cut.from_share;
  run.seen_share = run.share;
  run.height_m = wanted_height_m(program, state);
  run.give_m = 0.0;
  return state;
}

TEST(a_wall_s_foot_is_left_standing) {
  const TaskProgram program = planned();
  TaskState state = last_cut(program, 0.4);
  const double design_m = state.dug.cuts.cut.height_m;
  assert_true(state.dig.height_m > design_m + 0.08);
  double last_m = state.dig.height_m;
  state = run_until(program, state, [&](const TaskState& at) {
    assert_true(!in_cut(at) || at.dig.height_m < last_m + 1e-3);
    last_m = at.dig.height_m;
    return at.dig.share >= 0.0;
  });
  assert_true(in_cut(state));
  assert_true(state.dig.height_m < design_m + 0.015);
  // A heel that still stands on it comes down farther on.
  assert_true(state.dig.height_m > design_m + kSteepHigher_m + 2e-3);
  state = run_until(program, state, [](const TaskState& at) { return at.dig.share >= 0.1; });
  assert_true(state.dig.height_m < design_m + kSteepHigher_m + 1e-3);
}

/// Teeth that come down it arrive level.
TEST(a_wall_s_foot_runs_out_level) {
  const TaskProgram program = planned();
  TaskState state = last_cut(program, 0.4);
  const auto height_m = [&](double beyond_m) {
    state.dig.share = -beyond_m / program.layers.way_m;
    return wanted_height_m(program, state);
  };
  const double line_m = height_m(0.0);
  assert_true(height_m(0.05) - line_m < 0.005);
  assert_true(height_m(0.4) - line_m > 0.18);
}

/// Teeth sink by what the oil gives under the force that bears the heel up, on a foot alone.
TEST(a_foot_that_bears_is_no_hold) {
  const LayerPlan plan = planned().layers;
  assert_true(plan.give_down_mpn > 0.0);
  CutSeen seen;
  seen.force_known = true;
  seen.force_n = {-5e3, 0.04 / plan.give_down_mpn};
  Cut cut;
  cut.from_share = -0.2;
  assert_near(off_foot_m(plan, cut, seen), 0.04, 1e-9);
  seen.force_n.y() = -seen.force_n.y();
  assert_near(off_foot_m(plan, cut, seen), 0.0, 0.0);
  seen.force_n.y() = -seen.force_n.y();
  seen.force_known = false;
  assert_near(off_foot_m(plan, cut, seen), 0.0, 0.0);
  seen.force_known = true;
  cut.from_share = 0.0;
  assert_near(off_foot_m(plan, cut, seen), 0.0, 0.0);
}

/// Until the cut ends, s; or as long as is looked.
double held_for_s(const TaskProgram& program, TaskState state, double force) {
  constexpr int kLooks = 300;
  for (int n = 0; n < kLooks; ++n) {
    if (!in_cut(state)) {
      return n * kCycle_s;
    }
    CutSeen seen = follows(program, state);
    seen.force_n = {force * program.layers.force_n, 0.0};
    const double share = state.dig.share;
    state = advance(program, state, seen);
    state.dig.share = share;
  }
  return kLooks * kCycle_s;
}

/// It may break off: the oil would throw the teeth through the design.
TEST(a_wall_is_pulled_at_with_less) {
  const TaskProgram program = planned();
  assert_true(held_for_s(program, last_cut(program, 0.4), 0.8) < 0.9);
  assert_near(held_for_s(program, last_cut(program, 0.0), 0.8), 3.0, 1e-9);
  assert_near(held_for_s(program, last_cut(program, 0.4), 0.5), 3.0, 1e-9);
}

TEST(a_folded_heel_that_bears_goes_straight_up) {
  const TaskProgram program = planned();
  const TaskState state = folding(program);
  const auto after = [&](double force) {
    return pressed(program, state, 55, {-0.6 * force, 0.8 * force}).dig.lift.line.change;
  };
  assert_true(std::abs(after(1.2).attitude_rad) > 0.1);
  assert_near(after(2.0).attitude_rad, 0.0, 1e-9);
  assert_true(after(2.0).position_m.z() > 0.2);
}
