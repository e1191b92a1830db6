// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A program as the control cycle follows it: what its plan wants of each drive now, how fast the
/// machine's own place lets it, and how it goes on. Travels and velocities of the swing are those
/// at its lever (SwingProfile).

#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/motion/program/executor.hpp"

namespace graben {

/// State from cycle to cycle.
struct TaskMemory {
  bool runs = false;
  std::uint8_t number = 0;
  TaskState state;
  ApproachSearch search;  ///< Until it runs.
};

[[nodiscard]] TaskMemory remembered(std::uint8_t number, const TaskState& state);

/// Wanted motion of the drives now.
struct TaskWant {
  bool runs = false;
  bool holds = false;  ///< Drives that are to stand are held where they are planned to be.
  bool known = true;   ///< False: the plan is not one of this machine.
  DriveVector planned_m = DriveVector::Zero();   ///< Travel that was asked for until now.
  DriveVector wanted_mps = DriveVector::Zero();  ///< V_L^d.
  double pace_ratio = 1.0;  ///< Of the plan's speed: less where the teeth are behind it.
  double error_m = 0.0;     ///< Of the teeth from where they should be by now.
  /// What the pace gives way to: the same, less what the teeth of a move are ahead. A plan that
  /// slowed down before a platform that runs ahead of it would make it run ahead farther.
  double behind_m = 0.0;
  double path_error_m = 0.0;  ///< The same from the step's straight line, where it is one.
  /// What a tube is laid around: the line; of a move, whose pace gives way to it first, what is
  /// more than that (line.move_slow_error).
  double off_m = 0.0;
  bool moves = false;  ///< On no line: its drives only have to arrive.
  TeethPose teeth;     ///< Where they are.
  /// See is_astray(); a program in layers leads on from wherever it ends.
  bool astray = false;
  /// It stands near its end, or at a wait, and is not asked to get on.
  bool bides = false;
  TaskProgress progress;
};

/// A task that stops: it does not run, but what it has dug is known when it is asked for again. One
/// that stood at a wait goes on from there when it is: that is the operator's word.
[[nodiscard]] TaskMemory stopped(const TaskMemory& last);

/// `aim` is task_aim of the memory's state; `servo` has this cycle's strokes. Speed is that of the
/// plan times `speed_override_ratio`. The place where the teeth should be is the plan's less what
/// is still under way to the drives.
[[nodiscard]] TaskWant want_of_task(const ExcavatorProfile& profile, DriveRows drives,
                                    const SwingKinematics& kinematics, const TaskProgram& program,
                                    const TaskMemory& memory, const TaskAim& aim,
                                    const ExcavatorServo& servo, double speed_override_ratio);

/// The memory after a cycle in which the task was followed at `followed_ratio` of the plan's
/// velocity, but for its own pace: lambda, the cap's factor and the operator's override. A
/// task that does not run yet, or another number, first looks for its way from `travel_m`, see
/// search_approach(), and starts from there.
void next_task(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
               const TaskProgram& program, std::uint8_t number, const DriveVector& travel_m,
               double followed_ratio, const CutSeen& seen, double period_s, TaskMemory& memory);

}  // namespace graben
