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

/// The next line of those that are to be tried; they end with the first that the machine can take.
void try_next(const DigCycle& cycle, DigRun& run) {
  run.lift = lift_try(cycle.profile, cycle.kinematics, cycle.plan(), run.lift.line.from, run.part,
                      kLiftTries - run.tries);
  run.tries = static_cast<std::uint8_t>(run.lift.way_m > 0.0 ? 0 : run.tries - 1);
}

void begin_to_try(const DigCycle& cycle, LiftPart part, const TeethPose& from, DigRun& run) {
  run.lift = {{from, {}}, {}, 0.0};
  run.part = part;
  run.tries = kLiftTries;
  try_next(cycle, run);
}

}  // namespace

void LiftPhase::enter(const DigCycle& cycle, int /*step*/, TaskState& state) {
  DigRun& run = state.dig;
  run.folds = run.phase == CutPhase::kCuts;
  // From where the teeth are: a plan that the soil has held off would first have to come back.
  const TeethPose from =
      run.folds ? cycle.seen.teeth : task_aim(cycle.kinematics, cycle.program, state).teeth;
  begin_to_try(cycle, run.folds ? LiftPart::kFolds : LiftPart::kOut, from, run);
  run.held_s = 0.0;
}

bool LiftPhase::go_on(const DigCycle& cycle, TaskState& state) {
  DigRun& run = state.dig;
  const CutSeen& seen = cycle.seen;
  if (run.tries > 0) {
    try_next(cycle, run);
    return false;
  }
  // A heel that is turned against the ground stops nothing at first: valves and reliefs give way.
  const double bears = seen.force_known && run.folds
                           ? seen.force_n.norm() / (kHeelMost * cycle.plan().force_n)
                           : 0.0;
  run.held_s = heaviness(cycle.plan(), bears, seen) > 1.0 ? run.held_s + cycle.period_s : 0.0;
  if (run.held_s > kLiftHeld_s) {
    run.lift = way_back(cycle.profile, cycle.kinematics, cycle.plan(), seen.teeth, run.entered);
    if (run.lift.way_m <= 0.0) {
      begin_to_try(cycle, LiftPart::kFrees, seen.teeth, run);
    }
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
