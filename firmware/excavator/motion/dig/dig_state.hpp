// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The two states of a dig in layers: what is dug, and how the run that digs it stands.

#include <cstdint>

#include "firmware/excavator/motion/dig/dig_layers.hpp"
#include "firmware/excavator/motion/program/drive_plan.hpp"
#include "firmware/excavator/motion/program/line_plan.hpp"

namespace graben {

/// Phases of a run, see dig_phases.hpp.
enum class CutPhase : std::uint8_t {
  kNone = 0,     ///< A move between two cuts.
  kEnters = 1,   ///< Down to the layer.
  kCuts = 2,     ///< Through the soil.
  kLifts = 3,    ///< Out of the ground, with the bucket folded in.
  kTouches = 4,  ///< Down onto the ground before the first cut, to find its height.
  kTares = 5,    ///< Two moves of the empty bucket that tell its weight.
};

/// What has been dug. Kept over pauses, stops and restarts of its task, until another task is
/// chosen or this one is through.
struct Dug {
  bool begun = false;  ///< `cuts` is of this program.
  CutState cuts;
  bool touched = false;  ///< The ground has been looked for,
  double zero_m = 0.0;   ///< and heights as the sensors see them are too high by so much.
  bool loaded = false;   ///< The bucket has cut, and has not been emptied since.
  int step = 0;          ///< That runs, or ran last,
  Eigen::Vector3d teeth_m = Eigen::Vector3d::Zero();  ///< and where the teeth were then.
};

/// Of the moves of a bucket that has been emptied, see dig_tare.cpp.
enum class TarePart : std::uint8_t {
  kNone = 0,
  kRaises = 1,   ///< The boom up and the arm in.
  kReaches = 2,  ///< The arm out again.
};

/// Of a lift.
enum class LiftPart : std::uint8_t {
  kFolds,  ///< The bucket is folded in,
  kOut,    ///< and lifted out of the ground;
  kFrees,  ///< or straight up first, where its heel stands on something.
};

/// How a run stands. Lost with each pause.
struct DigRun {
  CutPhase phase = CutPhase::kNone;
  double air_n = 0.0;       ///< Upward force that is told before the ground bears anything,
  double up_n = 0.0;        ///< and as it comes down on it.
  double share = 0.0;       ///< Of the line.
  double rate_ps = 0.0;     ///< By the plan's time.
  double height_m = 0.0;    ///< Over the line.
  double height_mps = 0.0;  ///< By the plan's time.
  double give_m = 0.0;      ///< Of that, for what was too heavy.
  double seen_share = 0.0;  ///< That the edge has passed.
  double cut_s = 0.0;       ///< Of this cut, once the bucket is at its attitude,
  double heavy_s = 0.0;     ///< and the sum of how heavy it was in it; 1: as heavy as it may be.
  double held_s = 0.0;      ///< How long it does not get on.
  bool eases = false;       ///< On its way down it lets its oil off,
  double stood_m = 0.0;     ///< which began with the teeth at this height.
  TeethPose entered;        ///< Where the cut has gone into the ground.
  bool folds = false;       ///< The first part of a lift.
  LiftPart part = LiftPart::kFolds;  ///< A way for this one is looked for,
  std::uint8_t tries = 0;            ///< by so many lines still, one a cycle; it stands meanwhile.
  double weighed_kg = 0.0;           ///< What the cut has brought; 0: not known.
  TarePart tares = TarePart::kNone;  ///< The empty bucket is moved before it goes back,
  bool tared = false;                ///< which is done once.
  LinePlan lift;
  DrivePlan move;  ///< Of the step that runs.
};

}  // namespace graben
