// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Random tasks before random fences, on the simulated machine: does any point of it ever pass one?

#include <cstdint>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/runs/figures.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::runs {

/// A task that could be planned, and where the machine stands before it.
struct FencedTask {
  ProgramRequest request;
  TaskProgram program;
  DriveVector start = DriveVector::Zero();  ///< Strokes m, swing rad; free of all fences.
  int refused = 0;  ///< So many drawn sets of fences could not be planned against.
};

/// One to three steps, lines and moves, between random poses, and one to five fences that its way
/// passes by at less than half a metre: planes, boxes, cylinders. `machine` has what the controller
/// knows and what is true. Throws std::runtime_error if nothing can be planned.
[[nodiscard]] FencedTask draw_fenced_task(const machines::SimulatedExcavator& machine,
                                          std::uint64_t seed);

struct FenceSummary {
  double beyond_m = 0.0;    ///< Farthest that any true point was beyond a fence; 0: none ever was.
  double left_m = 0.0;      ///< Nearest that any was.
  double refused = 0.0;     ///< See FencedTask.
  double task_s = kAbsent;  ///< Of the steps.
  double fault = 0.0;       ///< Code of that which stopped it; 0: none.
};

/// No way is an answer: it is refused, and nothing moves.
enum class FenceEnd { kDone = 0, kNoWay = 1, kNotFinished = 2, kFault = 3 };

struct FenceResult {
  FenceEnd end = FenceEnd::kDone;
  FenceSummary summary;
};

[[nodiscard]] const FigureTable<FenceSummary>& fence_figures();

/// The task of that seed, done by the machine.
[[nodiscard]] FenceResult run_fenced_task(const machines::SimulatedExcavator& machine,
                                          std::uint64_t seed);

}  // namespace graben::runs
