// SPDX-License-Identifier: Apache-2.0
// Jog and Coordinated over the bus, on the simulated 22 t excavator.

#include "tests/unit/runs/hands_rig.hpp"

using test::HandsRig;

constexpr TipPose kStart = {4.5, -0.5, 1.3};
constexpr unsigned kUp = 0;
constexpr unsigned kForward = 1;
constexpr unsigned kAttitude = 2;

Eigen::Vector3d start_m() {
  const ExcavatorKinematics kinematics(test::excavator().profile.geometry);
  const StrokeResult strokes = kinematics.strokes_from_pose(kStart);
  assert_int_equal(strokes.status, ReachStatus::kOk);
  return strokes.strokes_m;
}

/// 6 mm; an ideal plant would make it 0.
TEST(two_metres_forward_are_straight) {
  HandsRig rig(test::excavator(), start_m(), Task::kCoordinated);
  rig.work();
  rig.hands.lever_ratio[kForward] = 1.0;
  double off_m = 0.0;
  double turned_rad = 0.0;
  int cycles = 0;
  for (; rig.tip().x_m < kStart.x_m + 2.0 && cycles < 1000; ++cycles) {
    rig.cycle();
    assert_int_equal(rig.status().fault, Fault::kNone);
    off_m = std::max(off_m, std::abs(rig.tip().y_m - kStart.y_m));
    turned_rad = std::max(turned_rad, std::abs(rig.tip().attitude_rad - kStart.attitude_rad));
  }
  assert_true(off_m > 0.0005 && off_m < 0.010);
  assert_true(turned_rad < 0.02);
  assert_true(cycles < 500);
  // Let go, it stops on its line and stays there.
  rig.hands.lever_ratio = {};
  rig.run(1.5);
  const TipPose stopped = rig.tip();
  assert_true(stopped.x_m < kStart.x_m + 2.3);
  assert_near(stopped.y_m, kStart.y_m, 0.010);
  rig.run(3.0);
  assert_near(rig.tip().x_m, stopped.x_m, 0.005);
  assert_near(rig.tip().y_m, stopped.y_m, 0.005);
  assert_int_equal(rig.status().mode, EcuMode::kActive);
}

/// Each axis goes its way, and only it.
TEST(each_axis_goes_its_way) {
  for (const unsigned axis : {kUp, kForward, kAttitude}) {
    for (const double lever : {0.4, -0.4}) {
      HandsRig rig(test::excavator(), start_m(), Task::kCoordinated);
      rig.work();
      rig.hands.lever_ratio[axis] = lever;
      rig.run(1.5);
      const double moved[] = {rig.tip().y_m - kStart.y_m, rig.tip().x_m - kStart.x_m,
                              rig.tip().attitude_rad - kStart.attitude_rad};
      for (const unsigned other : {kUp, kForward, kAttitude}) {
        if (other == axis) {
          assert_true(moved[other] * lever > 0.05);
        } else {
          assert_near(moved[other], 0.0, 0.02);
        }
      }
    }
  }
}

/// It slows to nothing before its arm's end, on its line, says why, and comes back.
TEST(a_line_ends_where_a_cylinder_does) {
  HandsRig rig(test::excavator(), start_m(), Task::kCoordinated);
  rig.work();
  rig.hands.lever_ratio[kForward] = 1.0;
  for (int n = 0; n < 1500; ++n) {
    rig.cycle();
    assert_int_equal(rig.status().fault, Fault::kNone);
    assert_near(rig.tip().y_m, kStart.y_m, 0.030);
  }
  assert_int_equal(rig.status().limit.kind, LimitKind::kStrokeEnd);
  assert_int_equal(rig.status().limit.index, kArm);
  assert_near(rig.strokes_m()[kArm], kLineEnds_m, 0.01);
  assert_true(rig.status().lambda < 0.01);
  const double end_m = rig.tip().x_m;
  rig.hands.lever_ratio[kForward] = -1.0;
  rig.run(3.0);
  assert_true(rig.tip().x_m < end_m - 0.5);
  assert_near(rig.tip().y_m, kStart.y_m, 0.030);
}

/// A station that has promised to show that it reads its levers, and one that does not keep it.
TEST(levers_that_stand_still_stop_it) {
  machines::SimulatedExcavator machine = test::excavator();
  machine.profile.safety.levers_alive_s = 0.1;
  for (const Task task : {Task::kJog, Task::kCoordinated}) {
    HandsRig rig(machine, start_m(), task);
    rig.hands.alive = true;
    rig.work();
    for (const double lever : {1.0, 0.4, 0.0, -0.4}) {
      rig.hands.lever_ratio[kForward] = lever;
      rig.run(1.0);
      assert_int_equal(rig.status().fault, Fault::kNone);
    }
    rig.hands.alive = false;
    rig.run(0.15);
    assert_int_equal(rig.status().fault, Fault::kOperatorMissing);
    assert_true(rig.neutral());
    // Not at its task, they may stand.
    rig.work_again();
    assert_int_equal(rig.status().fault, Fault::kNone);
  }
}

/// One at its end lets the others go on.
TEST(each_drive_jogs_to_its_own_end) {
  HandsRig rig(test::excavator(), start_m(), Task::kJog);
  rig.work();
  rig.hands.lever_ratio[kArm] = -1.0;
  const Eigen::Vector3d before_m = rig.strokes_m();
  rig.run(12.0);
  assert_int_equal(rig.status().fault, Fault::kNone);
  assert_int_equal(rig.status().limit.kind, LimitKind::kStrokeEnd);
  assert_int_equal(rig.status().limit.index, kArm);
  assert_true(rig.strokes_m()[kArm] < 0.01);
  assert_near(rig.strokes_m()[kBoom], before_m[kBoom], 0.005);
  assert_near(rig.strokes_m()[kBucket], before_m[kBucket], 0.005);
  rig.hands.lever_ratio[kBucket] = 0.5;
  rig.run(2.0);
  assert_true(rig.strokes_m()[kBucket] > before_m[kBucket] + 0.1);
  rig.hands.lever_ratio = {};
  rig.run(1.0);
  const Eigen::Vector3d after_m = rig.strokes_m();
  rig.run(5.0);
  assert_true((rig.strokes_m() - after_m).norm() < 0.002);
  assert_int_equal(rig.status().mode, EcuMode::kActive);
}

/// A lever that is held when the operator enables: no arming; it is shown why.
TEST(levers_have_to_rest_for_arming) {
  for (const Task task : {Task::kJog, Task::kCoordinated}) {
    HandsRig rig(test::excavator(), start_m(), task);
    rig.hands.lever_ratio[kArm] = 0.5;
    rig.run(1.0);
    assert_false(in_motion(rig.status().mode));
    assert_true(
        (rig.status().why_not_armed & (1U << static_cast<unsigned>(ArmBlock::kNotCentred))) != 0U);
    rig.work_again();
  }
}

/// One that is held when the task begins has to come to rest first.
TEST(a_task_begins_with_its_levers_at_rest) {
  HandsRig rig(test::excavator(), start_m(), Task::kJog);
  const Eigen::Vector3d before_m = rig.strokes_m();
  rig.run(0.25);
  assert_int_equal(rig.status().mode, EcuMode::kArmed);
  rig.hands.lever_ratio[kArm] = 1.0;
  rig.run(1.0);
  assert_int_equal(rig.status().mode, EcuMode::kActive);
  assert_true((rig.strokes_m() - before_m).norm() < 0.002);
  rig.hands.lever_ratio[kArm] = 0.0;
  rig.run(0.1);
  rig.hands.lever_ratio[kArm] = 1.0;
  rig.run(1.0);
  assert_true(rig.strokes_m()[kArm] > before_m[kArm] + 0.05);
}

/// As soon as a joystick's command would: neutral, latched, until the operator arms again.
TEST(levers_that_are_silent_stop) {
  for (const Task task : {Task::kJog, Task::kCoordinated}) {
    HandsRig rig(test::excavator(), start_m(), task);
    rig.work();
    rig.hands.lever_ratio[kArm] = 0.5;
    rig.run(1.0);
    rig.driver.faults().set_silent(dbc::excavator::OperatorAxes::kId, true);
    rig.run(0.07);
    assert_int_equal(rig.status().mode, EcuMode::kFault);
    assert_int_equal(rig.status().fault, Fault::kOperatorMissing);
    assert_true(rig.neutral());
    rig.driver.faults().set_silent(dbc::excavator::OperatorAxes::kId, false);
    rig.run(0.5);
    assert_int_equal(rig.status().mode, EcuMode::kFault);
    rig.work_again();
  }
}

TEST(the_deadman_is_neutral_at_once) {
  for (const Task task : {Task::kJog, Task::kCoordinated}) {
    HandsRig rig(test::excavator(), start_m(), task);
    rig.work();
    rig.hands.lever_ratio[kArm] = 1.0;
    rig.run(1.0);
    rig.release();
    rig.run(0.03);
    assert_true(rig.neutral());
    assert_int_equal(rig.status().mode, EcuMode::kReady);
    assert_int_equal(rig.status().fault, Fault::kNone);
  }
}

/// Drawn out along a level design and in again by the arm's lever alone: within 15 mm of it, told
/// on the bus; let go, it stops there; boom up lets go of it at once.
TEST(assist_holds_the_edge_on_the_design) {
  TaskBook book;
  book.count = 1;
  DesignPlane plane;
  plane.through_m.z() = test::excavator().profile.geometry.boom_foot_m.y() + kStart.y_m - 0.02;
  book.program[0].fences.count = 1;
  book.program[0].fences.fence[0] = plane.fence();
  HandsRig rig(test::excavator(), start_m(), Task::kAssist, book);
  rig.work();
  assert_int_equal(rig.status().assist, AssistState::kNear);
  const double level_m = kStart.y_m - 0.02;
  for (const double side : {-1.0, 1.0}) {
    const double from_m = rig.tip().x_m;
    rig.hands.lever_ratio[kArm] = side;
    for (int n = 0; n < 250; ++n) {
      rig.cycle();
      assert_int_equal(rig.status().fault, Fault::kNone);
      assert_true(n < 100 || std::abs(rig.tip().y_m - level_m) < 0.015);
    }
    assert_int_equal(rig.status().assist, AssistState::kHolds);
    assert_true(side * (rig.tip().x_m - from_m) < -0.8);
    rig.hands.lever_ratio = {};
    rig.run(1.0);
    assert_int_equal(rig.status().assist, AssistState::kNear);
    assert_near(rig.tip().y_m, level_m, 0.015);
    const TipPose stands = rig.tip();
    rig.run(2.0);
    assert_near(rig.tip().x_m, stands.x_m, 0.003);
    assert_near(rig.tip().y_m, stands.y_m, 0.003);
  }
  rig.hands.lever_ratio[kArm] = -0.5;
  rig.run(1.0);
  rig.hands.lever_ratio[kBoom] = 0.5;
  rig.run(0.03);
  assert_int_equal(rig.status().assist, AssistState::kLetGo);
  rig.run(1.0);
  assert_true(rig.tip().y_m > level_m + 0.1);
}
