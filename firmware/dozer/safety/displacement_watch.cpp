// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/safety/displacement_watch.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

int side_of(double deviation, double tolerance) {
  if (std::abs(deviation) <= tolerance) {
    return 0;
  }
  return deviation > 0.0 ? 1 : -1;
}

double distance(const CommandHistory::Range& range, double measured) {
  return std::max({0.0, range.least - measured, measured - range.most});
}

/// Of the two the one that is nearer to the range. A range that leaves it takes it along.
double nearer(const CommandHistory::Range& range, const DisplacementCourse& last, double measured) {
  const bool came_nearer = distance(range, measured) <= distance(range, last.nearest);
  return !last.judged || came_nearer ? measured : last.nearest;
}

}  // namespace

DisplacementState::DisplacementState(double neutral) : sent(neutral) {}

DisplacementResult watch_displacement(const DisplacementLimits& limits, DisplacementState& state,
                                      double sent, DisplacementTask task, double measured,
                                      double period_s) {
  DisplacementResult result;
  const DisplacementCourse last = state.course;
  DisplacementCourse& course = state.course;
  course = {};
  for (int n = 0; n < cycles_in(period_s); ++n) {
    state.sent.add(sent);
  }
  if (task == DisplacementTask::kNone) {
    return result;
  }
  course.off_side = side_of(measured - sent, limits.tolerance);
  if (course.off_side != 0) {
    course.off_s = (course.off_side == last.off_side ? last.off_s : 0.0) + period_s;
  }
  result.disagrees = course.off_s > limits.settle_s;

  const CommandHistory::Range range = state.sent.range(cycles_under_way(limits.settle_s));
  course.judged = true;
  course.nearest = nearer(range, last, measured);
  const bool outside = distance(range, measured) > limits.tolerance;
  const bool moved_away = std::abs(measured - course.nearest) > limits.tolerance;
  const bool wrong_side = measured * sent < 0.0;
  const bool astray = moved_away || wrong_side || task == DisplacementTask::kReturn;
  course.runaway_cycles = outside && astray ? std::min(last.runaway_cycles + 1, kRunawayCycles) : 0;
  result.runs_away = course.runaway_cycles >= kRunawayCycles;
  return result;
}

}  // namespace graben
