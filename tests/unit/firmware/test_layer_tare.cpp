// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/dig_phases.hpp"

#include <vector>

#include "firmware/excavator/motion/dig/tuning.hpp"
#include "tests/unit/firmware/layer_machine.hpp"

using namespace graben::layer_test;

CutSeen weighs(const TaskProgram& program, const TaskState& state) {
  CutSeen seen = follows(program, state);
  seen.payload_known = true;
  seen.payload_kg = 600.0;
  return seen;
}

/// A bucket that was weighed is raised and reached out once, empty, before it first goes back.
TEST(an_empty_bucket_is_moved_once) {
  const TaskProgram program = planned();
  TaskState state = begun(program);
  std::vector<DriveVector> ways;
  for (int rounds = 0; rounds < 3 && state.phase != TaskPhase::kDone;) {
    const TaskState next = advance(program, state, weighs(program, state));
    if (next.dig.tares != state.dig.tares && next.dig.tares != TarePart::kNone) {
      assert_int_equal(program.step[static_cast<unsigned>(next.step)].kind, StepKind::kReturnToDig);
      ways.push_back(next.dig.move.change);
    }
    rounds += next.step == 0 && state.step != 0 ? 1 : 0;
    state = next;
  }
  assert_int_equal(ways.size(), 2);
  assert_true(ways[0][kBoom] > 0.02 && ways[0][kArm] > 0.02);
  assert_near(ways[1][kBoom], 0.0, 0.0);
  assert_true(ways[1][kArm] < -0.02);
  for (const DriveVector& way : ways) {
    assert_near(way[kBucket], 0.0, 0.0);
    assert_near(way[kSwing], 0.0, 0.0);
  }
}

/// Drives that hardly get on are not waited for: the return begins from where they are.
TEST(a_tare_that_gets_stuck_ends) {
  const TaskProgram program = planned();
  TaskState state = begun(program);
  while (state.dig.tares == TarePart::kNone) {
    state = advance(program, state, weighs(program, state));
  }
  double waited_s = 0.0;
  double boom_m = 0.0;
  for (; state.dig.tares != TarePart::kNone && waited_s < 20.0; waited_s += kCycle_s) {
    boom_m = task_aim(machine().kinematics, program, state).value[kBoom];
    dig_advance(machine().profile, machine().kinematics, program, 0.05 * kCycle_s, kCycle_s,
                follows(program, state), state);
  }
  assert_true(waited_s < 2.0 * kTaresMost_s + 0.5);
  assert_int_equal(state.step, 2);
  assert_near(state.dig.move.from[kBoom], boom_m, 1e-3);
}

/// Who weighs nothing has nothing to learn it for.
TEST(without_a_payload_there_is_none) {
  const TaskProgram program = planned();
  run_until(program, begun(program), [](const TaskState& at) {
    assert_true(at.dig.tares == TarePart::kNone);
    return at.phase == TaskPhase::kDone;
  });
}
