// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/cut_force.hpp"
#include "firmware/excavator/motion/dig/dig_phases.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"
#include "firmware/excavator/motion/program/executor.hpp"

namespace graben {
namespace {

/// Nothing stands before a bucket at its line's end: the step that lifts it takes it out.
bool lifts_next(const DigCycle& cycle, const TaskState& state) {
  const int next = cycle.after(state.step);
  return state.dig.share >= 1.0 &&
         cycle.program.step[static_cast<unsigned>(next)].kind == StepKind::kLift;
}

}  // namespace

void LiftPhase::enter(const DigCycle& cycle, int /*step*/, TaskState& state) {
  DigRun& run = state.dig;
  run.folds = run.phase == CutPhase::kCuts;
  // From where the teeth are: a plan that the soil has held off would first have to come back.
  const TeethPose from =
      run.folds ? cycle.seen.teeth : task_aim(cycle.kinematics, cycle.program, state).teeth;
  run.lift = lift_line(cycle.profile, cycle.kinematics, cycle.plan(), from,
                       run.folds ? LiftPart::kFolds : LiftPart::kOut);
  run.held_s = 0.0;
}

bool LiftPhase::go_on(const DigCycle& cycle, TaskState& state) {
  DigRun& run = state.dig;
  const CutSeen& seen = cycle.seen;
  // A heel that is turned against the ground stops nothing at first: valves and reliefs give way.
  const double bears = seen.force_known && run.folds
                           ? seen.force_n.norm() / (kHeelMost * cycle.plan().force_n)
                           : 0.0;
  run.held_s = heaviness(cycle.plan(), bears, seen) > 1.0 ? run.held_s + cycle.period_s : 0.0;
  if (run.held_s > kLiftHeld_s) {
    run.lift = free_line(cycle.profile, cycle.kinematics, cycle.plan(), seen.teeth, run.entered);
    run.folds = true;
    run.held_s = 0.0;
    state.time_s = 0.0;
    state.settle_s = 0.0;
    return false;
  }
  state.time_s += state.pace_ratio * cycle.advance_s;
  const double end_s = run.lift.ramp.duration_s;
  if (state.time_s < end_s) {
    return false;
  }
  state.time_s = end_s;
  state.settle_s += cycle.period_s;
  return seen.behind_m < kLiftNear_m || state.settle_s > kEndWait_s;
}

void LiftPhase::leave(const DigCycle& cycle, TaskState& state) {
  if (state.dig.folds && !lifts_next(cycle, state)) {
    enter_phase<LiftPhase>(cycle, state.step, state);
  } else {
    state.dug.cuts.loaded_m3 = 0.0;
    enter_step(cycle, state.dug.loaded ? cycle.after(state.step) : cycle.before_cut(), state);
  }
}

}  // namespace graben
