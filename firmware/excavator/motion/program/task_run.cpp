// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/task_run.hpp"

#include <algorithm>

namespace graben {
namespace {

double duration_s(const TaskProgram& program, const TaskState& state) {
  return state.phase == TaskPhase::kApproach
             ? approach_leg(state.approach, program, state.step).ramp.duration_s
             : current_step(program, state).duration_s();
}

/// Where the drives are decides where the teeth are.
TaskAim aim_of_drives(const SwingKinematics& kinematics, StepKind kind, const DriveState& drives,
                      bool moves) {
  TaskAim aim;
  aim.kind = kind;
  aim.share = moves ? drives.progress.share : 1.0;
  aim.value = drives.value;
  aim.velocity = drives.velocity;
  const DriveResult joints = kinematics.joints_from_drive(aim.value);
  aim.blind = joints.blind;
  aim.teeth = kinematics.teeth_from_joints(joints.value);
  return aim;
}

TaskAim aim_of_line(const SwingKinematics& kinematics, StepKind kind, const LinePlan& plan,
                    double time_s) {
  const Progress progress = plan.ramp.at(time_s);
  const DriveMotion drives = line_motion(kinematics, plan.line, progress.share);
  TaskAim aim;
  aim.kind = kind;
  aim.blind = drives.blind;
  aim.share = progress.share;
  aim.value = drives.value;
  aim.velocity = progress.rate_ps * drives.rate;
  aim.teeth = plan.line.at(progress.share);
  aim.straight = true;
  aim.line = plan.line;
  return aim;
}

/// The leg is not the last.
bool approaches_further(const TaskState& state) {
  return state.phase == TaskPhase::kApproach && state.step + 1 < state.approach.legs;
}

bool does_again(const TaskState& state) { return state.cut_short && state.again < kAgainMost; }

/// After the last step.
void end_round(const TaskProgram& program, TaskState& state) {
  const bool bounded = program.rounds.is_bounded();
  const bool again = does_again(state);
  const int round = state.round + (again ? 0 : 1);
  const bool goes_on =
      program.step_count > 0 && (bounded ? round < program.rounds.count : program.repeats);
  state.step = goes_on ? 0 : std::max(0, program.step_count - 1);
  state.phase = goes_on ? TaskPhase::kSteps : TaskPhase::kDone;
  if (goes_on && bounded) {
    state.round = static_cast<std::uint8_t>(round);
    state.again = again ? static_cast<std::uint8_t>(state.again + 1) : std::uint8_t{0};
    state.cut_short = false;
  }
}

/// At its end, with the teeth so far from it: it goes on.
bool leaves(const TaskProgram& program, double error_m, TaskState& state) {
  const bool calm = state.calm_s >= kCalm_s;
  if (state.phase == TaskPhase::kSteps && current_step(program, state).kind == StepKind::kWait) {
    state.waits = state.waits || calm;
    if (!state.word) {
      return false;
    }
  }
  if (calm) {
    return true;
  }
  if (program.leads_on) {
    return state.settle_s >= kSettleMost_s;
  }
  const bool late = state.settle_s >= kArriveMost_s && error_m <= kMissedMost_m;
  if (late && state.missed < kMissedCount) {
    ++state.missed;
  }
  return late;
}

double slow_error_m(const LineProfile& line, const TaskProgram& program, const TaskState& state) {
  if (!on_line(program, state)) {
    return line.move_slow_error_m;
  }
  const LinePlan& plan = current_step(program, state).line;
  const double speed_mps = plan.way_m * plan.ramp.at(state.time_s).rate_ps;
  return line.slow_error_m + line.slow_error_s * speed_mps;
}

}  // namespace

TaskState task_start(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                     const TaskProgram& program, const DriveVector& drives_now, ApproachWay way) {
  TaskState state;
  state.phase = TaskPhase::kApproach;
  state.approach = approach_path(profile, kinematics, program, drives_now, way);
  return state;
}

TaskAim aim_of_plan(const SwingKinematics& kinematics, StepKind kind, const DrivePlan& plan,
                    double time_s) {
  return aim_of_drives(kinematics, kind, drive_state(plan, time_s), plan.ramp.duration_s > 0.0);
}

TaskAim aim_of_steps(const SwingKinematics& kinematics, const TaskProgram& program,
                     const TaskState& state) {
  if (state.phase == TaskPhase::kApproach) {
    return aim_of_plan(kinematics, StepKind::kApproach,
                       approach_leg(state.approach, program, state.step), state.time_s);
  }
  if (state.phase == TaskPhase::kDone) {
    DriveState stands;
    stands.value = program.leads_on || state.own ? state.stands : program.end;
    return aim_of_drives(kinematics, StepKind::kDone, stands, false);
  }
  const TaskStep& step = current_step(program, state);
  return step.straight ? aim_of_line(kinematics, step.kind, step.line, state.time_s)
                       : aim_of_plan(kinematics, step.kind, step.drives, state.time_s);
}

const TaskStep& current_step(const TaskProgram& program, const TaskState& state) {
  return state.own ? state.here
                   : program.step[static_cast<unsigned>(std::clamp(state.step, 0, kStepMost - 1))];
}

int next_round(const TaskProgram& program, const TaskState& state) {
  const int round = state.round + (does_again(state) ? 0 : 1);
  return std::clamp(round, 0, std::max(0, program.rounds.count - 1));
}

TaskState next_part(const TaskProgram& program, const TaskState& state) {
  TaskState next = state;
  next.time_s = 0.0;
  next.settle_s = 0.0;
  next.calm_s = 0.0;
  next.waits = false;
  next.word = false;
  if (approaches_further(state)) {
    ++next.step;
    return next;
  }
  next.last_end = state.ends;
  next.ends = UntilKind::kEnd;
  next.step = state.phase == TaskPhase::kApproach ? 0 : state.step + 1;
  next.phase = TaskPhase::kSteps;
  if (next.step >= program.step_count) {
    end_round(program, next);
  }
  return next;
}

bool on_line(const TaskProgram& program, const TaskState& state) {
  return state.phase == TaskPhase::kSteps && !program.leads_on &&
         current_step(program, state).straight;
}

double arrival_m(const TaskProgram& program, const TaskState& state) {
  if (program.leads_on || on_line(program, state)) {
    return kSettled_m;
  }
  int next = state.phase == TaskPhase::kApproach ? 0 : state.step + 1;
  if (next >= program.step_count && program.repeats) {
    next = 0;
  }
  const bool before_line =
      next < program.step_count && program.step[static_cast<unsigned>(next)].straight;
  return before_line ? kLineBegins_m : kMoveArrived_m;
}

bool is_astray(const TaskState& state, double error_m) {
  // Written so that NaN is.
  return state.settle_s > 0.0 && state.phase != TaskPhase::kDone && !(error_m <= kMissedMost_m);
}

double wanted_pace(const LineProfile& line, const TaskProgram& program, const TaskState& state,
                   double error_m) {
  const double off = error_m / slow_error_m(line, program, state);
  const double slowed = 1.0 / (1.0 + off * off);
  return slowed > 0.0 ? slowed : 0.0;
}

TaskState task_advance(const LineProfile& line, const TaskProgram& program, const TaskState& state,
                       double advance_s, double period_s, double error_m) {
  if (state.phase == TaskPhase::kDone) {
    return state;
  }
  TaskState next = state;
  const double end_s = duration_s(program, state);
  const double by_s = state.pace_ratio * advance_s;
  const double change = line.pace_rate_ps * period_s;
  next.pace_ratio = std::clamp(wanted_pace(line, program, state, error_m),
                               state.pace_ratio - change, state.pace_ratio + change);
  // Written so that NaN stays where it is.
  next.time_s += by_s > 0.0 ? by_s : 0.0;
  if (next.time_s < end_s) {
    return next;
  }
  if (approaches_further(state)) {
    return next_part(program, next);
  }
  next.time_s = end_s;
  // Held at override 0 it can't arrive.
  next.settle_s += advance_s > 0.0 || program.leads_on ? period_s : 0.0;
  next.calm_s = error_m < arrival_m(program, state) ? state.calm_s + period_s : 0.0;
  return leaves(program, error_m, next) ? next_part(program, next) : next;
}

}  // namespace graben
