// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/layer_pose.hpp"

#include <algorithm>

#include "tests/unit/firmware/layer_machine.hpp"

using layer_test::machine;
using test::kCycle_s;

/// Of a level trench, or of a slope that falls to the machine.
TaskProgram planned(double near_m, bool touches = true) {
  constexpr double kFar_m = -0.3;
  ProgramRequest request;
  request.start = {{6.4, 0.0, kFar_m}, 1.3};
  StepRequest& dig = request.step[0];
  dig.kind = StepKind::kDig;
  dig.to = {{5.0, 0.0, near_m}, 1.1};
  dig.speed_mps = 0.6;
  dig.in_layers = true;
  dig.touches = touches;
  request.step[1] = {StepKind::kSwing, {{2.0, 3.5, 2.3}, 0.3}, false, 0.0, 0.0, 0.7};
  request.step[2] = {StepKind::kReturnToDig, request.start, false, 0.0, 0.0, 0.7};
  request.step_count = 3;
  request.repeats = true;
  request.has_design = true;
  const Eigen::Vector3d up(near_m - kFar_m, 0.0, 1.4);
  request.design = {request.start.position_m, up.normalized(), 0.0};
  const ProgramResult result = plan_program(machine().profile, request);
  assert_int_equal(result.refusal, ProgramRefusal::kNone);
  return result.program;
}

enum class Bearing { kByForce, kByPlace };

/// Until a cut begins, over ground that the sensors see at `ground_m`.
TaskState touched(const TaskProgram& program, double ground_m, Bearing bearing) {
  constexpr double kWeight_n = 900.0;
  TaskState state = task_start(machine().profile, machine().kinematics, program, program.start);
  for (int n = 0; state.dig.phase != CutPhase::kEnters; ++n) {
    assert_true(n < 20000);
    CutSeen seen;
    seen.teeth = task_aim(machine().kinematics, program, state).teeth;
    const double sinks_m = ground_m - seen.teeth.position_m.z();
    seen.teeth.position_m.z() = std::max(seen.teeth.position_m.z(), ground_m);
    seen.force_known = bearing == Bearing::kByForce;
    // What is told of the air is not 0.
    seen.force_n = {0.0, kWeight_n + std::max(0.0, sinks_m) * 4e6};
    dig_advance(machine().profile, machine().kinematics, program, kCycle_s, kCycle_s, seen, state);
  }
  return state;
}

TEST(counts_heights_from_the_ground) {
  for (const Bearing bearing : {Bearing::kByForce, Bearing::kByPlace}) {
    for (const double ground_m : {-0.022, 0.0, 0.017}) {
      const TaskProgram level = planned(-0.3);
      const TaskState state = touched(level, ground_m, bearing);
      assert_true(state.dug.touched);
      assert_near(state.dug.zero_m, ground_m, 1.5e-3);
      // The cut's line is as much higher as the ground is seen.
      const TeethLine cut = cut_line(level, state);
      const TeethLine plain = line_over(level, state.dug.cuts.cut.strip, state.dig.height_m);
      assert_near(cut.from.position_m.z() - plain.from.position_m.z(), state.dug.zero_m, 1e-9);
    }
  }
}

/// Along the design's normal.
TEST(counts_heights_over_a_slope) {
  const TaskProgram slope = planned(-0.9);
  const TaskState state = touched(slope, 0.02, Bearing::kByForce);
  assert_near(state.dug.zero_m, 0.02 * slope.layers.up.z(), 1.5e-3);
  assert_true(slope.layers.up.z() < 0.95);
}

TEST(ground_that_is_not_where_it_should_be_is_not_believed) {
  const TaskProgram level = planned(-0.3);
  for (const double ground_m : {-0.5, 0.068, 0.2}) {
    const TaskState state = touched(level, ground_m, Bearing::kByForce);
    assert_true(state.dug.touched);
    assert_near(state.dug.zero_m, 0.0, 0.0);
  }
}

/// Slow teeth stay behind their plan by more than what would be ground, and noise is no weight.
TEST(late_teeth_in_the_air_are_not_on_the_ground) {
  constexpr double kLate_m = 0.03;
  constexpr double kGround_m = -0.03;
  const TaskProgram level = planned(-0.3);
  TaskState state = task_start(machine().profile, machine().kinematics, level, level.start);
  for (int n = 0; state.dig.phase != CutPhase::kEnters; ++n) {
    assert_true(n < 20000);
    CutSeen seen;
    seen.teeth = task_aim(machine().kinematics, level, state).teeth;
    const double late_m = seen.teeth.position_m.z() + kLate_m;
    seen.teeth.position_m.z() = std::max(late_m, kGround_m);
    seen.force_known = true;
    seen.lambda = 1.0;
    const double noise_n = 0.06 * level.layers.force_n * (n % 2 == 0 ? 1.0 : -1.0);
    seen.force_n = {0.0, noise_n + std::max(0.0, kGround_m - late_m) * 4e6};
    dig_advance(machine().profile, machine().kinematics, level, kCycle_s, kCycle_s, seen, state);
  }
  assert_near(state.dug.zero_m, kGround_m, 2e-3);
}

/// Only where the task says so, and once: what is known of the ground stays when the task rests.
TEST(touches_once) {
  const TaskProgram plain = planned(-0.3, false);
  assert_true(plain.layers.touch_share < 0.0);
  const TaskProgram level = planned(-0.3);
  assert_near(level.layers.touch_share, 0.5, 0.0);
  const TaskState state = touched(level, 0.01, Bearing::kByForce);
  assert_true(first_phase(level, state) == CutPhase::kEnters);
  const TaskMemory rests = stopped(remembered(0, state));
  assert_true(rests.state.dug.touched);
  assert_near(rests.state.dug.zero_m, state.dug.zero_m, 0.0);
}

/// The floor is level as it comes down, and it is out of the ground before the bucket turns.
TEST(comes_down_flat_and_leaves_upwards) {
  const TaskProgram level = planned(-0.3);
  TaskState state = task_start(machine().profile, machine().kinematics, level, level.start);
  double lowest_m = 1.0;
  bool up_again = false;
  for (int n = 0; state.dig.phase != CutPhase::kEnters; ++n) {
    assert_true(n < 20000);
    const TaskAim aim = task_aim(machine().kinematics, level, state);
    assert_int_equal(aim.blind.kind, BlindKind::kNone);
    if (state.dig.phase == CutPhase::kTouches) {
      assert_near(aim.teeth.attitude_rad, machine().profile.geometry.body.floor_rad, 1e-6);
      lowest_m = std::min(lowest_m, aim.teeth.position_m.z());
    }
    up_again = up_again || (state.dug.touched && aim.teeth.position_m.z() > 0.8);
    CutSeen seen;
    seen.teeth = aim.teeth;
    seen.teeth.position_m.z() = std::max(seen.teeth.position_m.z(), 0.0);
    dig_advance(machine().profile, machine().kinematics, level, kCycle_s, kCycle_s, seen, state);
  }
  assert_true(lowest_m > -0.03 && lowest_m < 0.0);
  assert_true(up_again);
}
