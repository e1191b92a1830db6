// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/dig_run.hpp"

#include "firmware/excavator/motion/dig/dig_phases.hpp"
#include "firmware/excavator/motion/program/executor.hpp"

namespace graben {
namespace {

/// The table of phases; by direct calls, whose stack and cycles are known.
template <class... Phase>
struct PhaseTable {
  static bool go_on(CutPhase phase, const DigCycle& cycle, TaskState& state) {
    return ((phase == Phase::kPhase && Phase::go_on(cycle, state)) || ...);
  }
  static void leave(CutPhase phase, const DigCycle& cycle, TaskState& state) {
    (void)((phase == Phase::kPhase && (Phase::leave(cycle, state), true)) || ...);
  }
};

using Phases = PhaseTable<MovePhase, TarePhase, TouchPhase, EnterPhase, CutsPhase, LiftPhase>;

/// The step is the first return from where a bucket that was weighed has been emptied.
bool tares_next(const TaskProgram& program, int step, const DigRun& run) {
  return !run.tared && run.weighed_kg > 0.0 &&
         program.step[static_cast<unsigned>(step)].kind == StepKind::kReturnToDig;
}

/// A dig begins by feeling for the ground, once, else by its cut.
void enter_dig(const DigCycle& cycle, int step, TaskState& state) {
  if (first_phase(cycle.program, state) == CutPhase::kTouches) {
    enter_phase<TouchPhase>(cycle, step, state);
  } else {
    enter_phase<EnterPhase>(cycle, step, state);
  }
}

}  // namespace

void enter_step(const DigCycle& cycle, int step, TaskState& state) {
  if (step == cycle.plan().step) {
    enter_dig(cycle, step, state);
  } else if (tares_next(cycle.program, step, state.dig)) {
    enter_phase<TarePhase>(cycle, step, state);
  } else {
    enter_phase<MovePhase>(cycle, step, state);
  }
  const bool stays = state.dig.phase == CutPhase::kNone && state.phase == TaskPhase::kSteps &&
                     !(state.dig.move.ramp.duration_s > 0.0);
  if (stays && cycle.after(step) == cycle.plan().step) {
    step = cycle.after(step);
    enter_dig(cycle, step, state);
  }
  state.step = step;
  state.calm_s = 0.0;
  state.time_s = 0.0;
  state.settle_s = 0.0;
}

CutPhase first_phase(const TaskProgram& program, const TaskState& state) {
  return program.layers.touch_share >= 0.0 && !state.dug.touched ? CutPhase::kTouches
                                                                 : CutPhase::kEnters;
}

DriveVector drives_now(const DigCycle& cycle, const TaskState& state) {
  return task_aim(cycle.kinematics, cycle.program, state).value;
}

void dig_advance(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                 const TaskProgram& program, double advance_s, double period_s, const CutSeen& seen,
                 TaskState& state) {
  const DigCycle cycle{profile,  kinematics, program, advance_s > 0.0 ? advance_s : 0.0,
                       period_s, seen};
  if (state.phase == TaskPhase::kApproach) {
    const int leg = state.step;
    state = task_advance(profile.line, program, state, advance_s, period_s, seen.behind_m);
    if (state.phase != TaskPhase::kApproach) {
      // By the move that leads to the cut: it may not be the first. It begins where the approach
      // ends.
      state.phase = TaskPhase::kApproach;
      state.step = leg;
      state.time_s = approach_leg(state.approach, program, leg).ramp.duration_s;
      enter_step(cycle, cycle.before_cut(), state);
      state.phase = state.dug.cuts.met ? TaskPhase::kDone : TaskPhase::kSteps;
    }
  } else if (state.phase == TaskPhase::kSteps) {
    state.dug.step = state.step;
    state.dug.teeth_m = seen.teeth.position_m;
    follow_pace(cycle, state);
    const CutPhase phase = state.dig.phase;
    if (Phases::go_on(phase, cycle, state)) {
      Phases::leave(phase, cycle, state);
    }
  }
}

}  // namespace graben
