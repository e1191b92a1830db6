// SPDX-License-Identifier: Apache-2.0
/// Which drives a task needs, and what becomes of one whose drives were not commissioned.

#include "app/machines/unknown_drives.hpp"

#include <initializer_list>

#include "app/machines/task_file.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using machines::DozerMachine;
using machines::ExcavatorMachine;
constexpr auto kRefused = machines::UnknownTask::kRefused;
constexpr auto kSlow = machines::UnknownTask::kSlow;

/// The shipped 12 t, of which a commissioning has measured these drives on both sides.
ExcavatorMachine commissioned(std::initializer_list<int> drives) {
  ExcavatorMachine machine = machines::load_excavator(machines::find_profile("excavator_12t"));
  for (const int axis : drives) {
    const auto drive = static_cast<unsigned>(axis);
    machine.driven[drive].extend.said = true;
    machine.driven[drive].retract.said = true;
  }
  machines::refuse_unknown(machine);
  return machine;
}

DozerMachine commissioned_blade() {
  DozerMachine machine = machines::load_dozer(machines::find_profile("dozer_9t"));
  machine.driven.blade[0].extend.said = true;
  machine.driven.blade[0].retract.said = true;
  machines::refuse_unknown(machine);
  return machine;
}

TaskBook book(const char* name) {
  const ExcavatorMachine machine =
      machines::load_excavator(machines::find_profile("excavator_12t"));
  return machines::load_tasks({name}, {machines::find_task("flatten").parent_path()},
                              machine.profile)
      .book;
}

double left(const ExcavatorMachine& machine, Task task, int number = 0) {
  return machine.profile.safety.unknown.left_ratio(task, number);
}

TEST(a_task_needs_what_it_moves) {
  const ExcavatorMachine machine = commissioned({});
  const TaskProgram loading = book("truck_by_steps").program[0];
  assert_true(machines::needed_drives(machine.profile, loading) == machines::kEveryDrive);
  assert_true(machines::needed_drives(machine.profile, {}) == machines::NeededDrives{});
  TaskProgram digs;
  digs.step[0] = loading.step[0];
  digs.step_count = 1;
  digs.start = loading.start;
  const machines::NeededDrives one = machines::needed_drives(machine.profile, digs);
  assert_true(one[kBoom] && one[kArm]);
  assert_false(one[kSwing]);
  // Aside from strip to strip, or from round to round.
  digs.layers.strips = 2;
  assert_true(machines::needed_drives(machine.profile, digs)[kSwing]);
  digs.layers.strips = 1;
  digs.rounds.offset_m.z() = 0.3;
  assert_true(machines::needed_drives(machine.profile, digs)[kSwing]);
}

TEST(a_profile_that_says_nothing_has_all_its_tasks) {
  ExcavatorMachine machine = commissioned({});
  assert_near(left(machine, Task::kDig), 1.0, 0.0);
  assert_true(machines::prepare_unknown(machine, book("flatten"), kRefused).empty());
  assert_true(machines::demand_known(machine, machines::kEveryDrive, kRefused).empty());
  assert_near(left(machine, Task::kProgram), 1.0, 0.0);
  DozerMachine dozer = machines::load_dozer(machines::find_profile("dozer_9t"));
  assert_true(machines::prepare_unknown(dozer, kRefused).empty());
  assert_true(machines::demand_known(dozer, kRefused).empty());
}

TEST(without_the_swing_it_digs_and_is_refused_what_turns) {
  ExcavatorMachine machine = commissioned({kBoom, kArm, kBucket});
  for (const Task task : {Task::kDig, Task::kCoordinated, Task::kAssist, Task::kJog}) {
    assert_near(left(machine, task), 1.0, 0.0);
  }
  assert_true(
      machines::prepare_unknown(machine, book("flatten"), kRefused) ==
      "task 0 needs drives that were not commissioned: swing, left; swing, right: refused\n");
  assert_near(left(machine, Task::kProgram), 0.0, 0.0);
  assert_near(left(machine, Task::kProgram, 1), 1.0, 0.0);
  assert_near(left(machine, Task::kDig), 1.0, 0.0);
  assert_true(machines::prepare_unknown(machine, book("flatten"), kSlow) ==
              "task 0 needs drives that were not commissioned: swing, left; swing, right: at 30 % "
              "of the speed\n");
  assert_near(left(machine, Task::kProgram), 0.3, 0.0);
  assert_near(left(machine, Task::kDig), 1.0, 0.0);
}

TEST(without_the_boom_no_cylinder_moves_with_others) {
  ExcavatorMachine machine = commissioned({kArm, kBucket, kSwing});
  machine.driven[kArm].extend.said = false;
  for (const Task task : {Task::kDig, Task::kCoordinated, Task::kAssist}) {
    assert_near(left(machine, task), 0.0, 0.0);
  }
  for (const Task task : {Task::kJog, Task::kCommission, Task::kNone}) {
    assert_near(left(machine, task), 1.0, 0.0);
  }
  assert_true(test::refusal_of([&] {
                return machines::demand_known(machine, machines::kCylinders, kRefused);
              }) ==
              "excavator_12t: needs drives that were not commissioned: boom, extend; boom, "
              "retract; arm, extend; commission and identify them, or --unknown-drives slow "
              "tries it slowly");
  assert_near(left(machine, Task::kDig), 0.0, 0.0);
  assert_true(machines::demand_known(machine, machines::kCylinders, kSlow) ==
              "not commissioned: boom, extend; boom, retract; arm, extend: at 30 % of the speed");
  for (const Task task : {Task::kDig, Task::kProgram}) {
    assert_near(left(machine, task), 0.3, 0.0);
  }
  // Of others it is not asked.
  assert_true(machines::demand_known(machine, {false, false, true, true}, kRefused).empty());
}

TEST(a_dozer_needs_every_drive) {
  DozerMachine machine = commissioned_blade();
  const UnknownDrives& unknown = machine.profile.safety.unknown;
  assert_near(unknown.left_ratio(Task::kGrade, 0), 0.0, 0.0);
  assert_near(unknown.left_ratio(Task::kJog, 0), 1.0, 0.0);
  assert_true(test::refusal_of([&] {
                return machines::demand_known(machine, kRefused);
              }).find("dozer_9t: needs drives that were not commissioned: tracks; ") == 0);
  assert_true(machines::prepare_unknown(machine, kSlow) ==
              "grade needs drives that were not commissioned: tracks: at 30 % of the speed\n");
  assert_near(unknown.left_ratio(Task::kGrade, 0), 0.3, 0.0);
  assert_true(machines::prepare_unknown(machine, kRefused) ==
              "grade needs drives that were not commissioned: tracks: refused\n");
  assert_near(unknown.left_ratio(Task::kGrade, 0), 0.0, 0.0);
}
