// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What can be said of the bucket from what it is told to do and how it is held.

#include <cstdint>

#include "firmware/excavator/excavator_signals.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"

namespace graben {

enum class LoadPhase : std::uint8_t {
  kUnsaid = 0,   ///< It may touch and carry anything.
  kEmpty = 1,    ///< It touches nothing and carries nothing: offsets are learnt.
  kDigs = 2,     ///< It is in the ground, or comes out of it; it fills.
  kCarries = 3,  ///< It touches nothing; what it carries stays the same.
  kPours = 4,    ///< It touches nothing; what it carries gets less.
  kHangs = 5,    ///< It touches nothing; little can be in it, and stays.
};

/// State from cycle to cycle.
struct PhaseState {
  LoadPhase phase = LoadPhase::kUnsaid;
  StepKind kind = StepKind::kNone;
  double open_s = 0.0;         ///< So long the bucket's opening has looked down.
  double lifted_from_m = 0.0;  ///< Height of the teeth where the lift began.
  double free_s = 0.0;         ///< So long a lift has been above the ground.
  double heap_m = 0.0;         ///< Of what it has poured: it may go back through that.
  double poured_m = 0.0;       ///< Where the teeth began to pour, outwards; then the heap's middle.
};

/// What the step that runs (kNone without one), its share that is done and the bucket's pose say.
/// A lift is free half a metre above where it began, and has lost what it can't keep a second and a
/// half later. A bucket is empty in a move that no soil is meant for, once its opening has been
/// down for a second and a half; the last part of such a move may touch the ground where it is low,
/// and what is no higher than the heap's side may touch that.
void next_phase(StepKind kind, double share, const TipPose& tip, double ground_m, double elapsed_s,
                PhaseState& state);

}  // namespace graben
