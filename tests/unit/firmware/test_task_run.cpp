// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/executor.hpp"

#include <limits>

#include "firmware/excavator/motion/program/task_program.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"

using test::kCycle_s;

const test::ReplayMachine& machine() {
  static const test::ReplayMachine loaded(test::excavator_12t());
  return loaded;
}

/// A line and two moves of the drives, back to the beginning.
TaskProgram program(bool repeats) {
  ProgramRequest request;
  request.start = {{7.0, 0.0, -0.4}, 2.2};
  request.step[0] = {StepKind::kDig, {{4.8, 0.0, -0.4}, 0.9}, true, 0.5, 0.0, 1.0};
  request.step[1] = {StepKind::kSwing, {{0.0, 4.6, 3.4}, 0.3}, false, 0.0, 0.0, 1.0};
  request.step[2] = {StepKind::kReturnToDig, request.start, false, 0.0, 6.0, 1.0};
  request.step_count = 3;
  request.repeats = repeats;
  const ProgramResult result = plan_program(machine().profile, request);
  assert_int_equal(result.refusal, ProgramRefusal::kNone);
  return result.program;
}

TaskState advance(const TaskProgram& program, const TaskState& state, double lambda,
                  double error_m = 0.0) {
  return task_advance(machine().profile.line, program, state, lambda * kCycle_s, kCycle_s, error_m);
}

TaskState begun(const TaskProgram& program, const DriveVector& now) {
  return task_start(machine().profile, machine().kinematics, program, now);
}

TaskAim aim_of(const TaskProgram& program, const TaskState& state) {
  return task_aim(machine().kinematics, program, state);
}

TaskState at_first_step() {
  TaskState state;
  state.phase = TaskPhase::kSteps;
  return state;
}

/// At lambda 1 every step takes what its plan says and is then seen to stand, to the cycle in which
/// that ends.
TEST(the_plan_s_times_hold) {
  const TaskProgram task = program(false);
  TaskState state = at_first_step();
  for (int step = 0; step < 3; ++step) {
    int cycles = 0;
    for (; state.phase == TaskPhase::kSteps && state.step == step; ++cycles) {
      state = advance(task, state, 1.0);
      assert_true(cycles < 10000);
    }
    const double took_s = cycles * kCycle_s;
    const double planned_s = task.step[static_cast<unsigned>(step)].duration_s();
    assert_true(took_s >= planned_s - 1e-9 && took_s < planned_s + kCalm_s + kCycle_s + 1e-9);
  }
  assert_int_equal(state.phase, TaskPhase::kDone);
  const TaskAim aim = aim_of(task, state);
  assert_int_equal(aim.kind, StepKind::kDone);
  assert_true(aim.velocity.isZero(0.0));
  assert_true((aim.value - task.end).norm() < 1e-12);
  assert_near(aim.share, 1.0, 0.0);
  assert_int_equal(advance(task, state, 1.0).phase, TaskPhase::kDone);
}

/// Whatever lambda does, the poses are those of the plan, and the velocity is along them.
TEST(lambda_leaves_the_path) {
  const TaskProgram task = program(false);
  plant::Random random(7, plant::Draw::kStart);
  TaskState state = at_first_step();
  double lambda = 1.0;
  int cycles = 0;
  for (; state.phase == TaskPhase::kSteps; ++cycles) {
    assert_true(cycles < 100000);
    const TaskStep& step = task.step[static_cast<unsigned>(state.step)];
    const TaskAim aim = aim_of(task, state);
    assert_int_equal(aim.blind.kind, BlindKind::kNone);
    assert_int_equal(aim.kind, step.kind);
    const DriveMotion planned = step_motion(machine().kinematics, step, aim.share);
    assert_true((aim.value - planned.value).norm() < 1e-12);
    assert_true((machine().teeth(aim.value).position_m - aim.teeth.position_m).norm() < 1e-9);
    const double rate_ps = aim.velocity.dot(planned.rate) / planned.rate.squaredNorm();
    assert_true(rate_ps >= 0.0);
    assert_true((aim.velocity - rate_ps * planned.rate).norm() < 1e-12);
    lambda = random.uniform() < 0.05 ? random.uniform() : lambda;
    state = advance(task, state, random.uniform() < 0.1 ? 0.0 : lambda);
  }
  assert_true(cycles * kCycle_s > 1.2 * (task.step[0].duration_s() + task.step[1].duration_s()));
}

/// The velocity is the value's, by the plan's time.
TEST(velocity_is_the_value_s_difference) {
  constexpr double kStep_s = 1e-5;
  const TaskProgram task = program(false);
  for (int step = 0; step < 3; ++step) {
    TaskState state = at_first_step();
    state.step = step;
    for (state.time_s = 0.1; state.time_s < 3.0; state.time_s += 0.3) {
      TaskState later = state;
      later.time_s += kStep_s;
      TaskState before = state;
      before.time_s -= kStep_s;
      const DriveVector velocity =
          (aim_of(task, later).value - aim_of(task, before).value) / (2.0 * kStep_s);
      assert_true((velocity - aim_of(task, state).velocity).norm() < 1e-6);
    }
  }
}

TEST(an_error_asks_for_less_pace_and_nan_for_none) {
  const TaskProgram task = program(false);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const LineProfile& line = machine().profile.line;
  TaskState state = at_first_step();
  // The first step is a line, at uniform speed there.
  const LinePlan& plan = task.step[0].line;
  const double speed_mps = plan.way_m * plan.ramp.at(3.0).rate_ps;
  assert_true(speed_mps > 0.4 && speed_mps <= 0.5 + 1e-9);
  const double half_m = line.slow_error_m + speed_mps * line.slow_error_s;
  state.time_s = 3.0;
  assert_near(wanted_pace(line, task, state, 0.0), 1.0, 0.0);
  assert_near(wanted_pace(line, task, state, half_m), 0.5, 1e-12);
  assert_near(wanted_pace(line, task, state, 2.0 * half_m), 0.2, 1e-12);
  assert_near(wanted_pace(line, task, state, nan), 0.0, 0.0);
  // From rest, where a drive may stick, it waits sooner.
  state.time_s = 0.0;
  assert_near(wanted_pace(line, task, state, line.slow_error_m), 0.5, 1e-12);
  // Drives that are only moved have to arrive, no more: steps without a line, and the approach.
  state.step = 1;
  assert_near(wanted_pace(line, task, state, line.move_slow_error_m), 0.5, 1e-12);
  const TaskState approach = begun(task, task.end);
  assert_near(wanted_pace(line, task, approach, line.move_slow_error_m), 0.5, 1e-12);
}

/// It goes on by its pace times what it may, and the pace changes no faster than its rate.
TEST(the_pace_changes_at_its_rate) {
  const TaskProgram task = program(false);
  const LineProfile& line = machine().profile.line;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double change = line.pace_rate_ps * kCycle_s;
  TaskState state = at_first_step();
  state.time_s = 1.0;
  assert_near(state.pace_ratio, 1.0, 0.0);
  TaskState next = advance(task, state, 0.5, 1e3);
  assert_near(next.time_s, 1.0 + 0.5 * kCycle_s, 1e-12);
  assert_near(next.pace_ratio, 1.0 - change, 1e-12);
  next = advance(task, next, 1.0, 1e3);
  assert_near(next.time_s, 1.0 + (1.5 - change) * kCycle_s, 1e-12);
  state.pace_ratio = 0.5;
  next = advance(task, state, 1.0);
  assert_near(next.time_s, 1.0 + 0.5 * kCycle_s, 1e-12);
  assert_near(next.pace_ratio, 0.5 + change, 1e-12);
  // What is near is reached, no more.
  state.pace_ratio = 1.0 - 0.1 * change;
  assert_near(advance(task, state, 1.0).pace_ratio, 1.0, 0.0);
  state.pace_ratio = 0.1 * change;
  assert_near(advance(task, state, 1.0, nan).pace_ratio, 0.0, 0.0);
  state.pace_ratio = 1.0;
  assert_near(advance(task, state, 0.0).time_s, 1.0, 0.0);
  assert_near(advance(task, state, -1.0).time_s, 1.0, 0.0);
  assert_near(advance(task, state, nan).time_s, 1.0, 0.0);
  state.pace_ratio = nan;
  assert_near(advance(task, state, 1.0).time_s, 1.0, 0.0);
}

/// How a step is left that has come to its end with the error that `error_m(cycle)` says. It takes
/// a cycle more where the sum of periods rounds to just below.
template <class Error>
void assert_left(Error&& error_m, int cycles, int missed) {
  const TaskProgram task = program(false);
  TaskState state = at_first_step();
  state.time_s = task.step[0].duration_s() - 0.5 * kCycle_s;
  int cycle = 0;
  for (; state.step == 0 && cycle < 2000; ++cycle) {
    assert_true(aim_of(task, state).share > 0.999);
    state = advance(task, state, 1.0, error_m(cycle));
  }
  assert_int_equal(state.step, 1);
  assert_near(state.settle_s, 0.0, 0.0);
  assert_near(state.calm_s, 0.0, 0.0);
  assert_near(state.time_s, 0.0, 0.0);
  assert_in_range(cycle, cycles, cycles + 1);
  assert_int_equal(state.missed, missed);
}

int cycles_of(double time_s) { return static_cast<int>(std::lround(time_s / kCycle_s)); }

/// At the end it waits for the teeth to stand there; what has been near for long goes on, and is
/// counted.
TEST(a_step_ends_when_it_has_arrived) {
  const int calm = cycles_of(kCalm_s);
  const int most = cycles_of(kArriveMost_s);
  assert_left([](int) { return 0.9 * kSettled_m; }, calm, 0);
  assert_left([](int) { return 1.1 * kSettled_m; }, most, 1);
  // What swings through its place is not there yet: the count begins anew.
  assert_left([calm](int cycle) { return (cycle == calm - 2 ? 1.1 : 0.9) * kSettled_m; },
              2 * calm - 1, 0);
  assert_left([](int cycle) { return (cycle % 9 == 0 ? 1.1 : 0.9) * kSettled_m; }, most, 1);
  // One that arrives in time is not missed.
  assert_left([](int cycle) { return (cycle < 800 ? 4.0 : 0.9) * kSettled_m; }, 800 + calm, 0);
}

/// The next step may rely on the last one: far from its end, or nobody knows where, none goes on.
TEST(what_is_astray_does_not_go_on) {
  const TaskProgram task = program(false);
  for (const double error_m : {1.1 * kMissedMost_m, std::numeric_limits<double>::quiet_NaN()}) {
    for (const int step : {0, 1}) {
      TaskState state = at_first_step();
      state.step = step;
      state.time_s = task.step[static_cast<unsigned>(step)].duration_s();
      assert_false(is_astray(state, error_m));
      for (int cycle = 0; cycle < cycles_of(3.0 * kArriveMost_s); ++cycle) {
        state = advance(task, state, 1.0, error_m);
        assert_true(is_astray(state, error_m));
      }
      assert_int_equal(state.step, step);
      assert_int_equal(state.missed, 0);
      assert_false(is_astray(state, 0.9 * kMissedMost_m));
      // Once it is near it goes on, late as it is.
      state = advance(task, state, 1.0, 0.9 * kMissedMost_m);
      assert_int_equal(state.step, step + 1);
      assert_int_equal(state.missed, 1);
    }
  }
  assert_false(is_astray(TaskState{}, 1.0));
  TaskState many = at_first_step();
  many.missed = kMissedCount;
  many.time_s = task.step[0].duration_s();
  many.settle_s = kArriveMost_s;
  assert_int_equal(advance(task, many, 1.0, kMissedMost_m).missed, kMissedCount);
}

/// A line ends to the millimetres, and so does what leads to one; a move between moves need not.
TEST(how_near_depends_on_what_follows) {
  const TaskProgram once = program(false);
  const TaskProgram again = program(true);
  TaskState state = at_first_step();
  assert_near(arrival_m(once, state), kSettled_m, 0.0);
  state.step = 1;
  assert_near(arrival_m(once, state), kMoveArrived_m, 0.0);
  state.step = 2;
  assert_near(arrival_m(once, state), kMoveArrived_m, 0.0);
  assert_near(arrival_m(again, state), kLineBegins_m, 0.0);
  assert_near(arrival_m(once, begun(once, once.end)), kLineBegins_m, 0.0);
  state.step = 1;
  state.time_s = once.step[1].duration_s();
  for (int cycle = 0; cycle <= cycles_of(kCalm_s); ++cycle) {
    state = advance(once, state, 1.0, 0.9 * kMoveArrived_m);
  }
  assert_int_equal(state.step, 2);
  assert_int_equal(state.missed, 0);
}

TEST(it_begins_again_if_it_repeats) {
  const TaskProgram task = program(true);
  TaskState state = at_first_step();
  state.step = 2;
  state.time_s = task.step[2].duration_s();
  state.calm_s = kCalm_s;
  state = advance(task, state, 1.0);
  assert_int_equal(state.phase, TaskPhase::kSteps);
  assert_int_equal(state.step, 0);
  assert_near(state.time_s, 0.0, 0.0);
}

/// From anywhere in the box, or a little outside of it, straight in drive space at its own pace.
TEST(the_approach_leads_to_the_start) {
  const TaskProgram task = program(false);
  DriveVector now = task.start;
  now[kSwing] = 2.5;
  // Quick enough to reach its uniform speed on the way.
  ExcavatorProfile quick = machine().profile;
  quick.swing.acceleration_max_radps2 = 0.7;
  TaskState state = task_start(quick, machine().kinematics, task, now);
  assert_int_equal(state.phase, TaskPhase::kApproach);
  const TaskAim first = aim_of(task, state);
  assert_int_equal(first.kind, StepKind::kApproach);
  assert_near(first.value[kSwing], 2.5, 0.0);
  assert_near(first.share, 0.0, 0.0);
  double fastest = 0.0;
  int cycles = 0;
  for (; state.phase == TaskPhase::kApproach && cycles < 10000; ++cycles) {
    const TaskAim aim = aim_of(task, state);
    assert_int_equal(aim.blind.kind, BlindKind::kNone);
    fastest = std::max(fastest, std::abs(aim.velocity[kSwing]));
    state = advance(task, state, 1.0);
  }
  assert_near(fastest, kApproachPace * 1.435, 1e-6);
  assert_int_equal(state.phase, TaskPhase::kSteps);
  assert_int_equal(state.step, 0);
  assert_true((aim_of(task, state).value - task.start).norm() < 1e-9);
  DriveVector outside = now;
  outside[kBoom] = -0.001;
  outside[kArm] = 1.131;
  const DriveVector taken_in = aim_of(task, begun(task, outside)).value;
  assert_near(taken_in[kBoom], 0.0, 0.0);
  assert_near(taken_in[kArm], 1.130, 0.0);
  // Where it stands already nothing is waited for.
  TaskState there = begun(task, task.start);
  assert_near(aim_of(task, there).share, 1.0, 0.0);
  there = advance(task, there, 1.0);
  assert_int_equal(there.phase, TaskPhase::kApproach);
  assert_int_equal(there.step, 1);
  there.calm_s = kCalm_s;
  assert_int_equal(advance(task, there, 1.0).phase, TaskPhase::kSteps);
}

TEST(no_program_is_done) {
  const TaskProgram none;
  TaskState state = at_first_step();
  state.calm_s = kCalm_s;
  assert_int_equal(advance(none, state, 1.0).phase, TaskPhase::kDone);
  assert_int_equal(TaskState{}.phase, TaskPhase::kDone);
}
