// SPDX-License-Identifier: Apache-2.0
// The site's frame on a whole machine: touched by hand, told in every mode, what it holds back.

#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/running.hpp"

using namespace graben::test;

constexpr double kSwing_rad = 0.5;

ExcavatorInputs inputs_of(const ExcavatorProfile& profile, TimeUs now_us) {
  ExcavatorInputs inputs = complete_inputs(now_us);
  if (profile.has_swing()) {
    make_12t(inputs);
  }
  return inputs;
}

Eigen::Vector3d teeth_m(const ExcavatorProfile& profile, double swing_rad) {
  const ExcavatorInputs inputs = inputs_of(profile, kSecondUs);
  const SwingKinematics kinematics(profile.geometry);
  DriveVector drive;
  drive << inputs.axis[0].stroke_m.value, inputs.axis[1].stroke_m.value,
      inputs.axis[2].stroke_m.value, swing_rad;
  return kinematics.teeth_from_joints(kinematics.joints_from_drive(drive).value).position_m;
}

/// A level design 0.2 m under the benchmark, which is touched at swing 0.5, the second point at
/// -0.3: level with it, and on its circle.
TaskBook book_of(const ExcavatorProfile& profile, bool by_touch) {
  const Eigen::Vector3d one_m = teeth_m(profile, kSwing_rad);
  const Eigen::Vector3d other_m = teeth_m(profile, -0.3);
  TaskBook book;
  book.count = 1;
  book.site = {true, by_touch, Eigen::Vector3d::Zero(), {(other_m - one_m).norm(), 0.0, 0.0}};
  DesignPlane plane;
  plane.through_m.z() = -0.2;
  book.program[0].fences.count = 1;
  book.program[0].fences.fence[0] = plane.fence();
  return book;
}

struct SiteMachine {
  explicit SiteMachine(bool by_touch = true, const ExcavatorProfile& of = excavator_12t().profile)
      : setup(of, book_of(of, by_touch)), controller(setup) {}

  void run(int cycles, bool touched = false) {
    for (int i = 0; i < cycles; ++i) {
      ExcavatorInputs inputs = inputs_of(setup.profile, now_us);
      inputs.driver.enable.value = enable;
      inputs.driver.task.value = task;
      inputs.driver.mode.value = mode;
      inputs.axis[kBoom].stroke_m.value += boom_off_m;
      inputs.swing.angle_rad.value = swing_rad;
      if (touched) {
        inputs.driver.touch = fresh(TouchWord{number, kind}, now_us);
      }
      outputs = controller.step(inputs, now_us);
      now_us += 10 * kMillisecondUs;
    }
  }
  MarkTouch touch(TouchKind of, double at_swing_rad = kSwing_rad) {
    swing_rad = at_swing_rad;
    kind = of;
    run(110);
    ++number;
    run(3, true);
    return outputs.status.mark.touch;
  }
  void touch_both() {
    assert_int_equal(touch(TouchKind::kBenchmark), MarkTouch::kTaken);
    assert_int_equal(site(), SiteKnown::kBenchmark);
    assert_int_equal(touch(TouchKind::kHeading, -0.3), MarkTouch::kTaken);
  }
  [[nodiscard]] SiteKnown site() const { return static_cast<SiteKnown>(outputs.status.site); }
  [[nodiscard]] bool warned() const { return outputs.status.faults.has(Fault::kFrameUnknown); }
  [[nodiscard]] bool refused() const {
    return (outputs.status.why_not_armed >> static_cast<unsigned>(ArmBlock::kSite) & 1U) != 0;
  }

  ExcavatorSetup setup;
  ExcavatorController controller;
  ExcavatorOutputs outputs;
  OperatorMode mode = OperatorMode::kManual;
  Task task = Task::kNone;
  bool enable = false;
  double swing_rad = kSwing_rad;
  double boom_off_m = 0.0;
  std::uint8_t number = 0;
  TouchKind kind = TouchKind::kMark;
  TimeUs now_us = kSecondUs;
};

TEST(touched_by_hand_the_frame_is_known) {
  SiteMachine machine;
  machine.run(2);
  assert_int_equal(machine.site(), SiteKnown::kUnknown);
  assert_true(machine.warned() && !machine.refused());
  machine.touch_both();
  machine.run(1);
  assert_int_equal(machine.site(), SiteKnown::kKnown);
  assert_false(machine.warned());
  // The design is 0.2 m lower than where the teeth are.
  assert_int_equal(machine.touch(TouchKind::kSurface), MarkTouch::kContradict);
  machine.run(1);
  assert_int_equal(machine.site(), SiteKnown::kUnknown);
  assert_true(machine.warned());
}

TEST(a_touch_in_automatic_or_moving_is_refused) {
  SiteMachine machine;
  machine.mode = OperatorMode::kAutomatic;
  assert_int_equal(machine.touch(TouchKind::kBenchmark), MarkTouch::kNotByHand);
  machine.mode = OperatorMode::kManual;
  machine.run(60);
  machine.boom_off_m = 0.02;
  machine.kind = TouchKind::kBenchmark;
  ++machine.number;
  machine.run(3, true);
  assert_int_equal(machine.outputs.status.mark.touch, MarkTouch::kMoving);
  machine.boom_off_m = -3.0;
  assert_int_equal(machine.touch(TouchKind::kBenchmark), MarkTouch::kNotKnown);
  assert_int_equal(machine.site(), SiteKnown::kUnknown);
  // That the tracks have moved is taken at any time.
  assert_int_equal(machine.touch(TouchKind::kMoved), MarkTouch::kTaken);
}

/// By file it is known from the first cycle on, until the tracks have moved.
TEST(a_frame_of_the_file_is_lost_with_the_tracks) {
  SiteMachine machine(false);
  machine.run(2);
  assert_int_equal(machine.site(), SiteKnown::kKnown);
  assert_false(machine.warned());
  machine.touch(TouchKind::kMoved);
  assert_int_equal(machine.site(), SiteKnown::kUnknown);
  machine.run(1);
  assert_true(machine.warned());
  machine.touch_both();
  machine.run(1);
  assert_false(machine.warned());
}

/// What an earlier run has left is not believed again; touched, it is known, and left all the same.
TEST(a_restart_does_not_believe_a_file_that_was_left) {
  SiteMachine first(false);
  first.run(2);
  assert_false(first.controller.site_is_left());
  first.touch(TouchKind::kMoved);
  assert_true(first.controller.site_is_left());
  SiteMachine again(false);
  again.controller.begin_left_site();
  again.run(2);
  assert_int_equal(again.site(), SiteKnown::kUnknown);
  assert_true(again.warned() && again.controller.site_is_left());
  again.touch_both();
  again.run(1);
  assert_int_equal(again.site(), SiteKnown::kKnown);
  assert_false(again.warned());
  assert_true(again.controller.site_is_left());
  // What has to be touched anyway leaves nothing.
  SiteMachine by_touch;
  by_touch.run(2);
  assert_false(by_touch.controller.site_is_left());
}

/// A program is planned where its file has the design: elsewhere it does not arm.
TEST(a_program_with_a_design_does_not_run_elsewhere) {
  SiteMachine machine(false);
  machine.setup.book.program[0].step_count = 1;
  machine.run(2);
  machine.task = Task::kProgram;
  machine.run(1);
  assert_false(machine.refused());
  machine.task = Task::kNone;
  machine.touch(TouchKind::kMoved);
  machine.run(1);
  assert_false(machine.refused());
  machine.task = Task::kProgram;
  machine.run(1);
  assert_true(machine.refused());
  machine.task = Task::kNone;
  machine.touch_both();
  machine.task = Task::kProgram;
  machine.run(1);
  assert_true(machine.refused());
  assert_int_equal(machine.site(), SiteKnown::kKnown);
}

/// What the mark has shown the teeth off by is not in the place that is touched.
TEST(the_marks_check_counts) {
  ExcavatorProfile profile = excavator_12t().profile;
  profile.mark.place_m = teeth_m(profile, kSwing_rad) - Eigen::Vector3d(0.0, 0.0, 0.04);
  profile.mark.tolerance_m = 0.05;
  SiteMachine machine(true, profile);
  machine.setup.book.program[0].fences.fence[0].offset_m = 0.0;
  assert_int_equal(machine.touch(TouchKind::kBenchmark), MarkTouch::kTaken);
  assert_int_equal(machine.touch(TouchKind::kHeading, -0.3), MarkTouch::kTaken);
  assert_int_equal(machine.touch(TouchKind::kSurface), MarkTouch::kTaken);
  // Shown 40 mm too high from here on, as the mark says: without it the place would be 40 mm off.
  assert_int_equal(machine.touch(TouchKind::kMark), MarkTouch::kTaken);
  assert_int_equal(machine.touch(TouchKind::kSurface), MarkTouch::kContradict);
}

TEST(without_a_design_nothing_is_told) {
  SiteMachine machine;
  machine.setup.book.program[0].fences.count = 0;
  machine.run(2);
  assert_int_equal(machine.site(), SiteKnown::kNone);
  assert_false(machine.warned());
}
