// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A 12 t machine that digs in layers, its teeth where they are to be but for what a test says.

#include "firmware/excavator/motion/dig/dig_phases.hpp"
#include "firmware/excavator/motion/dig/dig_run.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/program/task_follow.hpp"
#include "firmware/excavator/swing.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"

namespace graben::layer_test {

using test::kCycle_s;
using test::ReplayMachine;

inline const ReplayMachine& machine() {
  static const ReplayMachine loaded(test::excavator_12t().profile);
  return loaded;
}

inline constexpr double kDesign_m = -0.5;

inline ProgramRequest request() {
  ProgramRequest request;
  request.start = {{6.6, 0.0, kDesign_m}, 1.3};
  StepRequest& dig = request.step[0];
  dig.kind = StepKind::kDig;
  dig.to = {{4.4, 0.0, kDesign_m}, 0.95};
  dig.speed_mps = 0.6;
  dig.in_layers = true;
  request.step[1] = {StepKind::kSwing, {{2.0, 3.5, 2.3}, 0.3}, false, 0.0, 0.0, 0.7};
  request.step[2] = {StepKind::kReturnToDig, request.start, false, 0.0, 0.0, 0.7};
  request.step_count = 3;
  request.repeats = true;
  request.has_design = true;
  request.design = {{6.6, 0.0, kDesign_m}, Eigen::Vector3d::UnitZ(), 0.012};
  return request;
}

inline TaskProgram planned() {
  const ProgramResult result = plan_program(machine().profile, request());
  assert_int_equal(result.refusal, ProgramRefusal::kNone);
  return result.program;
}

/// Teeth that are where they are to be, but for what soil does to them.
inline CutSeen follows(const TaskProgram& program, const TaskState& state) {
  CutSeen seen;
  seen.teeth = task_aim(machine().kinematics, program, state).teeth;
  seen.force_known = true;
  return seen;
}

inline TaskState advance(const TaskProgram& program, TaskState state, const CutSeen& seen) {
  dig_advance(machine().profile, machine().kinematics, program, kCycle_s, kCycle_s, seen, state);
  return state;
}

inline TaskState begun(const TaskProgram& program) {
  return task_start(machine().profile, machine().kinematics, program, program.start);
}

/// Until something holds, or never.
template <class Until>
TaskState run_until(const TaskProgram& program, TaskState state, const Until& until) {
  constexpr int kMost = 200000;
  for (int n = 0; n < kMost && !until(state); ++n) {
    state = advance(program, state, follows(program, state));
  }
  assert_true(until(state));
  return state;
}

inline bool in_cut(const TaskState& state) { return state.dig.phase == CutPhase::kCuts; }

/// In its first cut, farther than this share of the way.
inline TaskState cut_beyond(const TaskProgram& program, double share) {
  return run_until(program, begun(program),
                   [share](const TaskState& at) { return in_cut(at) && at.dig.share > share; });
}

/// On the way down to it, lower than this over the design.
inline TaskState enters_below(const TaskProgram& program, double height_m) {
  return run_until(program, begun(program), [height_m](const TaskState& at) {
    return at.dig.phase == CutPhase::kEnters && at.dig.height_m < height_m;
  });
}

/// While it folds the bucket over the ground.
inline TaskState folding(const TaskProgram& program) {
  return run_until(program, begun(program), [](const TaskState& at) {
    return at.dig.phase == CutPhase::kLifts && at.dig.folds && at.time_s > 0.2;
  });
}

/// Out of its first cut, before the next step.
inline TaskState lifted(const TaskProgram& program) {
  return run_until(program, begun(program), [](const TaskState& at) {
    return at.phase == TaskPhase::kSteps && at.step == 1 && at.dig.phase == CutPhase::kNone;
  });
}

/// So many cycles, each with what `change` makes of teeth that follow.
template <class Change>
TaskState advance_seeing(const TaskProgram& program, TaskState state, int cycles,
                         const Change& change) {
  for (int n = 0; n < cycles; ++n) {
    CutSeen seen = follows(program, state);
    change(seen);
    state = advance(program, state, seen);
  }
  return state;
}

/// So many cycles against this force, of what the program cuts with.
inline TaskState pressed(const TaskProgram& program, const TaskState& state, int cycles,
                         const Eigen::Vector2d& force) {
  return advance_seeing(program, state, cycles,
                        [&](CutSeen& seen) { seen.force_n = force * program.layers.force_n; });
}

/// The same until the cut ends, which it has to.
inline TaskState pressed_out(const TaskProgram& program, TaskState state, int most_cycles,
                             const Eigen::Vector2d& force) {
  for (int n = 0; n < most_cycles && in_cut(state); ++n) {
    state = pressed(program, state, 1, force);
  }
  assert_int_equal(state.dig.phase, CutPhase::kLifts);
  return state;
}

}  // namespace graben::layer_test
