// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A task of steps and a machine whose teeth are where they are planned to be.

#include <cmath>

#include "firmware/excavator/motion/program/executor.hpp"
#include "firmware/excavator/motion/program/step_run.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"

namespace graben::test {

inline constexpr double kTop_m = -0.10;

inline const ReplayMachine& steps_machine() {
  static const ReplayMachine loaded(excavator_12t());
  return loaded;
}

/// With its body: a bucket that fills.
inline const ExcavatorProfile& profile() { return excavator_12t().profile; }

/// A level dig, a lift that is a line, a move back.
inline ProgramRequest dig_and_lift() {
  ProgramRequest request;
  request.start = {{7.0, 0.0, kTop_m}, 2.2};
  request.step[0] = {StepKind::kDig, {{4.8, 0.0, kTop_m}, 0.9}, true, 0.4, 0.0, 1.0};
  request.step[1] = {StepKind::kLift, {{4.9, 0.0, 1.4}, 0.3}, true, 0.6, 0.0, 1.0};
  request.step[2] = {StepKind::kReturnToDig, request.start, false, 0.0, 0.0, 0.6};
  request.step_count = 3;
  request.repeats = true;
  return request;
}

inline ProgramRequest in_rounds(int count) {
  ProgramRequest request = dig_and_lift();
  request.rounds.count = count;
  request.rounds.offset_m = {0.0, 0.0, -0.1};
  return request;
}

inline void with_design(double z_m, ProgramRequest& request) {
  request.has_design = true;
  request.design.through_m = {0.0, 0.0, z_m};
  request.design.clearance_m = 0.05;
}

inline ProgramResult plan(const ProgramRequest& request) {
  return plan_program(profile(), request);
}

inline TaskProgram planned(const ProgramRequest& request) {
  const ProgramResult result = plan(request);
  assert_int_equal(result.refusal, ProgramRefusal::kNone);
  return result.program;
}

inline TaskAim aim_of(const TaskProgram& program, const TaskState& state) {
  return task_aim(steps_machine().kinematics, program, state);
}

/// A machine whose teeth are where they are planned to be.
struct Exact {
  TaskProgram program;
  TaskState state;
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();
  bool force_known = true;

  explicit Exact(const ProgramRequest& request) : program(planned(request)) {
    state.phase = TaskPhase::kSteps;
  }
  void step() {
    CutSeen seen;
    seen.teeth = aim_of(program, state).teeth;
    seen.force_known = force_known;
    seen.force_n = force_n;
    steps_advance(profile(), steps_machine().kinematics, program, kCycle_s, kCycle_s, seen, state);
  }
  /// `each(teeth)` in every cycle of this step, until it is left.
  template <class Each>
  void run_step(Each&& each) {
    const int step = state.step;
    const int round = state.round;
    for (int n = 0; state.phase == TaskPhase::kSteps && state.step == step && state.round == round;
         ++n) {
      assert_true(n < 6000);
      const DriveVector before = aim_of(program, state).value;
      each(aim_of(program, state).teeth);
      this->step();
      // The plan never jumps, from step to step neither.
      const DriveVector by = aim_of(program, state).value - before;
      assert_true(by.norm() < 0.05);
    }
  }
  void run_step() {
    run_step([](const TeethPose&) {});
  }
};

}  // namespace graben::test
