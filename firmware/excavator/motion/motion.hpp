// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Third stage of a cycle: the motion that is wanted of the drives, whatever asks for it: the
/// digging field, a program, the levers, or duties that are tried.

#include "firmware/drives/velocity_cap.hpp"
#include "firmware/excavator/estimation/estimate.hpp"
#include "firmware/excavator/motion/field/dig_field.hpp"
#include "firmware/excavator/motion/hand/hand_motion.hpp"
#include "firmware/excavator/motion/program/task_follow.hpp"

namespace graben {

/// Where motion comes from: made once, at start.
struct MotionSources {
  const TaskBook& book;
  const DigField& field;
  const OilGains& oil;
};

/// State from cycle to cycle.
struct MotionMemory {
  TaskMemory task;
  HandState hand;
  TaskAim aim;  ///< Of this cycle: where the program that runs has come to.
};

/// What one cycle asks of the drives.
struct Motion {
  DriveVector wanted_mps = DriveVector::Zero();     ///< V_L^d, the swing's at its lever.
  DriveVector corrected_mps = DriveVector::Zero();  ///< With the servos' corrections.
  DriveVector towards_mps = DriveVector::Zero();    ///< The same, not eased (blocked.hpp).
  VelocityCap cap;
  FenceView fences;     ///< That hold it; without a set only the cylinders' ends do.
  double zero_m = 0.0;  ///< Sensors see heights too high by so much, see Dug.
  double path_error_m = 0.0;
  double off_m = 0.0;  ///< What the tube is laid around.
  TaskWant task;       ///< Of a program.
  HandWant hand;       ///< By the levers.
  Fault fault = Fault::kNone;
  bool eases = false;  ///< A blocked drive's pressure is let off or rests; all others stand.
  bool tries = false;  ///< Task::kCommission: no motion is wanted, the duties are given.
};

/// What estimates have to know of it before this cycle's is known; makes `state.aim`.
[[nodiscard]] MotionUnderWay motion_under_way(const ExcavatorModel& machine, const TaskBook& book,
                                              const ExcavatorValid& valid, MotionMemory& state);

/// What is wanted now, with its corrections. Not inlined, for the stack below the solver.
[[nodiscard, gnu::noinline]] Motion wanted_motion(const ExcavatorModel& machine,
                                                  const MotionSources& sources,
                                                  const ExcavatorValid& valid,
                                                  const InputState& inputs,
                                                  const EstimationState& estimates, double period_s,
                                                  const LastCycle& last, const MotionMemory& state);

/// How a motion was followed.
struct MotionFollowed {
  bool active = false;
  double share = 0.0;  ///< Of what was wanted: lambda, and what else slows all drives alike.
};

/// Program and levers after a cycle. Out of motion they stop.
void go_on(const ExcavatorModel& machine, const TaskBook& book, const ExcavatorValid& valid,
           const Motion& motion, const MotionFollowed& followed, const TipLoad& load,
           double period_s, MotionMemory& state);

}  // namespace graben
