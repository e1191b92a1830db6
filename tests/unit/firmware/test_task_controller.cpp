// SPDX-License-Identifier: Apache-2.0
// The excavator's step, from end to end, with a program to follow.

#include <Eigen/Geometry>
#include <utility>

#include "tests/unit/firmware/flip_bit.hpp"
#include "tests/unit/firmware/task_machine.hpp"

using test::TaskMachine;
using Memory = ControllerMemoryAccess;

const TaskProgram& dig() {
  static const TaskProgram program = test::program_of(test::level_dig());
  return program;
}

const test::ReplayMachine& machine() {
  static const test::ReplayMachine loaded(test::excavator_12t());
  return loaded;
}

/// Beside the beginning, with the platform turned.
DriveVector beside() {
  DriveVector drives = dig().start;
  drives[kBoom] += 0.05;
  drives[kSwing] = -0.3;
  return drives;
}

void assert_closed(const ExcavatorOutputs& outputs) {
  for (const double duty : outputs.duty_ratio) {
    assert_near(duty, 0.0, 0.0);
  }
}

void assert_neutral(const ExcavatorOutputs& outputs) {
  assert_false(outputs.enable);
  assert_closed(outputs);
}

bool steps_on(const TaskProgress& at) { return at.kind == StepKind::kDig && at.share > 0.3; }

/// On its first line, at uniform speed.
TaskMachine on_the_line(const TaskBook& book = test::book_of({dig()})) {
  TaskMachine running(book, dig().start);
  running.run_until(steps_on);
  return running;
}

double off_line_m(const DriveVector& drives) {
  const TeethLine& line = dig().step[0].line.line;
  const Eigen::Vector3d off_m = machine().teeth(drives).position_m - line.from.position_m;
  return off_m.cross(line.change.position_m.normalized()).norm();
}

/// Each part after the other, its share from 0 to 1, the teeth on the line all along; then it
/// stands at its end and says so.
TEST(a_program_runs_to_its_end) {
  TaskMachine running(test::book_of({dig()}), beside());
  const std::pair<StepKind, int> parts[] = {{StepKind::kApproach, 0},
                                            {StepKind::kDig, 0},
                                            {StepKind::kSwing, 1},
                                            {StepKind::kReturnToDig, 2}};
  running.run(1);
  assert_false(running.outputs.status.progress.runs);
  running.run(1);
  for (const auto& part : parts) {
    const StepKind kind = part.first;
    const int step = part.second;
    double share = 0.0;
    double fastest_radps = 0.0;
    running.run_until([&](const TaskProgress& at) {
      if (at.kind != kind) {
        return true;
      }
      // The approach has two parts: to above the start, and down.
      assert_true(at.runs && (kind == StepKind::kApproach || at.share >= share));
      assert_true(at.share <= 1.0);
      assert_int_equal(at.number, 0);
      assert_int_equal(at.step, step);
      share = at.share;
      if (kind == StepKind::kDig) {
        assert_true(off_line_m(running.drives.value()) < 3e-3);
        assert_near(running.outputs.status.path_error_m, off_line_m(running.drives.value()), 3e-3);
      }
      const ExcavatorStatus& status = running.outputs.status;
      fastest_radps = std::max(fastest_radps, std::abs(status.swing_wanted_radps));
      assert_near(status.swing_wanted_radps * running.profile.swing.lever_m,
                  status.wanted_velocity_mps[kSwing], 1e-12);
      return false;
    });
    assert_near(share, 1.0, 1e-9);
    assert_true((fastest_radps > 0.02) == (kind != StepKind::kDig));
  }
  assert_int_equal(running.outputs.status.progress.kind, StepKind::kDone);
  running.run(100);
  assert_int_equal(running.outputs.status.progress.kind, StepKind::kDone);
  assert_near(running.outputs.status.progress.share, 1.0, 0.0);
  assert_true(
      (machine().teeth(running.drives.value()).position_m - machine().teeth(dig().end).position_m)
          .norm() < 2e-3);
  assert_closed(running.outputs);
}

TEST(an_unknown_number_is_refused) {
  TaskMachine resting(test::book_of({dig()}), beside());
  resting.driver.task_number.value = 1;
  assert_neutral(resting.step());
  assert_int_not_equal(resting.outputs.status.mode, EcuMode::kActive);
  assert_true(resting.outputs.status.faults.has(Fault::kTaskUnknown));
  assert_false(resting.outputs.status.progress.runs);
  TaskMachine running = on_the_line();
  running.driver.task_number.value = 7;
  assert_neutral(running.step());
  assert_int_equal(running.outputs.status.mode, EcuMode::kFault);
  assert_int_equal(running.outputs.status.fault, Fault::kTaskUnknown);
  // One that has fences alone, for the levers, has no steps to be done.
  TaskBook book = test::book_of({dig()});
  book.program[0].step_count = 0;
  TaskMachine without_steps(book, beside());
  assert_neutral(without_steps.step());
  assert_true(without_steps.outputs.status.faults.has(Fault::kTaskUnknown));
  // A number that is not there is none of ours either.
  TaskMachine mute = on_the_line();
  ExcavatorInputs inputs = mute.inputs();
  inputs.driver.task_number.validity = Validity::kNotAvailable;
  assert_neutral(mute.step(inputs));
  assert_int_equal(mute.outputs.status.fault, Fault::kTaskUnknown);
}

TEST(one_with_drives_that_were_not_commissioned_is_refused_or_slow) {
  ExcavatorProfile part = test::answering_12t();
  part.safety.unknown.programs = 1;
  TaskMachine refused(test::book_of({dig(), dig()}), beside(), part);
  assert_neutral(refused.step());
  assert_true(refused.outputs.status.faults.has(Fault::kTaskUnknown));
  TaskMachine other(test::book_of({dig(), dig()}), beside(), part);
  other.driver.task_number.value = 1;
  other.run(2);
  part.safety.unknown.speed_ratio = 0.5;
  TaskMachine slow(test::book_of({dig()}), dig().start, part);
  TaskMachine told(test::book_of({dig()}), dig().start);
  told.driver.speed_override_ratio.value = 0.5;
  slow.run(300);
  told.run(300);
  const auto& progress = slow.outputs.status.progress;
  assert_int_equal(progress.kind, told.outputs.status.progress.kind);
  assert_true(progress.kind != StepKind::kApproach && progress.share > 0.01);
  assert_near(progress.share, told.outputs.status.progress.share, 1e-12);
}

void assert_starts_afresh(TaskMachine& running, int number) {
  running.run(2);
  assert_int_equal(running.outputs.status.progress.kind, StepKind::kApproach);
  assert_int_equal(running.outputs.status.progress.number, number);
  assert_true(running.outputs.status.progress.share < 1e-3);
}

/// Back to no task it stands; asked again it comes from where it is then.
TEST(a_task_withdrawn_is_forgotten) {
  TaskMachine running = on_the_line();
  running.driver.task.value = Task::kNone;
  running.step();
  assert_false(running.outputs.status.progress.runs);
  for (int n = 0; n < 100; ++n) {
    running.step();
    assert_int_equal(running.outputs.status.mode, EcuMode::kArmed);
  }
  const DriveVector stood = running.drives.value();
  repeat(50, [&] { running.step(); });
  assert_true((running.drives.value() - stood).norm() < 1e-9);
  running.driver.task.value = Task::kProgram;
  assert_starts_afresh(running, 0);
  running.run_until(steps_on);
}

TEST(another_number_starts_afresh) {
  TaskMachine running = on_the_line(test::book_of({dig(), dig()}));
  running.driver.task_number.value = 1;
  // It comes to rest in between.
  int armed = 0;
  for (running.step(); running.outputs.status.mode == EcuMode::kArmed; running.step()) {
    assert_false(running.outputs.status.progress.runs);
    assert_true(++armed < 300);
  }
  assert_true(armed >= 20);
  assert_starts_afresh(running, 1);
  running.run_until(steps_on);
  assert_int_equal(running.outputs.status.progress.number, 1);
}

/// A line beside the machine, behind a wall that the stretched arm does not pass.
TaskProgram behind_a_wall(double wall_m) {
  ProgramRequest request;
  request.start = {{2.0, 5.5, 0.5}, 2.0};
  request.step[0] = {StepKind::kDig, {{1.0, 5.5, 0.5}, 1.8}, true, 0.3, 0.0, 1.0};
  request.step_count = 1;
  request.fences.count = 2;
  request.fences.fence[0] = {Eigen::Vector3d::UnitZ(), 9.0, FenceGuard::kMachine};
  request.fences.fence[1] = {Eigen::Vector3d::UnitX(), wall_m, FenceGuard::kMachine};
  return test::program_of(request);
}

/// The direct way would pass the wall: with arm and bucket folded in it gets there.
TEST(it_goes_round_a_fence_on_its_way) {
  const TaskProgram program = behind_a_wall(4.0);
  DriveVector start = program.start;
  start[kSwing] = -1.2;
  TaskMachine running(test::book_of({program}), start);
  double most_m = -1e3;
  for (int n = 0; n < 6000 && running.outputs.status.progress.kind != StepKind::kDone; ++n) {
    running.run(1);
    most_m = std::max(most_m, test::overrun_m(machine(), program.fences, running.drives.value()));
  }
  assert_int_equal(running.outputs.status.progress.kind, StepKind::kDone);
  assert_true(most_m < 1e-3);
}

/// Neither folded nor over it.
TEST(where_no_way_is_left_it_does_not_start) {
  const TaskProgram program = behind_a_wall(2.1);
  DriveVector start = program.start;
  start[kSwing] = -1.2;
  TaskMachine running(test::book_of({program}), start);
  int cycles = 0;
  while (running.outputs.status.mode != EcuMode::kFault) {
    running.step();
    assert_true(++cycles < 2000);
    assert_true((running.drives.value() - start).norm() < 1e-6);
  }
  assert_int_equal(running.outputs.status.fault, Fault::kNoWay);
  assert_neutral(running.outputs);
}

/// A program of a machine that turns further.
TEST(it_stands_before_the_end_of_the_swing) {
  ExcavatorProfile narrow = test::answering_12t();
  narrow.swing.left_end_rad = 1.0;
  TaskMachine running(test::book_of({dig()}), dig().start, narrow);
  running.run(2500);
  const ExcavatorStatus& status = running.outputs.status;
  assert_int_equal(status.progress.kind, StepKind::kSwing);
  assert_int_equal(status.limit.kind, LimitKind::kSwingEnd);
  assert_int_equal(status.fault, Fault::kStalling);  // Said, and nothing else.
  assert_true(running.drives.value()[kSwing] > 0.99 && running.drives.value()[kSwing] < 1.0002);
}

/// A bit of what says where on its plan it is: neutral in this cycle.
TEST(a_flipped_bit_of_the_place_stops) {
  TaskMachine running = on_the_line();
  test::flip_bit(Memory::memory(running.controller)->motion.task.state.time_s, 51);
  assert_neutral(running.step());
  assert_int_equal(running.outputs.status.mode, EcuMode::kFault);
  assert_int_equal(running.outputs.status.fault, Fault::kMemoryCorrupt);
}

TEST(at_override_0_it_waits) {
  TaskMachine running = on_the_line();
  running.driver.speed_override_ratio.value = 0.0;
  running.run(100);
  const double share = running.outputs.status.progress.share;
  const DriveVector stood = running.drives.value();
  running.run(200);
  assert_near(running.outputs.status.progress.share, share, 0.0);
  assert_true((running.drives.value() - stood).norm() < 2e-3);
  // Nothing is corrected either: no spool opens, whatever a drive owes.
  assert_closed(running.outputs);
  running.driver.speed_override_ratio.value = 1.0;
  running.run_until([](const TaskProgress& at) { return at.kind == StepKind::kSwing; });
}

/// Share of the line that one second makes.
double share_of_a_second(TaskMachine& running) {
  const double before = running.outputs.status.progress.share;
  running.run(100);
  return running.outputs.status.progress.share - before;
}

TEST(half_the_override_is_half_the_speed) {
  TaskMachine whole = on_the_line();
  TaskMachine half = whole;
  half.driver.speed_override_ratio.value = 0.5;
  assert_near(share_of_a_second(half) / share_of_a_second(whole), 0.5, 0.06);
  assert_true(off_line_m(half.drives.value()) < 3e-3);
}

TEST(a_lost_pressure_slows_it) {
  TaskMachine whole = on_the_line();
  TaskMachine slowed = whole;
  const double before = slowed.outputs.status.progress.share;
  for (int n = 0; n < 100; ++n) {
    ExcavatorInputs inputs = slowed.inputs();
    inputs.axis[kArm].cap_pressure_pa.validity = Validity::kError;
    slowed.step(inputs);
    assert_int_equal(slowed.outputs.status.mode, EcuMode::kActive);
  }
  assert_int_equal(slowed.outputs.status.fault, Fault::kPressureMissing);
  const double made = slowed.outputs.status.progress.share - before;
  assert_near(made / share_of_a_second(whole), slowed.profile.safety.degraded_speed_ratio, 0.1);
}
