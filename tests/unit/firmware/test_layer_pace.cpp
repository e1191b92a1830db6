// SPDX-License-Identifier: Apache-2.0
/// How fast cuts go on, and what follows on them.

#include "firmware/excavator/motion/dig/dig_run.hpp"

#include "tests/unit/firmware/layer_machine.hpp"

using namespace graben::layer_test;

/// The same lateness slows a cut the less, the farther over the design it is.
TEST(far_over_its_design_teeth_may_be_late) {
  const TaskProgram program = planned();
  const auto pace_of = [&](bool thin) {
    TaskState state = run_until(program, begun(program), [thin](const TaskState& at) {
      return in_cut(at) && at.dug.cuts.cut.thin == thin && at.dig.share > 0.5;
    });
    state = advance_seeing(program, state, 100, [](CutSeen& seen) { seen.behind_m = 0.03; });
    assert_true(in_cut(state));
    return state.pace_ratio;
  };
  assert_true(pace_of(false) > pace_of(true) + 0.1);
}

/// A step that lifts takes the bucket out of a cut that is through.
TEST(a_lift_follows_a_cut_at_once) {
  ProgramRequest with_lift = request();
  with_lift.step[3] = with_lift.step[2];
  with_lift.step[2] = with_lift.step[1];
  with_lift.step[1] = {StepKind::kLift, {{4.4, 0.0, 2.3}, 0.3}, false, 0.0, 0.0, 0.7};
  with_lift.step_count = 4;
  const ProgramResult result = plan_program(machine().profile, with_lift);
  assert_int_equal(result.refusal, ProgramRefusal::kNone);
  const TaskProgram& program = result.program;
  TaskState state = run_until(program, begun(program), in_cut);
  state.dug.cuts.cut.height_m = 0.3;  // so high that the bucket is not full on the way
  state = run_until(program, state,
                    [](const TaskState& at) { return at.dig.phase == CutPhase::kLifts; });
  assert_near(state.dig.share, 1.0, 0.0);
  state = run_until(program, state, [](const TaskState& at) {
    assert_true(at.step == 1 || at.dig.folds);
    return at.step == 1;
  });
}
