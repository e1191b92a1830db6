// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Executes a program: where on its plan a task is, what is wanted there, and how it goes on.

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/motion/dig/dig_state.hpp"
#include "firmware/excavator/motion/program/approach.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"
#include "firmware/excavator/motion/program/tuning.hpp"

namespace graben {

enum class TaskPhase : std::uint8_t {
  kApproach = 0,  ///< To the first pose.
  kSteps = 1,
  kDone = 2,  ///< Stands at the last pose.
};

/// Pieces of a dig's line whose ground is kept. [-; size: of StepFill]
inline constexpr int kFillBins = 24;

/// What a dig has taken, by where its edge has passed.
struct StepFill {
  bool begun = false;  ///< `top_m` says where the ground is by now,
  std::array<float, kFillBins>
      top_m{};              ///< along the level part of the line, over the ground frame.
  double seen_share = 0.0;  ///< Of that, which the edge has passed in this step.
  double filled_m3 = 0.0;   ///< Of the ground, in this step.
};

/// State from cycle to cycle. The place on the plan is a time of the plan, not of a clock:
/// nothing is ever behind, and nothing has to be caught up.
struct TaskState {
  TaskPhase phase = TaskPhase::kDone;
  int step = 0;
  double time_s = 0.0;    ///< tau: of the plan of approach or step.
  double settle_s = 0.0;  ///< How long it has waited at its end.
  double calm_s = 0.0;    ///< How long of that the teeth have been there without a break.
  /// Steps that went on though they had not arrived, since the task began, up to kMissedCount.
  std::uint8_t missed = 0;
  /// Of the plan's speed, 0 .. 1: the aim's velocity has to be scaled by it before what is owed is
  /// added, and task_advance goes on by it. Drives that went on at full speed would run ahead of a
  /// plan that waits for them, and make the error that it waits for.
  double pace_ratio = 1.0;
  std::uint8_t round = 0;  ///< Of a program that has rounds.
  std::uint8_t again = 0;  ///< Rounds before this one that were no deeper than the one before.
  bool cut_short = false;  ///< A dig of this round was ended by its force or its fill.
  UntilKind ends = UntilKind::kEnd;      ///< What has come about: the step comes to rest.
  UntilKind last_end = UntilKind::kEnd;  ///< Of the step before.
  double force_s = 0.0;                  ///< How long the force that ends the step has been there.
  StepFill fill;
  /// The step is `here` and not the program's.
  bool own = false;
  bool off_plan = false;  ///< And begins elsewhere than planned.
  TaskStep here;
  bool waits = false;                        ///< It stands at a wait,
  bool word = false;                         ///< and the operator has asked for the task anew.
  ApproachPath approach;                     ///< `step` is the leg.
  DriveVector stands = DriveVector::Zero();  ///< At its end, where that is not the program's.
  Dug dug;
  DigRun dig;
};

/// Aim of the plan at one moment.
struct TaskAim {
  StepKind kind = StepKind::kNone;
  /// kNone but for a program that was never planned for this machine: then nothing else holds.
  BlindSpot blind;
  double share = 0.0;  ///< Of approach or step, 0 .. 1.
  DriveVector value = DriveVector::Zero();
  DriveVector velocity =
      DriveVector::Zero();  ///< By the plan's time, at lambda 1; see task_slowing.
  /// What is asked for beside it whatever the pace: a heavy cut gives way at once.
  DriveVector at_once = DriveVector::Zero();
  TeethPose teeth;        ///< Where they are planned to be.
  bool straight = false;  ///< They follow `line`.
  bool cuts = false;      ///< It leads through soil, or down into it.
  TeethLine line;
};

/// Most missed steps that are counted. [-; standard: a byte of J1939 counts so far, NotArrived of
/// TaskStatus]
inline constexpr int kMissedCount = 250;

/// At the beginning of the approach that search_approach() has found, planned from where the
/// machine stands now. It can't meet a blind spot. In motion the soft limit holds it before fences.
[[nodiscard]] TaskState task_start(const ExcavatorProfile& profile,
                                   const SwingKinematics& kinematics, const TaskProgram& program,
                                   const DriveVector& drives_now,
                                   ApproachWay way = ApproachWay::kDirect);

/// Of a program of steps; of any program in its approach and once it is done.
[[nodiscard]] TaskAim aim_of_steps(const SwingKinematics& kinematics, const TaskProgram& program,
                                   const TaskState& state);

/// Of a move of the drives at its time.
[[nodiscard]] TaskAim aim_of_plan(const SwingKinematics& kinematics, StepKind kind,
                                  const DrivePlan& plan, double time_s);

/// The step that runs, as it is in this round and from where it began.
[[nodiscard]] const TaskStep& current_step(const TaskProgram& program, const TaskState& state);

/// After a part that has ended: the next leg, step or round, or the task is done. A round whose dig
/// was cut short is done again, see kAgainMost.
[[nodiscard]] TaskState next_part(const TaskProgram& program, const TaskState& state);

/// The round that a step which ends where the next one begins leads to.
[[nodiscard]] int next_round(const TaskProgram& program, const TaskState& state);

/// True while a straight line of the teeth is being followed; else a move of the drives, or none.
[[nodiscard]] bool on_line(const TaskProgram& program, const TaskState& state);

/// Of the part that runs, see kSettled_m.
[[nodiscard]] double arrival_m(const TaskProgram& program, const TaskState& state);

/// True at the end of an approach or a step with the teeth so far from it that it will not go on.
[[nodiscard]] bool is_astray(const TaskState& state, double error_m);

/// The pace that an error of the teeth asks for: half where they are line.slow_error_m off their
/// planned place and line.slow_error_s times the line's planned speed there, as the digging field
/// does along its path; or line.move_slow_error_m where the drives are only moved; 0 for NaN. From
/// rest a drive that sticks is waited for sooner than one that lags on the way.
[[nodiscard]] double wanted_pace(const LineProfile& line, const TaskProgram& program,
                                 const TaskState& state, double error_m);

/// One cycle on. `advance_s` is what the plan may go on by: lambda and every other factor on the
/// velocity but its own pace, times the period. The pace follows wanted_pace no faster than
/// line.pace_rate_ps: a platform can't be slowed at once, and a plan that tries makes it swing
/// about its place. At the end of approach or step it waits until it has arrived, see kSettled_m
/// and kArriveMost_s.
[[nodiscard]] TaskState task_advance(const LineProfile& line, const TaskProgram& program,
                                     const TaskState& state, double advance_s, double period_s,
                                     double error_m);

}  // namespace graben
