// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/safety/dozer_validation.hpp"

#include <cmath>
#include <limits>

#include "firmware/dozer/blade.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/plain_dozer.hpp"

using test::complete_dozer_inputs;

constexpr TimeUs kNow = 5 * kSecondUs;
constexpr TimeUs kStale = kNow - 50 * kMillisecondUs;
/// Both in motion and before it.
constexpr bool kEither[] = {false, true};

const DozerProfile& profile() {
  static const DozerProfile machine = test::plain_dozer();
  return machine;
}

test::ValidatedDozer judged(const DozerInputs& inputs, bool moving = false) {
  return test::validate(inputs, profile(), {}, moving, kNow);
}

void assert_stops(Fault fault, const DozerInputs& inputs) {
  for (const bool moving : kEither) {
    const test::ValidatedDozer valid = judged(inputs, moving);
    assert_int_equal(valid.fault, fault);
    assert_true(valid.faults.has(fault));
    assert_true(valid.degraded.empty());
  }
}

TEST(complete_inputs_become_a_state) {
  DozerInputs inputs = complete_dozer_inputs(kNow);
  inputs.blade_spool_ratio.value = 0.375;
  inputs.valve_enabled.value = true;
  inputs.track[kRight].pump_ratio.value = -0.25;
  inputs.track[kRight].motor_ratio.value = 0.75;
  inputs.track[kRight].speed_mps.value = -0.5;
  for (const bool moving : kEither) {
    const test::ValidatedDozer valid = judged(inputs, moving);
    assert_int_equal(valid.fault, Fault::kNone);
    assert_true(valid.faults.empty() && valid.degraded.empty());
    assert_true(valid.enable && valid.automatic && valid.valve_enabled);
    assert_int_equal(valid.task, Task::kGrade);
    assert_near(valid.speed_override_ratio, 1.0, 0.0);
    assert_near(valid.drive[0].stroke_m, 0.5, 0.0);
    assert_near(valid.drive[0].spool_ratio, 0.375, 0.0);
    assert_near(valid.position_m, 2.0, 0.0);
    assert_near(valid.height_m, 0.25, 0.0);
    assert_near(valid.pitch_rad, 0.125, 0.0);
    assert_near(valid.velocity_mps, 1.0, 0.0);
    assert_near(valid.climb_mps, 0.0625, 0.0);
    assert_near(valid.pitch_rate_radps, 0.03125, 0.0);
    assert_near(valid.pump_ratio[kLeft], 0.5, 0.0);
    assert_near(valid.pump_ratio[kRight], -0.25, 0.0);
    assert_near(valid.motor_ratio[kLeft], 1.0, 0.0);
    assert_near(valid.motor_ratio[kRight], 0.75, 0.0);
    assert_near(valid.track_speed_mps[kLeft], 1.0, 0.0);
    assert_near(valid.track_speed_mps[kRight], -0.5, 0.0);
    assert_near(valid.engine_radps, 40.0, 0.0);
  }
}

struct Row {
  Signal<double>* (*signal)(DozerInputs&);
  Fault missing;
};

constexpr Row kRequired[] = {
    {[](DozerInputs& in) { return &in.blade_stroke_m; }, Fault::kStrokeMissing},
    {[](DozerInputs& in) { return &in.blade_spool_ratio; }, Fault::kSpoolMissing},
    {[](DozerInputs& in) { return &in.body.position_m; }, Fault::kPoseMissing},
    {[](DozerInputs& in) { return &in.body.height_m; }, Fault::kPoseMissing},
    {[](DozerInputs& in) { return &in.body.pitch_rad; }, Fault::kPoseMissing},
    {[](DozerInputs& in) { return &in.body.velocity_mps; }, Fault::kPoseMissing},
    {[](DozerInputs& in) { return &in.body.climb_mps; }, Fault::kPoseMissing},
    {[](DozerInputs& in) { return &in.body.pitch_rate_radps; }, Fault::kPoseMissing},
    {[](DozerInputs& in) { return &in.track[0].pump_ratio; }, Fault::kTransmissionMissing},
    {[](DozerInputs& in) { return &in.track[1].pump_ratio; }, Fault::kTransmissionMissing},
    {[](DozerInputs& in) { return &in.track[0].motor_ratio; }, Fault::kTransmissionMissing},
    {[](DozerInputs& in) { return &in.track[1].motor_ratio; }, Fault::kTransmissionMissing},
    {[](DozerInputs& in) { return &in.track[0].speed_mps; }, Fault::kTransmissionMissing},
    {[](DozerInputs& in) { return &in.track[1].speed_mps; }, Fault::kTransmissionMissing},
    {[](DozerInputs& in) { return &in.driver.speed_override_ratio; }, Fault::kOperatorMissing},
};

/// Every required signal, each in every state that is not usable, stops by its own fault.
TEST(each_signal_is_required) {
  for (const Row& row : kRequired) {
    for (const Validity validity :
         {Validity::kNotReceived, Validity::kNotAvailable, Validity::kOutOfRange}) {
      DozerInputs inputs = complete_dozer_inputs(kNow);
      row.signal(inputs)->validity = validity;
      assert_stops(row.missing, inputs);
    }
    DozerInputs old = complete_dozer_inputs(kNow);
    row.signal(old)->stamp_us = kNow - 45 * kMillisecondUs;
    assert_int_equal(judged(old).fault, Fault::kNone);
    row.signal(old)->stamp_us -= 1;
    assert_stops(row.missing, old);
    DozerInputs mad = complete_dozer_inputs(kNow);
    row.signal(mad)->value = std::numeric_limits<double>::quiet_NaN();
    assert_stops(row.missing, mad);
  }
}

/// 'Error' stops too and is named beside the loss; 'not available' is a loss only. The operator's
/// lever is no sensor.
TEST(a_sensors_own_error_is_named) {
  for (const Row& row : kRequired) {
    DozerInputs inputs = complete_dozer_inputs(kNow);
    row.signal(inputs)->validity = Validity::kError;
    const test::ValidatedDozer valid = judged(inputs, true);
    assert_true(valid.faults.has(row.missing));
    assert_int_equal(valid.faults.has(Fault::kSensorError), row.missing != Fault::kOperatorMissing);
    assert_int_equal(valid.fault, valid.faults.first());
    assert_true(valid.degraded.empty());
    row.signal(inputs)->validity = Validity::kNotAvailable;
    assert_false(judged(inputs, true).faults.has(Fault::kSensorError));
  }
}

TEST(the_rest_is_required_too) {
  DozerInputs echo = complete_dozer_inputs(kNow);
  echo.valve_enabled.stamp_us = kStale;
  echo.valve_enabled.value = true;
  assert_stops(Fault::kSpoolMissing, echo);
  assert_false(judged(echo).valve_enabled);
  DozerInputs other = complete_dozer_inputs(kNow);
  other.same_machine.value = false;
  assert_stops(Fault::kIdentityMismatch, other);
  DozerInputs bus = complete_dozer_inputs(kNow);
  bus.link.bus = BusState::kOff;
  assert_stops(Fault::kBusOff, bus);
  DozerInputs driver = complete_dozer_inputs(kNow);
  driver.driver.enable.stamp_us = kStale;
  assert_stops(Fault::kOperatorMissing, driver);
}

/// Without its speed the engine is reckoned with at its slowest: less flow, less speed.
TEST(a_lost_engine_speed_slows_to_idle) {
  for (const bool mad : kEither) {
    DozerInputs inputs = complete_dozer_inputs(kNow);
    if (mad) {
      inputs.engine_speed_radps.value = std::nextafter(60.0, 90.0);  // 1.2 of its most.
    } else {
      inputs.engine_speed_radps.stamp_us = kStale;
    }
    assert_int_equal(judged(inputs, false).fault, Fault::kEngineSpeedMissing);
    const test::ValidatedDozer moving = judged(inputs, true);
    assert_int_equal(moving.fault, Fault::kNone);
    assert_true(moving.degraded.has(Fault::kEngineSpeedMissing));
    assert_near(moving.engine_radps, 20.0, 0.0);
  }
  DozerInputs fast = complete_dozer_inputs(kNow);
  fast.engine_speed_radps.value = 60.0;
  assert_true(judged(fast).faults.empty());
}

TEST(a_stroke_beyond_the_blades_reach_is_implausible) {
  const double most_m = BladeKinematics(profile().blade).stroke_max_m();
  assert_near(most_m, std::sqrt(3.0) - 1.0, 1e-12);
  DozerInputs inputs = complete_dozer_inputs(kNow);
  for (const double edge_m : {most_m + kStrokeMargin_m, -kStrokeMargin_m}) {
    inputs.blade_stroke_m.value = edge_m;
    const test::ValidatedDozer biased = judged(inputs);
    assert_int_equal(biased.fault, Fault::kNone);
    assert_near(biased.drive[0].stroke_m, edge_m > 0.0 ? most_m : 0.0, 0.0);
    inputs.blade_stroke_m.value = std::nextafter(edge_m, 9.0 * edge_m);
    assert_stops(Fault::kStrokeImplausible, inputs);
  }
}

/// Steeper than any slope that a dozer works on: it stops, however it came to that.
TEST(a_body_on_its_side_cannot_be) {
  for (const double sign : {1.0, -1.0}) {
    DozerInputs inputs = complete_dozer_inputs(kNow);
    inputs.body.pitch_rad.value = sign * kMostPitch_rad;
    assert_true(judged(inputs, true).faults.empty());
    inputs.body.pitch_rad.value = std::nextafter(inputs.body.pitch_rad.value, sign * 9.0);
    assert_stops(Fault::kPoseImplausible, inputs);
  }
}

/// The blade's load is told by it; without it no load is known, and nothing stops.
TEST(a_line_s_pressure_may_be_missing) {
  DozerInputs inputs = complete_dozer_inputs(kNow);
  inputs.track[kLeft].line_pressure_pa = inputs.track[kLeft].speed_mps;
  inputs.track[kLeft].line_pressure_pa.value = 12e6;
  inputs.track[kRight].line_pressure_pa = inputs.track[kLeft].line_pressure_pa;
  inputs.track[kRight].line_pressure_pa.stamp_us = kStale;
  const test::ValidatedDozer valid = judged(inputs, true);
  assert_true(valid.faults.empty());
  assert_near(valid.line_pressure_pa[kLeft], 12e6, 0.0);
  assert_near(valid.line_pressure_pa[kRight], 0.0, 0.0);
}

/// Cylinder and range of the blade's tilt in round numbers.
const DozerProfile& tilting() {
  static const DozerProfile machine = [] {
    DozerProfile tilts = test::plain_dozer();
    tilts.tilt.present = true;
    tilts.tilt.edge_width_m = 2.0;
    tilts.tilt.angle_most_rad = 0.25;
    tilts.tilt.base_m = {0.0, 0.5};
    tilts.tilt.eye_m = {0.75, 0.5};
    tilts.tilt.cylinder_count = 1;
    tilts.tilt.bore_m = 0.12;
    tilts.tilt.rod_m = 0.08;
    tilts.tilt.valve_flow_max_m3ps = tilts.implement.valve_flow_max_m3ps;
    tilts.tilt.spool_to_duty = tilts.implement.spool_to_duty;
    return tilts;
  }();
  return machine;
}

DozerInputs tilted_inputs() {
  DozerInputs inputs = complete_dozer_inputs(kNow);
  inputs.tilt_stroke_m = test::fresh(0.125, kNow);
  inputs.tilt_spool_ratio = test::fresh(0.25, kNow);
  inputs.body.roll_rad = test::fresh(-0.0625, kNow);
  inputs.body.roll_rate_radps = test::fresh(0.015625, kNow);
  return inputs;
}

TEST(a_blade_that_tilts_has_its_own_signals) {
  const test::ValidatedDozer valid = test::validate(tilted_inputs(), tilting(), {}, true, kNow);
  assert_true(valid.faults.empty());
  assert_near(valid.tilt().stroke_m, 0.125, 0.0);
  assert_near(valid.tilt().spool_ratio, 0.25, 0.0);
  assert_near(valid.roll_rad, -0.0625, 0.0);
  assert_near(valid.roll_rate_radps, 0.015625, 0.0);
  constexpr Row kOfTilt[] = {
      {[](DozerInputs& in) { return &in.tilt_stroke_m; }, Fault::kStrokeMissing},
      {[](DozerInputs& in) { return &in.tilt_spool_ratio; }, Fault::kSpoolMissing},
      {[](DozerInputs& in) { return &in.body.roll_rad; }, Fault::kPoseMissing},
      {[](DozerInputs& in) { return &in.body.roll_rate_radps; }, Fault::kPoseMissing},
  };
  for (const Row& row : kOfTilt) {
    for (const bool moving : kEither) {
      DozerInputs lost = tilted_inputs();
      row.signal(lost)->stamp_us = kStale;
      assert_int_equal(test::validate(lost, tilting(), {}, moving, kNow).fault, row.missing);
      // Without a tilt nobody asks for them.
      assert_true(judged(lost, moving).faults.empty());
    }
    DozerInputs broken = tilted_inputs();
    row.signal(broken)->validity = Validity::kError;
    const test::ValidatedDozer said = test::validate(broken, tilting(), {}, true, kNow);
    assert_true(said.faults.has(row.missing) && said.faults.has(Fault::kSensorError));
  }
  DozerInputs on_its_side = tilted_inputs();
  on_its_side.body.roll_rad.value = -0.875;
  assert_true(
      test::validate(on_its_side, tilting(), {}, false, kNow).faults.has(Fault::kPoseImplausible));
}

/// A level design whose track bends.
const DozerProfile& curving() {
  static const double level_m[] = {0.0, 0.0};
  static const double curvature_1pm[] = {0.0625, 0.0625};
  static const DozerProfile machine = [] {
    DozerProfile bends = tilting();
    bends.grade.heights.count = 2;
    bends.grade.heights.height_m = level_m;
    bends.grade.heights.curvature = curvature_1pm;
    return bends;
  }();
  return machine;
}

DozerInputs curving_inputs() {
  DozerInputs inputs = tilted_inputs();
  inputs.body.offset_m = test::fresh(0.25, kNow);
  inputs.body.heading_rad = test::fresh(-0.125, kNow);
  inputs.body.yaw_rate_radps = test::fresh(0.0625, kNow);
  return inputs;
}

TEST(a_track_that_bends_asks_where_the_body_is_beside_it) {
  const test::ValidatedDozer valid = test::validate(curving_inputs(), curving(), {}, true, kNow);
  assert_true(valid.faults.empty());
  assert_near(valid.course.offset_m, 0.25, 0.0);
  assert_near(valid.course.heading_rad, -0.125, 0.0);
  assert_near(valid.course.yaw_rate_radps, 0.0625, 0.0);
  constexpr Signal<double>* (*kOfCourse[])(DozerInputs&) = {
      [](DozerInputs& in) { return &in.body.offset_m; },
      [](DozerInputs& in) { return &in.body.heading_rad; },
      [](DozerInputs& in) { return &in.body.yaw_rate_radps; },
  };
  for (const auto& signal : kOfCourse) {
    for (const bool moving : kEither) {
      DozerInputs lost = curving_inputs();
      signal(lost)->stamp_us = kStale;
      assert_int_equal(test::validate(lost, curving(), {}, moving, kNow).fault,
                       Fault::kPoseMissing);
      // On a straight track nobody asks for them.
      assert_true(test::validate(lost, tilting(), {}, moving, kNow).faults.empty());
    }
    DozerInputs broken = curving_inputs();
    signal(broken)->validity = Validity::kError;
    const test::ValidatedDozer said = test::validate(broken, curving(), {}, true, kNow);
    assert_true(said.faults.has(Fault::kPoseMissing) && said.faults.has(Fault::kSensorError));
  }
}

/// Task Commission goes by what was told to try lately, and by windows of the last second; no other
/// task looks at it.
TEST(what_is_to_be_tried_is_fresh_and_finite) {
  DozerInputs inputs = complete_dozer_inputs(kNow);
  const DozerTry lift = {TriedDrive::kLift, 0.25, 0.75};
  inputs.tried = {lift, Validity::kValid, kNow};
  inputs.window[0] = {{-0.5, 0.5, 0.25}, Validity::kValid, kNow - 900 * kMillisecondUs};
  inputs.window[1] = {{-0.5, 0.5, 0.25}, Validity::kValid, kNow - 1100 * kMillisecondUs};
  assert_int_equal(judged(inputs).tried.drive, TriedDrive::kNone);
  assert_near(judged(inputs).window[0].most_mps, 0.0, 0.0);
  inputs.driver.task.value = Task::kCommission;
  const test::ValidatedDozer valid = judged(inputs);
  assert_int_equal(valid.fault, Fault::kNone);
  assert_int_equal(valid.tried.drive, TriedDrive::kLift);
  assert_near(valid.tried.ratio, 0.25, 0.0);
  assert_near(valid.window[0].most_mps, 0.25, 0.0);
  assert_near(valid.window[1].most_mps, 0.0, 0.0);
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  for (const DozerTry& wrong : {DozerTry{TriedDrive::kLift, no_number, 1.0},
                                DozerTry{TriedDrive::kTracks, 0.25, no_number}}) {
    inputs.tried.value = wrong;
    const test::ValidatedDozer missing = judged(inputs);
    assert_true(missing.faults.has(Fault::kOperatorMissing));
    assert_int_equal(missing.tried.drive, TriedDrive::kNone);
  }
  inputs.tried = {lift, Validity::kValid, 0};
  assert_true(judged(inputs).faults.has(Fault::kOperatorMissing));
}
