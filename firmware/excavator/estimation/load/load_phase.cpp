// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/load/load_phase.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/estimation/load/tuning.hpp"
#include "firmware/numeric/triangle.hpp"

namespace graben {
namespace {

/// Height of the heap below the teeth: of no account which way the platform looks.
double heap_below_m(const TipPose& tip, const PhaseState& state) {
  const double off_m = std::max(0.0, std::abs(tip.x_m - state.poured_m) - kHeapTop_m);
  return state.heap_m - kHeapFalls * off_m;
}

LoadPhase phase_of(StepKind kind, double share, const TipPose& tip, double height_m,
                   const PhaseState& state) {
  switch (kind) {
    case StepKind::kDig:
      return LoadPhase::kDigs;
    case StepKind::kLift:
      return state.free_s > kPoured_s ? LoadPhase::kCarries : LoadPhase::kDigs;
    case StepKind::kSwing:
      return LoadPhase::kCarries;
    case StepKind::kDump:
      if (state.open_s > kPoured_s) {
        return LoadPhase::kEmpty;
      }
      return state.phase == LoadPhase::kCarries && tip.attitude_rad < kSoilSpills_rad
                 ? LoadPhase::kCarries
                 : LoadPhase::kPours;
    case StepKind::kApproach:
    case StepKind::kReturnToDig:
      if ((share > kMoveNearGround && height_m < kMoveEndClear_m) ||
          height_m < std::max(kGroundClear_m, heap_below_m(tip, state))) {
        return LoadPhase::kUnsaid;
      }
      if (state.open_s > kPoured_s || state.phase == LoadPhase::kEmpty) {
        return LoadPhase::kEmpty;
      }
      return kind == StepKind::kApproach && state.open_s == 0.0 &&
                     tip.attitude_rad > kLittleStays_rad
                 ? LoadPhase::kHangs
                 : LoadPhase::kPours;
    case StepKind::kWait:
      return state.phase;
    case StepKind::kNone:
    case StepKind::kDone:
      break;
  }
  return LoadPhase::kUnsaid;
}

}  // namespace

void next_phase(StepKind kind, double share, const TipPose& tip, double ground_m, double elapsed_s,
                PhaseState& state) {
  const double height_m = tip.y_m - ground_m;
  const bool open = std::abs(wrap_near(tip.attitude_rad, 0.0)) > kOpeningDown_rad;
  state.open_s = open ? std::min(state.open_s + elapsed_s, 2.0 * kPoured_s) : 0.0;
  if (kind != state.kind) {
    state.kind = kind;
    state.lifted_from_m = tip.y_m;
    state.free_s = 0.0;
  }
  if (height_m > kGroundClear_m && tip.y_m > state.lifted_from_m + kLiftFree_m) {
    state.free_s += elapsed_s;
  }
  const LoadPhase before = state.phase;
  state.phase = phase_of(kind, share, tip, height_m, state);
  if (state.phase == LoadPhase::kPours && before == LoadPhase::kCarries) {
    state.poured_m = tip.x_m;
  } else if (state.phase == LoadPhase::kEmpty && before == LoadPhase::kPours) {
    state.poured_m = 0.5 * (state.poured_m + tip.x_m);
  }
}

}  // namespace graben
