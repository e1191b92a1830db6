// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/task_follow.hpp"

#include <limits>

#include "firmware/excavator/swing.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/task_machine.hpp"

using test::kCycle_s;
using test::servo_at_rest;
using test::set;

const ExcavatorProfile& profile() {
  static const ExcavatorProfile answering = test::answering_12t();
  return answering;
}

const TaskProgram& dig() {
  static const TaskProgram program = test::program_of(test::level_dig());
  return program;
}

const SwingKinematics& kinematics() {
  static const SwingKinematics loaded(profile().geometry);
  return loaded;
}

DriveRows rows() {
  static const ExcavatorBank bank = excavator_bank(profile());
  return bank.rows();
}

/// Half way on the first line, or on the move after it.
TaskMemory half_way(int step) {
  TaskState state;
  state.phase = TaskPhase::kSteps;
  state.step = step;
  state.time_s = 0.5 * dig().step[static_cast<unsigned>(step)].duration_s();
  return remembered(0, state);
}

TaskAim aim_of(const TaskMemory& memory) { return task_aim(kinematics(), dig(), memory.state); }

TaskWant want(const TaskMemory& memory, const ExcavatorServo& servo, double override_ratio = 1.0) {
  return want_of_task(profile(), rows(), kinematics(), dig(), memory, aim_of(memory), servo,
                      override_ratio);
}

/// Drives where the teeth are so far off their place.
DriveVector drives_off(const TaskMemory& memory, const Eigen::Vector3d& off_m) {
  TeethPose teeth = aim_of(memory).teeth;
  teeth.position_m += off_m;
  const DriveResult drives = kinematics().drive_from_teeth(teeth);
  assert_int_equal(drives.blind.kind, BlindKind::kNone);
  return drives.value;
}

TEST(the_swing_s_travel_is_at_its_lever) {
  const DriveVector drives(0.4, 0.5, 0.3, -1.2);
  const DriveVector travel_m = travel_of(profile(), drives);
  assert_true(travel_m.head<3>() == drives.head<3>());
  assert_near(travel_m[kSwing], -1.2 * profile().swing.lever_m, 1e-15);
  assert_true((drives_of(profile(), travel_m) - drives).norm() < 1e-15);
  // A swing that is held has none, either way.
  const ExcavatorProfile& held = test::excavator().profile;
  assert_near(travel_of(held, drives)[kSwing], 0.0, 0.0);
  assert_near(drives_of(held, drives)[kSwing], 0.0, 0.0);
}

/// On its place nothing is off; what is wanted is the plan's velocity by override and pace.
TEST(where_it_should_be_it_goes_on) {
  TaskMemory memory = half_way(0);
  const ExcavatorServo servo = servo_at_rest(travel_of(profile(), aim_of(memory).value));
  const TaskWant whole = want(memory, servo);
  assert_true(whole.runs && whole.known && whole.holds);
  assert_near(whole.error_m, 0.0, 1e-9);
  assert_near(whole.path_error_m, 0.0, 1e-9);
  assert_near(whole.pace_ratio, 1.0, 0.0);
  assert_true((whole.planned_m - travel_of(profile(), aim_of(memory).value)).norm() < 1e-15);
  assert_true((whole.wanted_mps - travel_of(profile(), aim_of(memory).velocity)).norm() < 1e-15);
  assert_true(whole.wanted_mps.norm() > 0.05);
  memory.state.pace_ratio = 0.5;
  const TaskWant slow = want(memory, servo, 0.4);
  assert_near(slow.pace_ratio, 0.5, 0.0);
  assert_true((slow.wanted_mps - 0.2 * whole.wanted_mps).norm() < 1e-15);
  assert_true(slow.progress.runs);
  assert_int_equal(slow.progress.number, 0);
  assert_int_equal(slow.progress.kind, StepKind::kDig);
  assert_near(slow.progress.share, 0.5, 1e-9);
  assert_int_equal(want(half_way(1), servo).progress.step, 1);
}

/// A step that stands at its end too far from it does not go on, which the stall watch is told;
/// what was missed is told on.
TEST(far_from_its_end_it_is_astray) {
  for (const int step : {0, 1}) {
    TaskMemory memory = half_way(step);
    memory.state.time_s = dig().step[static_cast<unsigned>(step)].duration_s();
    const auto stands = [&](double off_m) {
      const DriveVector off = drives_off(memory, {0.0, 0.0, off_m});
      return want(memory, servo_at_rest(travel_of(profile(), off)));
    };
    assert_false(stands(1.1 * kMissedMost_m).astray);
    assert_false(stands(0.0).bides);
    memory.state.settle_s = kCycle_s;
    assert_true(stands(1.1 * kMissedMost_m).astray);
    assert_false(stands(1.1 * kMissedMost_m).bides);
    assert_false(stands(0.9 * kMissedMost_m).astray);
    // Near its end it need not get on: it goes on by itself, or waits for a word.
    assert_true(stands(0.9 * kMissedMost_m).bides);
    memory.state.missed = 3;
    assert_int_equal(want(memory, servo_at_rest(DriveVector::Zero())).progress.missed, 3);
  }
}

/// Off along the line is an error of the place alone; off across it is one of the path too, on a
/// line. On a move there is no line to be off.
TEST(off_its_place_is_told_from_off_its_path) {
  const TaskMemory on_line = half_way(0);
  const auto at = [](const TaskMemory& memory, const Eigen::Vector3d& off_m) {
    return want(memory, servo_at_rest(travel_of(profile(), drives_off(memory, off_m))));
  };
  // The line runs along x.
  const TaskWant along = at(on_line, {0.03, 0.0, 0.0});
  assert_near(along.error_m, 0.03, 1e-9);
  assert_near(along.path_error_m, 0.0, 1e-9);
  const TaskWant across = at(on_line, {0.03, 0.0, 0.04});
  assert_near(across.error_m, 0.05, 1e-9);
  assert_near(across.path_error_m, 0.04, 1e-9);
  const TaskWant moved = at(half_way(1), {0.0, 0.0, 0.04});
  assert_near(moved.error_m, 0.04, 1e-9);
  assert_near(moved.path_error_m, 0.04, 1e-9);
}

/// What is still under way is no error; beyond a drive's end nothing can be under way.
TEST(what_is_under_way_is_not_missed) {
  const TaskMemory memory = half_way(0);
  ExcavatorServo servo;
  const DriveVector under_way_m(0.004, -0.006, 0.003, 0.001);
  set(servo, &ServoState::under_way_m, under_way_m);
  set(servo, &ServoState::stroke_m, travel_of(profile(), aim_of(memory).value) - under_way_m);
  assert_near(want(memory, servo).error_m, 0.0, 1e-9);
  servo.drive[kBoom].under_way_m = -10.0;
  assert_true(std::isfinite(want(memory, servo).error_m));
}

TEST(a_plan_of_another_machine_is_unknown) {
  const TaskMemory memory = half_way(0);
  TaskAim aim = aim_of(memory);
  aim.blind.kind = BlindKind::kOutOfReach;
  const ExcavatorServo servo = servo_at_rest(travel_of(profile(), dig().start));
  assert_false(want_of_task(profile(), rows(), kinematics(), dig(), memory, aim, servo, 1.0).known);
}

/// At its end nothing is wanted, and the valve stays closed.
TEST(done_holds_nothing, TaskState state) {
  state.phase = TaskPhase::kDone;
  const TaskWant done = want(remembered(0, state), servo_at_rest(travel_of(profile(), dig().end)));
  assert_true(done.runs);
  assert_false(done.holds);
  assert_true(done.wanted_mps.isZero(0.0));
}

TEST(it_goes_on_or_starts_afresh) {
  const TaskMemory memory = half_way(1);
  const DriveVector travel_m = travel_of(profile(), dig().end);
  const auto next = [&](const TaskMemory& last, std::uint8_t number, double followed) {
    TaskMemory after = last;
    next_task(profile(), kinematics(), dig(), number, travel_m, followed, {}, kCycle_s, after);
    return after;
  };
  const TaskMemory on = next(memory, 0, 0.25);
  assert_true(on.runs);
  assert_int_equal(on.state.step, 1);
  assert_near(on.state.time_s, memory.state.time_s + 0.25 * kCycle_s, 1e-12);
  assert_near(next(memory, 0, 0.0).state.time_s, memory.state.time_s, 0.0);
  for (const TaskMemory& afresh : {next(memory, 1, 1.0), next(TaskMemory{}, 1, 1.0)}) {
    assert_true(afresh.runs);
    assert_int_equal(afresh.number, 1);
    assert_int_equal(afresh.state.phase, TaskPhase::kApproach);
    assert_near(afresh.state.time_s, 0.0, 0.0);
    assert_true((afresh.state.approach.from[0] - dig().end).norm() < 1e-9);
  }
}

/// The lag times the change, no more than what the platform can do; none without a swing.
TEST(the_swing_is_led_by_its_lag) {
  ExcavatorProfile lagging = profile();
  lagging.control.swing_lead_s = 0.2;
  const double most_mps2 = lagging.swing.acceleration_max_radps2 * lagging.swing.lever_m;
  const double change_mps = 0.5 * most_mps2 * kCycle_s;
  assert_near(swing_lead_mps(lagging, 0.01 + change_mps, 0.01, kCycle_s), 0.1 * most_mps2, 1e-12);
  assert_near(swing_lead_mps(lagging, 0.01 - change_mps, 0.01, kCycle_s), -0.1 * most_mps2, 1e-12);
  assert_near(swing_lead_mps(lagging, 1.0, 0.0, kCycle_s), 0.2 * most_mps2, 1e-12);
  assert_near(swing_lead_mps(lagging, -1.0, 0.0, kCycle_s), -0.2 * most_mps2, 1e-12);
  assert_near(swing_lead_mps(lagging, 1.0, 0.0, 0.0), 0.0, 0.0);
  lagging.drive_count = kAxisCount;
  assert_near(swing_lead_mps(lagging, 1.0, 0.0, kCycle_s), 0.0, 0.0);
}

/// Beyond its end, measured or by what is under way, the swing goes no further at all.
TEST(the_cap_looks_where_what_is_under_way_will_have_come) {
  DriveVector then = dig().start;
  then[kSwing] = profile().swing.left_end_rad - 0.05;
  const DriveVector velocity_mps = travel_of(profile(), {0.0, 0.0, 0.0, 0.5});
  ExcavatorServo servo = servo_at_rest(travel_of(profile(), then));
  const auto cap = [&] {
    return motion_cap(profile(), rows(), kinematics(), dig().fences, strokes_then_m(rows(), servo),
                      velocity_mps);
  };
  assert_near(cap().factor, profile().control.stroke_end_gain_ps * 0.05002 / 0.5, 1e-9);
  assert_int_equal(cap().limit.kind, LimitKind::kSwingEnd);
  servo.drive[kSwing].under_way_m = 0.06 * profile().swing.lever_m;
  assert_near(cap().factor, 0.0, 0.0);
}
