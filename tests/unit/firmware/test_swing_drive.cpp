// SPDX-License-Identifier: Apache-2.0
// The 12 t machine's swing on the way from a wanted velocity to its duty: servo, end of range,
// valve, gate; and its controller, which digs with the swing held.

#include <cmath>

#include "firmware/excavator/motion/program/line_plan.hpp"
#include "firmware/mcv/optimiser.hpp"
#include "tests/fuzz/plain_circuit.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/running.hpp"

using test::assert_neutral;
using test::corrected_velocity;
using test::servo_at_rest;
using test::set;
using test::stroke_end_cap;

const ExcavatorProfile& profile() { return test::excavator_12t().profile; }
double lever_m() { return profile().swing.lever_m; }

/// All cylinders half out.
DriveVector half_out(double swing_rad = 0.0) {
  DriveVector travel_m;
  for (int i = 0; i < kAxisCount; ++i) {
    travel_m[i] = 0.5 * profile().geometry.cylinder[static_cast<unsigned>(i)].stroke_m;
  }
  travel_m[kSwing] = swing_rad * lever_m();
  return travel_m;
}

TEST(the_motor_is_a_cylinder_with_equal_areas) {
  const McvMachine valve = mcv_machine(profile());
  assert_int_equal(valve.actuator_count, kDriveCount);
  assert_int_equal(valve.pump_count, 1);
  const McvActuator& swing = valve.actuator[kSwing];
  assert_near(swing.area_cap_m2, 1.2e-3 / 0.15, 1e-15);
  assert_near(swing.area_rod_m2, swing.area_cap_m2, 0.0);
  assert_int_equal(swing.regeneration, RegenerationSide::kNone);
  for (int i = 0; i < kDriveCount; ++i) {
    assert_int_equal(valve.actuator[static_cast<unsigned>(i)].pump, 0);
  }
  assert_int_equal(check_machine(valve).defect, McvDefect::kNone);
  assert_int_equal(mcv_machine(test::excavator().profile).actuator_count, kAxisCount);
}

McvInput four_drives(double swing_mps) {
  McvInput input;
  input.velocity_mps = {0.05, -0.05, 0.05, swing_mps};
  input.cap_pressure_pa = {6e6, 3e6, 3e6, 2e6};
  input.rod_pressure_pa = {2e6, 3e6, 3e6, 2e6};
  input.pump_flow_m3ps = {4.5e-3};
  return input;
}

/// One pump for all: what is solved is what a plain circuit of four says, and what helps the swing
/// to the left helps it to the right.
TEST(four_drives_on_one_pump) {
  const McvMachine valve = mcv_machine(profile());
  for (const double swing_mps : {0.02, 0.1, 0.2, 0.4}) {
    const McvInput left = four_drives(swing_mps);
    const McvInput right = four_drives(-swing_mps);
    const McvSolution to_left = solve_mcv(valve, left, McvPolicy::kGlobal);
    const McvSolution to_right = solve_mcv(valve, right, McvPolicy::kGlobal);
    assert_int_equal(to_left.status, SolveStatus::kOk);
    const double lambda = to_left.point.lambda;
    assert_true(lambda > 0.0);
    assert_near(to_right.point.lambda, lambda, 1e-9);
    assert_near(to_right.point.spool_m[kSwing], -to_left.point.spool_m[kSwing], 1e-9);
    assert_true(to_left.point.spool_m[kSwing] > 0.0);
    const test::PlainPoint plain = test::plain_point(valve, left, lambda * (1.0 - 1e-10));
    assert_true(plain.margin >= 0.0);
    assert_near(to_left.point.pump_pressure_pa[0], plain.pump_pressure_pa[0],
                1e-5 * plain.pump_pressure_pa[0]);
    const double opened = test::plain_coefficient(valve.actuator[kSwing].extend,
                                                  std::abs(to_left.point.spool_m[kSwing]));
    assert_near(opened, plain.coefficient[kSwing], 1e-5 * plain.coefficient[kSwing]);
  }
  // 0.4 m/s at the lever and the cylinders are more than the pump has; slower, not elsewhere.
  assert_true(solve_mcv(valve, four_drives(0.4), McvPolicy::kGlobal).point.lambda < 1.0);
  assert_near(solve_mcv(valve, four_drives(0.0), McvPolicy::kGlobal).point.spool_m[kSwing], 0.0,
              0.0);
}

/// Servo, end of range, valve and gate in a row, as the controller has them.
test::Gated duties(double wanted_radps, double owed_rad = 0.0) {
  DriveVector wanted = DriveVector::Zero();
  wanted[kSwing] = wanted_radps * lever_m();
  ExcavatorServo servo = servo_at_rest(half_out());
  servo.drive[kSwing].correction_m = owed_rad * lever_m();
  const DriveVector corrected = corrected_velocity(profile(), wanted, servo, 1.0, 1.0);
  McvInput input;
  for (unsigned i = 0; i < kDriveCount; ++i) {
    input.velocity_mps[i] = stroke_end_cap(profile(), half_out(), corrected).factor * corrected[i];
    input.cap_pressure_pa[i] = input.rod_pressure_pa[i] = 2e6;
  }
  input.pump_flow_m3ps = {4.5e-3};
  const McvSolution solution = solve_mcv(mcv_machine(profile()), input, McvPolicy::kGlobal);
  return test::gate(profile(), {}, true,
                    {solution.point.spool_m[0], solution.point.spool_m[1],
                     solution.point.spool_m[2], solution.point.spool_m[3]},
                    1.0);
}

TEST(a_swing_velocity_gives_a_duty_of_its_sign) {
  for (const double wanted_radps : {0.05, 0.5, 1.4}) {
    const test::Gated left = duties(wanted_radps);
    assert_true(left.duty_ratio[kSwing] > 0.2);
    assert_near(duties(-wanted_radps).duty_ratio[kSwing], -left.duty_ratio[kSwing], 1e-9);
    for (unsigned i = 0; i < kAxisCount; ++i) {
      assert_near(left.duty_ratio[i], 0.0, 0.0);
    }
  }
  // One that is not wanted stays closed, whatever it owes.
  assert_near(duties(0.0, 0.1).duty_ratio[kSwing], 0.0, 0.0);
}

/// At its own gain: 1 1/s where the cylinders have 2.
TEST(the_swing_owes_at_its_own_gain) {
  ExcavatorProfile machine = profile();
  machine.control.servo_gain_ps = 2.0;
  machine.control.swing_servo_gain_ps = 1.0;
  ExcavatorServo servo = servo_at_rest(half_out());
  set(servo, &ServoState::correction_m, {0.01, 0.01, 0.01, 0.01});
  const DriveVector wanted(0.01, 0.01, 0.01, 0.01);
  const DriveVector asked = corrected_velocity(machine, wanted, servo, 1.0, 1.0);
  assert_near(asked[kArm], 0.03, 1e-15);
  assert_near(asked[kSwing], 0.02, 1e-15);
  const DriveVector held(0.01, 0.01, 0.01, 0.0);
  assert_near(corrected_velocity(machine, held, servo, 1.0, 1.0)[kSwing], 0.0, 0.0);
}

/// What is owed does not push it into an end of its range, and a prediction goes on beyond.
TEST(what_is_owed_stops_at_an_end_of_the_range) {
  for (const double sign : {1.0, -1.0}) {
    const double end_rad =
        sign > 0.0 ? profile().swing.left_end_rad : profile().swing.right_end_rad;
    ExcavatorServo servo = servo_at_rest(half_out(end_rad));
    servo.drive[kSwing].correction_m = sign * 0.02;
    DriveVector wanted = DriveVector::Zero();
    wanted[kSwing] = -sign * 0.01;
    assert_near(corrected_velocity(profile(), wanted, servo, 1.0, 1.0)[kSwing], 0.0, 1e-15);
    // Nothing stops a platform there: one that is going beyond has to be seen there.
    servo.drive[kSwing].under_way_m = sign * 0.05;
    const DriveVector then_m = strokes_then_m(excavator_bank(profile()).rows(), servo);
    assert_near(then_m[kSwing], end_rad * lever_m() + sign * 0.05, 1e-12);
  }
}

/// Alike on both sides, in metres at the lever as in radians: per second what is left times the
/// gain. The rest slows with it.
TEST(the_swing_slows_before_the_end_of_its_range) {
  const double gain_ps = profile().control.stroke_end_gain_ps;
  for (const double sign : {1.0, -1.0}) {
    const double near_rad = sign * (profile().swing.left_end_rad - 0.1);
    const DriveVector velocity(0.01, 0.01, 0.01, sign * 0.5 * lever_m());
    const VelocityCap cap = stroke_end_cap(profile(), half_out(near_rad), velocity);
    assert_int_equal(cap.limit.kind, LimitKind::kSwingEnd);
    assert_int_equal(cap.limit.index, 0);
    assert_near(cap.factor, gain_ps * 0.1 / 0.5, 1e-9);
    assert_near(stroke_end_cap(profile(), half_out(near_rad), -velocity).factor, 1.0, 0.0);
    // Beyond it only the way back is left.
    const DriveVector beyond = half_out(sign * (profile().swing.left_end_rad + 0.05));
    assert_near(stroke_end_cap(profile(), beyond, velocity).factor, 0.0, 0.0);
    assert_near(stroke_end_cap(profile(), beyond, -velocity).factor, 1.0, 0.0);
  }
  // A machine whose swing is held has no end there.
  const ExcavatorProfile& held = test::excavator().profile;
  assert_near(stroke_end_cap(held, {0.5, 0.7, 0.5, 0.0}, {0.01, 0.01, 0.01, 0.3}).factor, 1.0, 0.0);
}

/// Half the section's flow: 1.667e-3 over 1.2e-3 m^3/rad are less than its own 1.435 rad/s.
TEST(a_plan_asks_no_more_than_the_motor_is_fed) {
  ExcavatorProfile starved = profile();
  starved.valve.section_flow_m3ps *= 0.5;
  assert_near(drive_limits(starved).speed_out[kSwing], 1.6665e-3 / 1.2e-3, 1e-9);
  assert_near(drive_limits(starved).speed_in[kSwing], 1.6665e-3 / 1.2e-3, 1e-9);
}

/// The machine in motion, digging; its swing stands.
struct Digging : test::Running {
  Digging() : Running(profile(), test::make_12t) {
    assert_int_equal(outputs.status.mode, EcuMode::kActive);
    assert_true(outputs.enable);
  }
};

TEST(digging_holds_the_swing, Digging digging) {
  for (int n = 0; n < 20; ++n) {
    ExcavatorInputs inputs = digging.inputs();
    inputs.swing.angle_rad.value = n % 2 == 0 ? 1e-3 : -1e-3;
    digging.step(inputs);
    assert_int_equal(digging.outputs.status.mode, EcuMode::kActive);
    assert_true(digging.outputs.status.lambda > 0.0);
    assert_near(digging.outputs.duty_ratio[kSwing], 0.0, 0.0);
    assert_near(digging.outputs.status.wanted_velocity_mps[kSwing], 0.0, 0.0);
    assert_near(digging.outputs.status.swing_wanted_radps, 0.0, 0.0);
  }
}

TEST(whatever_fails_of_the_swing_is_neutral) {
  struct Failure {
    void (*of)(SwingInputs&);
    Fault fault;
  };
  const Failure failures[] = {
      {[](SwingInputs& swing) { swing.angle_rad.validity = Validity::kError; },
       Fault::kStrokeMissing},
      {[](SwingInputs& swing) { swing.spool_ratio.validity = Validity::kNotAvailable; },
       Fault::kSpoolMissing},
      {[](SwingInputs& swing) { swing.angle_rad.value = 3.3; }, Fault::kStrokeMissing},
      {[](SwingInputs& swing) { swing.spool_ratio.value = 0.5; }, Fault::kSpoolStuck},
  };
  for (const Failure& failure : failures) {
    Digging digging;
    for (int n = 0; n < 12 && digging.outputs.status.mode == EcuMode::kActive; ++n) {
      ExcavatorInputs inputs = digging.inputs();
      failure.of(inputs.swing);
      digging.step(inputs);
    }
    assert_neutral(digging.outputs);
    assert_int_equal(digging.outputs.status.mode, EcuMode::kFault);
    assert_int_equal(digging.outputs.status.fault, failure.fault);
  }
}

/// A platform that turns by itself, 0.2 rad/s, long after its spool has closed.
TEST(a_swing_that_turns_by_itself_is_neutral, Digging digging) {
  const SwingProfile& swing = profile().swing;
  // When one at full speed would have come to rest, half a second for the oil, and a second.
  const double stopped_s = swing.speed_max_radps / swing.acceleration_max_radps2 + 1.5;
  double angle_rad = 0.0;
  std::array<double, kAxisCount> way_m{};
  for (int n = 0; n < 3000 && digging.outputs.status.mode == EcuMode::kActive; ++n) {
    ExcavatorInputs inputs = digging.inputs();
    angle_rad += 0.01 * n > stopped_s ? 0.002 : 0.0;
    inputs.swing.angle_rad.value = angle_rad;
    for (unsigned i = 0; i < kAxisCount; ++i) {
      const ExcavatorStatus& status = digging.outputs.status;
      way_m[i] += 0.01 * status.lambda * status.wanted_velocity_mps[i];
      inputs.axis[i].stroke_m.value += way_m[i];
    }
    digging.step(inputs);
  }
  assert_neutral(digging.outputs);
  assert_int_equal(digging.outputs.status.fault, Fault::kUncommandedMotion);
  assert_true(angle_rad > 0.09 && angle_rad < 0.2);
}

/// There is no program yet: asked for in motion it stops, before it nothing arms.
TEST(a_task_that_is_none_of_ours_is_refused) {
  for (const bool has_swing : {true, false}) {
    const auto running = [has_swing] {
      return has_swing ? test::Running(profile(), test::make_12t) : test::Running();
    };
    for (const Task task : {Task::kProgram, Task::kGrade}) {
      test::Running moving = running();
      ExcavatorInputs inputs = moving.inputs();
      inputs.driver.task.value = task;
      assert_neutral(moving.step(inputs));
      assert_int_equal(moving.outputs.status.mode, EcuMode::kFault);
      assert_int_equal(moving.outputs.status.fault, Fault::kTaskUnknown);

      test::Running resting = running();
      resting.step(resting.at_rest(false));
      ExcavatorInputs asked = resting.at_rest(true);
      asked.driver.task.value = task;
      assert_neutral(resting.step(asked));
      assert_int_equal(resting.outputs.status.mode, EcuMode::kSilent);
      assert_true(resting.outputs.status.faults.has(Fault::kTaskUnknown));
      assert_int_equal(resting.outputs.status.fault, Fault::kTaskUnknown);
    }
  }
}

/// Friction and slope are learnt within seconds, and stay where a pressure is missing for less.
TEST(a_missing_pressure_forgets_no_slope) {
  ValidDrive swing;
  swing.load_known = true;
  swing.cap_pressure_pa = 6e6;
  SwingPush push;
  const auto cycles = [&](int count) {
    repeat(count, [&] { next_swing_push(swing, 0.01, push); });
  };
  cycles(1);
  assert_true(push.known);
  swing.cap_pressure_pa = 9e6;
  const auto miss = [&](int count) {
    swing.load_known = false;
    cycles(count);
    assert_false(push.known);
    assert_near(swing_damping_mps(profile(), push), 0.0, 0.0);
    swing.load_known = true;
    cycles(1);
  };
  miss(1);
  assert_near(push.fast_pa, 9e6, 0.0);
  assert_near(push.slow_pa, 6e6, 0.1e6);
  assert_true(std::abs(swing_damping_mps(profile(), push)) > 0.0);
  miss(250);
  assert_near(push.slow_pa, 9e6, 0.0);
}
