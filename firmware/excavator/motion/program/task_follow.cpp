// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/task_follow.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/dig_run.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/program/tuning.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

TeethPose teeth_of(const SwingKinematics& kinematics, const DriveVector& drives) {
  return kinematics.teeth_from_joints(kinematics.joints_from_drive(drives).value);
}

/// Into the drives' ranges: what is under way may be what a correction has asked for.
DriveVector bounded(DriveRows drives, DriveVector travel_m) {
  for (int i = 0; i < drives.count(); ++i) {
    travel_m[i] = std::clamp(travel_m[i], drives[i].least_travel_m, drives[i].most_travel_m);
  }
  return travel_m;
}

/// A drive that a move hardly moves is left to its corrections: its load would hold up all others.
DriveVector without_trifles(const DriveVector& velocity_mps) {
  const double least_mps = kMoveTrifle * velocity_mps.cwiseAbs().maxCoeff();
  return (velocity_mps.array().abs() < least_mps).select(0.0, velocity_mps);
}

/// Of an error, what is not ahead along the planned motion of the teeth.
double behind_m(const SwingKinematics& kinematics, const TaskAim& aim,
                const Eigen::Vector3d& due_less_at_m) {
  const MachineMotion planned = machine_motion(kinematics, aim.value, aim.velocity);
  const Eigen::Vector3d& velocity_mps =
      planned.point[static_cast<unsigned>(MachinePoint::kTeeth)].velocity_mps;
  const double speed_mps = velocity_mps.norm();
  if (planned.status != ReachStatus::kOk || speed_mps < kTeethStand_mps) {
    return due_less_at_m.norm();
  }
  const double along_m = due_less_at_m.dot(velocity_mps) / speed_mps;
  const double across_m2 = due_less_at_m.squaredNorm() - along_m * along_m;
  const double ahead_m = std::max(0.0, along_m);
  return std::sqrt(std::max(0.0, across_m2) + ahead_m * ahead_m);
}

TaskProgress progress_of(const TaskProgram& program, const TaskMemory& memory, const TaskAim& aim) {
  TaskProgress progress;
  progress.runs = true;
  progress.number = memory.number;
  const bool approaches = memory.state.phase == TaskPhase::kApproach;
  progress.step = approaches ? std::uint8_t{0} : static_cast<std::uint8_t>(memory.state.step);
  progress.kind = aim.kind;
  progress.share = aim.share;
  progress.missed = memory.state.missed;
  progress.round = memory.state.round;
  progress.next_round = static_cast<std::uint8_t>(next_round(program, memory.state));
  progress.last_end = memory.state.last_end;
  progress.off_plan = memory.state.off_plan;
  return progress;
}

/// Looks for the way on; runs once it is found. Not inlined: its states would lie on the stack
/// below a cut's, which is the deepest there is.
[[gnu::noinline]] void search(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                              const TaskProgram& program, std::uint8_t number,
                              const DriveVector& drives_now, TaskMemory& memory) {
  if (!memory.search.runs || memory.search.number != number) {
    memory.search = {};
    memory.state.approach = {};
  }
  if (memory.number != number) {
    memory.state.dug = {};
  }
  memory.runs = false;
  memory.number = number;
  memory.search.runs = true;
  memory.search.number = number;
  const Dug dug = memory.state.dug;
  search_approach(profile, kinematics, program, drives_now, memory.search, memory.state.approach);
  if (memory.search.found) {
    memory.state =
        task_start(profile, kinematics, program, drives_now, ApproachWay{memory.search.way});
    memory.search = {};
    memory.runs = true;
  } else {
    memory.state.phase = TaskPhase::kDone;
  }
  memory.state.dug = dug;
}

bool goes_on_from_wait(const SwingKinematics& kinematics, const TaskProgram& program,
                       std::uint8_t number, const DriveVector& drives, const TaskMemory& memory) {
  if (memory.runs || !memory.state.word || memory.number != number) {
    return false;
  }
  const TeethPose waits = teeth_of(kinematics, current_step(program, memory.state).drives.from);
  return (teeth_of(kinematics, drives).position_m - waits.position_m).norm() < kWaitStillThere_m;
}

}  // namespace

TaskMemory remembered(std::uint8_t number, const TaskState& state) {
  TaskMemory memory;
  memory.runs = true;
  memory.number = number;
  memory.state = state;
  return memory;
}

TaskWant want_of_task(const ExcavatorProfile& profile, DriveRows drives,
                      const SwingKinematics& kinematics, const TaskProgram& program,
                      const TaskMemory& memory, const TaskAim& aim, const ExcavatorServo& servo,
                      double speed_override_ratio) {
  TaskWant want;
  want.runs = true;
  want.known = aim.blind.kind == BlindKind::kNone;
  want.progress = progress_of(program, memory, aim);
  want.holds = memory.state.phase != TaskPhase::kDone;
  want.planned_m = travel_of(profile, aim.value);
  want.teeth = teeth_of(kinematics, drives_of(profile, servo.strokes_m()));
  const Eigen::Vector3d& at_m = want.teeth.position_m;
  const Eigen::Vector3d due_m =
      teeth_of(kinematics,
               drives_of(profile, bounded(drives, want.planned_m - servo.under_way_m())))
          .position_m;
  want.error_m = (at_m - due_m).norm();
  want.moves = want.holds && !aim.straight;
  want.path_error_m = aim.straight ? line_distance_m(aim.line, at_m) : want.error_m;
  want.off_m = aim.straight ? want.path_error_m
                            : std::max(0.0, want.error_m - profile.line.move_slow_error_m);
  want.behind_m = aim.straight ? want.error_m : behind_m(kinematics, aim, due_m - at_m);
  want.astray = !program.leads_on && is_astray(memory.state, want.behind_m);
  want.bides = !program.leads_on && memory.state.settle_s > 0.0 && !want.astray;
  want.pace_ratio = memory.state.pace_ratio;
  const DriveVector planned_mps = travel_of(profile, want.pace_ratio * aim.velocity + aim.at_once);
  want.wanted_mps =
      speed_override_ratio * (want.moves ? without_trifles(planned_mps) : planned_mps);
  return want;
}

TaskMemory stopped(const TaskMemory& last) {
  TaskMemory memory;
  if (last.state.waits) {
    memory = last;
    memory.runs = false;
    memory.search = {};
    memory.state.word = true;
  } else if (!last.runs || last.state.phase != TaskPhase::kDone) {
    memory.number = last.number;
    memory.state.dug = last.state.dug;
  }
  return memory;
}

void next_task(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
               const TaskProgram& program, std::uint8_t number, const DriveVector& travel_m,
               double followed_ratio, const CutSeen& seen, double period_s, TaskMemory& memory) {
  if (goes_on_from_wait(kinematics, program, number, drives_of(profile, travel_m), memory)) {
    memory.runs = true;
    memory.state.settle_s = 0.0;
    memory.state.calm_s = 0.0;
  }
  if (!memory.runs || memory.number != number) {
    const DriveVector drives_now = drives_of(profile, travel_m);
    // While an approach is looked for the machine stands: it can't begin to resume.
    const bool may_resume =
        !memory.runs && memory.number == number && !memory.search.runs && in_layers(program);
    const DigResume way =
        may_resume ? way_to_resume(kinematics, program, drives_now, memory.state) : DigResume{};
    if (way.can) {
      dig_resume(profile, kinematics, program, drives_now, seen, way, memory.state);
      memory.runs = true;
      return;
    }
    memory.state.waits = false;
    memory.state.word = false;
    search(profile, kinematics, program, number, drives_now, memory);
    return;
  }
  const double advance_s = followed_ratio * period_s;
  execute(profile, kinematics, program, advance_s, period_s, seen, memory.state);
}

}  // namespace graben
