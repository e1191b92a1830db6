// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/task_change.hpp"

#include <cmath>

#include "firmware/safety/tuning.hpp"

namespace graben {
namespace {

/// Time for which nothing has moved and the same was asked for.
void count_stillness(TaskChangeState& state, bool same, bool at_rest, Span<const double> travel_m,
                     double period_s) {
  bool still = same && at_rest;
  for (int i = 0; i < travel_m.count(); ++i) {
    still =
        still && std::abs(travel_m[i] - state.still_m[static_cast<unsigned>(i)]) <= kStandstill_m;
  }
  if (still) {
    state.still_s += period_s;
    return;
  }
  state.still_s = 0.0;
  for (int i = 0; i < travel_m.count(); ++i) {
    state.still_m[static_cast<unsigned>(i)] = travel_m[i];
  }
}

}  // namespace

bool TaskChoice::operator==(const TaskChoice& other) const {
  return task == other.task && number == other.number;
}

TaskChoice task_after_change(TaskChangeState& state, const TaskChoice& asked, bool in_motion,
                             bool at_rest, Span<const double> travel_m, double period_s) {
  if (!in_motion) {
    state = {};
    return asked;
  }
  count_stillness(state, asked == state.asked, at_rest, travel_m, period_s);
  state.asked = asked;
  const bool has_begun = state.followed.task != Task::kNone;
  state.waiting = state.waiting || (has_begun && !(asked == state.followed));
  if (state.waiting && state.still_s < kStandstill_s) {
    return {};
  }
  state.waiting = false;
  state.followed = asked;
  return asked;
}

}  // namespace graben
