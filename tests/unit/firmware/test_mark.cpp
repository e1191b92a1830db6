// SPDX-License-Identifier: Apache-2.0
// The mark on whole machines: where the teeth and the edge are against it, what arms.

#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/grading_dozer.hpp"
#include "tests/unit/firmware/running.hpp"

using namespace graben::test;

/// So far to the left the 12 t machine, which swings, is turned.
constexpr double kSwing_rad = 0.5;

ExcavatorInputs inputs_of(const ExcavatorProfile& profile, TimeUs now_us) {
  ExcavatorInputs inputs = complete_inputs(now_us);
  if (profile.has_swing()) {
    make_12t(inputs);
  }
  return inputs;
}

TeethPose teeth_at(const ExcavatorProfile& profile, double swing_rad) {
  const ExcavatorInputs inputs = inputs_of(profile, kSecondUs);
  const SwingKinematics kinematics(profile.geometry);
  DriveVector drive;
  drive << inputs.axis[0].stroke_m.value, inputs.axis[1].stroke_m.value,
      inputs.axis[2].stroke_m.value, swing_rad;
  return kinematics.teeth_from_joints(kinematics.joints_from_drive(drive).value);
}

ExcavatorProfile marked_machine(bool swings) {
  ExcavatorProfile profile = (swings ? excavator_12t() : excavator()).profile;
  profile.mark.place_m = teeth_at(profile, swings ? kSwing_rad : 0.0).position_m;
  profile.mark.tolerance_m = 0.03;
  return profile;
}

/// A second of hands and a touch.
struct Touching {
  explicit Touching(const ExcavatorProfile& profile) : setup(profile), controller(setup) {}

  ExcavatorOutputs step(bool touched, OperatorMode mode = OperatorMode::kManual) {
    ExcavatorInputs inputs = inputs_of(setup.profile, now_us);
    inputs.driver.enable.value = false;
    inputs.driver.task.value = Task::kNone;
    inputs.driver.mode.value = mode;
    inputs.axis[kBoom].stroke_m.value += boom_off_m;
    inputs.swing.angle_rad.value = kSwing_rad + swing_off_rad;
    if (touched) {
      inputs.driver.touch = fresh(TouchWord{number, kind}, now_us);
    }
    now_us += 10 * kMillisecondUs;
    outputs = controller.step(inputs, now_us - 10 * kMillisecondUs);
    return outputs;
  }
  const MarkTold& touch() {
    repeat(60, [this] { step(false); });
    ++number;
    repeat(3, [this] { step(true); });
    return outputs.status.mark;
  }

  ExcavatorSetup setup;
  ExcavatorController controller;
  double boom_off_m = 0.0;
  double swing_off_rad = 0.0;
  std::uint8_t number = 0;
  TouchKind kind = TouchKind::kMark;
  TimeUs now_us = kSecondUs;
  ExcavatorOutputs outputs;
};

TEST(teeth_on_their_mark_pass) {
  Touching machine(marked_machine(true));
  const MarkTold& told = machine.touch();
  assert_int_equal(told.touch, MarkTouch::kTaken);
  assert_int_equal(told.result, MarkResult::kPassed);
  assert_near(told.off_m.norm(), 0.0, 1e-9);
  assert_near(told.age_s, 0.02, 1e-9);
  machine.step(false, OperatorMode::kAutomatic);
  assert_int_equal(machine.outputs.status.mode, EcuMode::kReady);
}

TEST(a_stroke_off_by_30_mm_misses_and_does_not_arm) {
  Touching machine(marked_machine(true));
  machine.boom_off_m = 0.03;
  const MarkTold told = machine.touch();
  assert_int_equal(told.result, MarkResult::kMissed);
  const ExcavatorKinematics& planar = machine.setup.kinematics.planar();
  const ExcavatorInputs inputs = inputs_of(machine.setup.profile, 0);
  const Eigen::Vector3d at_m(inputs.axis[0].stroke_m.value, inputs.axis[1].stroke_m.value,
                             inputs.axis[2].stroke_m.value);
  const TipPose off = planar.state(at_m + Eigen::Vector3d(0.03, 0.0, 0.0)).tip;
  const TipPose on = planar.state(at_m).tip;
  assert_near(told.off_m.x(), off.x_m - on.x_m, 1e-9);
  assert_near(told.off_m.y(), 0.0, 1e-9);
  assert_near(told.off_m.z(), off.y_m - on.y_m, 1e-9);
  machine.step(false, OperatorMode::kAutomatic);
  assert_int_equal(machine.outputs.status.mode, EcuMode::kSilent);
  assert_int_equal(machine.outputs.status.fault, Fault::kMarkMissed);
  const auto bit = 1U << static_cast<unsigned>(ArmBlock::kMark);
  assert_int_equal(machine.outputs.status.why_not_armed & bit, bit);
}

TEST(a_swing_off_is_shown_across) {
  Touching machine(marked_machine(true));
  machine.swing_off_rad = 0.01;
  const MarkTold& told = machine.touch();
  const Eigen::Vector3d at_m = teeth_at(machine.setup.profile, 0.0).position_m;
  assert_near(told.off_m.y(), at_m.x() * std::sin(0.01), 1e-9);
  assert_near(told.off_m.x(), at_m.x() * (1.0 - std::cos(0.01)), 1e-9);
}

TEST(without_a_swing_drive_the_links_plane_counts) {
  Touching machine(marked_machine(false));
  machine.swing_off_rad = 0.3;
  assert_near(machine.touch().off_m.norm(), 0.0, 1e-9);
}

TEST(in_automatic_a_touch_is_refused) {
  Touching machine(marked_machine(true));
  repeat(60, [&] { machine.step(false, OperatorMode::kAutomatic); });
  machine.step(true, OperatorMode::kAutomatic);
  assert_int_equal(machine.outputs.status.mark.touch, MarkTouch::kNotByHand);
}

TEST(a_pose_that_is_not_known_is_refused) {
  Touching machine(marked_machine(true));
  machine.boom_off_m = -3.0;
  assert_int_equal(machine.touch().touch, MarkTouch::kNotKnown);
}

TEST(without_a_mark_nothing_is_told) {
  Touching machine(excavator().profile);
  assert_int_equal(machine.touch().result, MarkResult::kNoMark);
}

/// A dozer by hand, standing.
MarkTold dozer_touches(const Eigen::Vector3d& mark_m, double height_off_m) {
  DozerProfile profile = dozer().profile;
  profile.mark.place_m = mark_m;
  profile.mark.tolerance_m = mark_m.isZero() ? 0.0 : 0.02;
  const DozerSetup setup(profile);
  DozerController controller(setup);
  const double stroke_m = setup.blade.stroke_m(0.0);
  DozerOutputs outputs;
  for (int i = 0; i < 70; ++i) {
    const TimeUs now_us = kSecondUs + i * 10 * kMillisecondUs;
    DozerInputs inputs = complete_dozer_inputs(now_us);
    inputs.driver.enable.value = false;
    inputs.driver.task.value = Task::kNone;
    inputs.driver.mode.value = OperatorMode::kManual;
    inputs.blade_stroke_m.value = stroke_m;
    inputs.body.height_m.value = height_off_m;
    inputs.body.pitch_rad.value = 0.0;
    inputs.body.velocity_mps.value = 0.0;
    inputs.body.climb_mps.value = 0.0;
    inputs.body.pitch_rate_radps.value = 0.0;
    inputs.engine_speed_radps.value = profile.hst.engine_radps;
    for (TrackInputs& track : inputs.track) {
      track.pump_ratio.value = 0.0;
      track.speed_mps.value = 0.0;
    }
    if (i > 65) {
      inputs.driver.touch = fresh(TouchWord{1, TouchKind::kMark}, now_us);
    }
    outputs = controller.step(inputs, now_us);
  }
  return outputs.status.mark;
}

TEST(a_dozers_edge_is_looked_at_in_the_world) {
  const BladeKinematics blade(dozer().profile.blade);
  const Eigen::Vector2d edge_m = blade.edge_m(0.0);
  const Eigen::Vector3d mark_m(2.0 + edge_m.x(), 0.0, edge_m.y());
  const MarkTold on = dozer_touches(mark_m, 0.0);
  assert_int_equal(on.touch, MarkTouch::kTaken);
  assert_int_equal(on.result, MarkResult::kPassed);
  assert_near(on.off_m.norm(), 0.0, 1e-9);
  const MarkTold off = dozer_touches(mark_m, 0.03);
  assert_int_equal(off.result, MarkResult::kMissed);
  assert_near(off.off_m.z(), 0.03, 1e-9);
  assert_int_equal(dozer_touches(Eigen::Vector3d::Zero(), 0.0).result, MarkResult::kNoMark);
}
