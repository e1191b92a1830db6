// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/mark_check.hpp"

#include <algorithm>

#include "firmware/safety/tuning.hpp"

namespace graben {
namespace {

/// Where the tool goes slowly, or its sensors' noise shows it, it rests.
void next_rest(const Eigen::Vector3d& off_m, double elapsed_s, MarkState& state) {
  const bool moves = !((off_m - state.rest_m).squaredNorm() <= kMarkRest_m * kMarkRest_m);
  if (moves) {
    state.rest_m = off_m;
  }
  state.rest_s = moves ? 0.0 : std::min(state.rest_s + elapsed_s, kMarkRest_s);
}

MarkTouch judged(const MarkSeen& seen, double rest_s) {
  if (seen.kind == TouchKind::kMoved) {
    return MarkTouch::kTaken;
  }
  if (!seen.by_hand) {
    return MarkTouch::kNotByHand;
  }
  if (!seen.known) {
    return MarkTouch::kNotKnown;
  }
  return seen.at_rest && rest_s >= kMarkRest_s ? MarkTouch::kTaken : MarkTouch::kMoving;
}

}  // namespace

void read_touch(const Signal<TouchWord>& touch, TimeUs now_us, MarkSeen& seen) {
  seen.touched = Freshness(kTouchHolds_s, now_us).holds(touch);
  seen.number = touch.value.number;
  seen.kind = touch.value.kind;
}

bool is_place_known(const FaultSet& faults) {
  FaultSet others = faults;
  others.remove(Fault::kMarkMissed);
  others.remove(Fault::kMarkDue);
  return others.empty();
}

void tell_mark(const MarkProfile& mark, const MarkState& state, bool moving, CommonValid& inputs) {
  const MarkTold& told = state.told;
  FaultSet stops;
  if (told.result == MarkResult::kMissed) {
    stops.add(Fault::kMarkMissed);
  }
  const bool never = told.result != MarkResult::kPassed && told.result != MarkResult::kMissed;
  if (mark.most_age_s > 0.0 && (never || told.age_s > mark.most_age_s)) {
    warn(Fault::kMarkDue, inputs);
    if (mark.required && !moving) {
      stops.add(Fault::kMarkDue);
    }
  }
  stop(stops, inputs);
}

bool next_mark(const MarkProfile& mark, const MarkSeen& seen, double elapsed_s, MarkState& state) {
  MarkTold& told = state.told;
  if (mark.known()) {
    told.tolerance_m = mark.tolerance_m;
    told.age_s += elapsed_s;
    if (told.result == MarkResult::kNoMark) {
      told.result = MarkResult::kNever;
    }
  }
  next_rest(seen.off_m, elapsed_s, state);
  const bool is_new = seen.touched && !(state.heard && state.number == seen.number);
  state.heard = seen.touched;
  state.number = seen.number;
  if (!is_new) {
    return false;
  }
  told.touch = judged(seen, state.rest_s);
  if (told.touch != MarkTouch::kTaken) {
    return false;
  }
  const bool of_mark = seen.kind == TouchKind::kMark;
  if (!of_mark || !mark.known()) {
    told.touch = MarkTouch::kNoPoint;
  } else {
    told.off_m = seen.off_m;
    told.age_s = 0.0;
    told.count = static_cast<std::uint8_t>(std::min(told.count + 1, kMostMarkChecks));
    told.result = seen.off_m.norm() <= mark.tolerance_m ? MarkResult::kPassed : MarkResult::kMissed;
  }
  return !of_mark;
}

}  // namespace graben
