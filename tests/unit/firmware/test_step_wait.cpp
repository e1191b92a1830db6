// SPDX-License-Identifier: Apache-2.0
/// Waits for the operator's word.

#include "firmware/excavator/motion/dig/step_round.hpp"
#include "firmware/excavator/motion/program/task_follow.hpp"
#include "tests/unit/firmware/step_task.hpp"

using namespace graben::test;

ProgramRequest with_wait() {
  ProgramRequest request = dig_and_lift();
  request.step[3] = request.step[2];
  request.step[2] = {};
  request.step[2].kind = StepKind::kWait;
  request.step[2].straight = false;
  request.step_count = 4;
  return request;
}

/// It stands at the end of the step before until the task is asked for anew, and goes on from
/// there; from elsewhere, or as another task, it begins anew.
TEST(a_wait_ends_by_the_operator_s_word) {
  Exact run(with_wait());
  run.run_step();
  run.run_step();
  assert_int_equal(run.state.step, 2);
  const DriveVector stood = aim_of(run.program, run.state).value;
  for (int n = 0; n < 3000; ++n) {
    run.step();
    assert_int_equal(run.state.step, 2);
    assert_int_equal(aim_of(run.program, run.state).kind, StepKind::kWait);
    assert_true((aim_of(run.program, run.state).value - stood).norm() < 1e-9);
  }
  assert_true(run.state.waits && !run.state.word);
  assert_int_equal(run.state.missed, 0);
  const TaskMemory let_go = stopped(stopped(remembered(2, run.state)));
  assert_false(let_go.runs);
  const auto asked = [&](std::uint8_t number, const DriveVector& drives) {
    TaskMemory memory = let_go;
    next_task(profile(), steps_machine().kinematics, run.program, number,
              travel_of(profile(), drives), 1.0, {}, kCycle_s, memory);
    return memory;
  };
  TaskMemory goes_on = asked(2, stood);
  assert_true(goes_on.runs && goes_on.state.phase == TaskPhase::kSteps);
  run.state = goes_on.state;
  run.run_step();
  assert_int_equal(run.state.step, 3);
  assert_false(run.state.word || run.state.waits);
  run.run_step();
  assert_int_equal(run.state.step, 0);
  assert_int_equal(asked(1, stood).state.phase, TaskPhase::kApproach);
  DriveVector moved = stood;
  moved[kSwing] += 0.1;
  TaskMemory elsewhere = asked(2, moved);
  assert_int_equal(elsewhere.state.phase, TaskPhase::kApproach);
  assert_false(elsewhere.state.word || elsewhere.state.waits);
}

/// Not before it has arrived is a wait one: a task that stops before that begins anew.
TEST(on_its_way_to_a_wait_there_is_no_word) {
  Exact run(with_wait());
  run.run_step();
  run.run_step();
  run.step();
  assert_int_equal(run.state.step, 2);
  assert_false(stopped(remembered(0, run.state)).state.word);
}

/// A wait stands on a pose that rounds move as well.
TEST(a_wait_in_the_ground_moves_with_it) {
  ProgramRequest request = in_rounds(2);
  request.step[3] = request.step[2];
  request.step[2] = request.step[1];
  request.step[1] = {};
  request.step[1].kind = StepKind::kWait;
  request.step[1].straight = false;
  request.step_count = 4;
  const TaskProgram program = planned(request);
  assert_true(program.step[1].from_moves && program.step[1].to_moves && program.step[2].from_moves);
  const RoundStep wait = step_in_round(profile(), steps_machine().kinematics, program, 1, 1, 1);
  const TeethPose teeth = steps_machine().teeth(wait.step.drives.from);
  assert_near(teeth.position_m.z(), kTop_m - 0.1, 1e-9);
  assert_near(teeth.position_m.x(), 4.8, 1e-9);
}
