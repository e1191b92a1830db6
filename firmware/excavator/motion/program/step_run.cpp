// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/step_run.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/step_round.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"
#include "firmware/excavator/motion/program/tuning.hpp"

namespace graben {
namespace {

/// Along the level part of a dig's line, in the first round's place.
struct FillLine {
  Eigen::Vector2d from_m;
  Eigen::Vector2d along;
  double way_m;
};

FillLine fill_line(const TaskStep& planned) {
  const TeethLine& line = planned.line.line;
  const Eigen::Vector2d way_m = line.change.position_m.head<2>();
  return {line.from.position_m.head<2>(), way_m.normalized(), way_m.norm()};
}

/// What the edge has passed since the last cycle is in the bucket, and gone from the ground.
void take(const ExcavatorProfile& profile, const TaskProgram& program, const TaskStep& planned,
          const CutSeen& seen, StepFill& fill) {
  if (!fill.begun) {
    fill.top_m.fill(static_cast<float>(program.ground_m));
    fill.begun = true;
  }
  const FillLine line = fill_line(planned);
  const Eigen::Vector3d& at_m = seen.teeth.position_m;
  const double share = (at_m.head<2>() - line.from_m).dot(line.along) / line.way_m;
  const double bin_m2 = line.way_m / kFillBins * profile.geometry.body.bucket_width_m;
  for (int bin = 0; bin < kFillBins; ++bin) {
    const double middle = (bin + 0.5) / kFillBins;
    float& top_m = fill.top_m[static_cast<unsigned>(bin)];
    const double gone_m = static_cast<double>(top_m) - at_m.z();
    if (middle > fill.seen_share && middle <= share && gone_m > 0.0) {
      fill.filled_m3 += gone_m * bin_m2;
      top_m = static_cast<float>(at_m.z());
    }
  }
  fill.seen_share = std::max(fill.seen_share, share);
}

/// Of the plane, the teeth come to rest where they have come to it.
bool comes_to(const StepUntil& until, const LineProfile& line, const TaskStep& step,
              const CutSeen& seen, const TaskState& state) {
  const double left_m = until.offset_m - until.normal.dot(seen.teeth.position_m);
  const double rate_ps = step.line.ramp.at(state.time_s).rate_ps;
  const double speed_mps = rate_ps * until.normal.dot(step.line.line.change.position_m);
  const double rests_s =
      state.pace_ratio * state.pace_ratio / (2.0 * kStepBrakes * line.pace_rate_ps);
  return left_m <= std::max(0.0, speed_mps) * rests_s;
}

bool is_reached(const ExcavatorProfile& profile, const TaskProgram& program, const TaskStep& step,
                double period_s, const CutSeen& seen, TaskState& state) {
  const StepUntil& until = step.until;
  switch (until.kind) {
    case UntilKind::kFull:
      take(profile, program, program.step[static_cast<unsigned>(state.step)], seen, state.fill);
      return state.fill.filled_m3 >= until.most * profile.geometry.body.capacity_m3 / kSwell;
    case UntilKind::kForce: {
      const bool holds = seen.force_known && seen.force_n.norm() >= until.most;
      state.force_s = holds ? state.force_s + period_s : 0.0;
      return state.force_s >= kStepForceHolds_s;
    }
    case UntilKind::kPlane:
      return comes_to(until, profile.line, step, seen, state);
    case UntilKind::kEnd:
      break;
  }
  return false;
}

/// One cycle of a step that comes to rest; true once it has.
bool rests(const LineProfile& line, double end_s, double advance_s, double period_s,
           TaskState& state) {
  state.time_s = std::min(
      end_s, state.time_s + std::max(0.0, advance_s > 0.0 ? state.pace_ratio * advance_s : 0.0));
  state.pace_ratio = std::max(0.0, state.pace_ratio - kStepBrakes * line.pace_rate_ps * period_s);
  return state.pace_ratio <= 0.0 || state.time_s >= end_s;
}

/// Steps that differ from the program's.
bool has_own(const TaskProgram& program) {
  return program.rounds.is_bounded() || program.ends_early;
}

/// Where a part has ended.
struct Ended {
  TeethPose teeth;
  DriveVector drives;  ///< Where they are planned to be there.
};

/// The step that begins now.
void begin(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
           const TaskProgram& program, const Ended& ended, TaskState& state) {
  state.own = true;
  state.off_plan = false;
  state.force_s = 0.0;
  state.fill.filled_m3 = 0.0;
  state.fill.seen_share = 0.0;
  state.here = step_in_round(profile, kinematics, program, state.step, state.round,
                             next_round(program, state))
                   .step;
  const DriveVector begins = step_motion(kinematics, state.here, 0.0).value;
  if ((begins - ended.drives).norm() > kStepSamePlace) {
    state.here = step_from(profile, kinematics, state.here, ended.teeth, ended.drives);
    state.off_plan = true;
  }
}

/// From the end of one part to the next.
void go_on(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
           const TaskProgram& program, const Ended& ended, TaskState& state) {
  if (state.phase == TaskPhase::kSteps) {
    begin(profile, kinematics, program, ended, state);
  } else if (state.phase == TaskPhase::kDone) {
    state.stands = ended.drives;
    state.own = true;
  }
}

/// Of a step that `until` ends: it comes to rest, and the next one leads on from there.
void come_to_rest(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                  const TaskProgram& program, double advance_s, double period_s,
                  const CutSeen& seen, TaskState& state) {
  const TaskStep& step = current_step(program, state);
  if (!rests(profile.line, step.duration_s(), advance_s, period_s, state)) {
    return;
  }
  const Ended ended{seen.teeth, aim_of_steps(kinematics, program, state).value};
  const bool by_what_it_met = state.ends == UntilKind::kForce || state.ends == UntilKind::kFull;
  state.cut_short = state.cut_short || (by_what_it_met && step.kind == StepKind::kDig);
  state = next_part(program, state);
  go_on(profile, kinematics, program, ended, state);
}

}  // namespace

void steps_advance(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                   const TaskProgram& program, double advance_s, double period_s,
                   const CutSeen& seen, TaskState& state) {
  if (state.phase == TaskPhase::kSteps && program.ends_early) {
    const TaskStep& step = current_step(program, state);
    if (state.ends == UntilKind::kEnd && step.straight &&
        is_reached(profile, program, step, period_s, seen, state)) {
      state.ends = step.until.kind;
    }
    if (state.ends != UntilKind::kEnd) {
      come_to_rest(profile, kinematics, program, advance_s, period_s, seen, state);
      return;
    }
  }
  if (!has_own(program)) {
    state = task_advance(profile.line, program, state, advance_s, period_s, seen.behind_m);
    return;
  }
  const TaskPhase phase = state.phase;
  const int number = state.step;
  const int round = state.round;
  const TaskStep last = current_step(program, state);
  state = task_advance(profile.line, program, state, advance_s, period_s, seen.behind_m);
  if (state.phase != phase || state.step != number || state.round != round) {
    const DriveVector end =
        phase == TaskPhase::kSteps ? step_motion(kinematics, last, 1.0).value : program.start;
    go_on(profile, kinematics, program,
          {kinematics.teeth_from_joints(kinematics.joints_from_drive(end).value), end}, state);
  }
}

}  // namespace graben
