// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/rest_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/tuning.hpp"

namespace graben {
namespace {

void begin(double stroke_m, RestState& state) {
  const RestState last = state;
  state = {};
  state.anchor_m = stroke_m;
  state.calm_m = stroke_m;
  state.still_m = stroke_m;
  state.coast_m = last.coast_m;
  state.by_hand = last.by_hand;
  state.asked = true;
  state.anchored = true;
}

/// What he asked for as he gave it back is not known, and what was seen before was his.
void follow_hand(bool by_hand, RestState& state) {
  if (state.by_hand && !by_hand) {
    state.asked = false;
    state.anchored = false;
  }
  state.by_hand = by_hand;
}

/// What it went on by, as far as its last command explains it.
void settle(const RestBounds& bounds, double stroke_m, RestState& state) {
  if (state.stopped_s >= bounds.rest_s) {
    state.anchor_m += std::clamp(stroke_m - state.anchor_m, -state.coast_m, state.coast_m);
    state.coast_m = 0.0;
  }
}

/// Way within which it is where it was: of a platform less than it may go.
double near_m(const RestBounds& bounds) { return std::min(kRestNear_m, 0.5 * bounds.rest_m); }

void follow_stillness(const RestBounds& bounds, double stroke_m, double elapsed_s,
                      RestState& state) {
  state.calm_m += (stroke_m - state.calm_m) * std::min(1.0, elapsed_s / kRestCalm_s);
  if (std::abs(state.calm_m - state.still_m) > kRestStill * near_m(bounds)) {
    state.still_m = state.calm_m;
    state.still_s = 0.0;
  } else {
    state.still_s += elapsed_s;
  }
}

/// A drive that sinks on its oil takes its anchor along.
void sink(const RestBounds& bounds, double stroke_m, double elapsed_s, RestState& state) {
  const double most_m = bounds.sink_mps * elapsed_s;
  const double step_m = std::clamp(stroke_m - state.anchor_m, -most_m, most_m);
  state.anchor_m += step_m;
  state.sunk_m += step_m;
}

RestVerdict verdict(const RestBounds& bounds, const RestState& state) {
  if (state.moves) {
    return RestVerdict::kMoves;
  }
  return std::abs(state.sunk_m) > bounds.rest_m ? RestVerdict::kSinks : RestVerdict::kRests;
}

}  // namespace

RestBounds rest_bounds(const DriveRow& drive) {
  const double coast_s = spool_starts_s(drive) + 2.0 * spool_lag_s(drive) + drive.watch.brakes_s;
  return {drive.watch.rest_m, drive.watch.rest_s, coast_s, drive.watch.fastest_mps,
          drive.watch.sink_mps};
}

void ask_of(const RestBounds& bounds, double asked_mps, RestState& state) {
  const double fast_mps = std::isfinite(asked_mps) ? std::abs(asked_mps) : 0.0;
  state.coast_m = std::max(kRestCoast * fast_mps * bounds.coast_s, kRestCoastKept * state.coast_m);
  state.asked = true;
  state.anchored = false;
}

RestVerdict watch_rest(const RestBounds& bounds, const RestSeen& seen, double elapsed_s,
                       RestState& state) {
  if (!seen.known) {
    return verdict(bounds, state);
  }
  const double stroke_m = seen.stroke_m;
  follow_hand(seen.by_hand, state);
  if (!state.asked) {
    ask_of(bounds, bounds.fastest_mps, state);
  }
  if (!state.anchored) {
    begin(stroke_m, state);
  }
  state.stopped_s += elapsed_s;
  settle(bounds, stroke_m, state);
  follow_stillness(bounds, stroke_m, elapsed_s, state);
  if (state.still_s >= kRestStands_s && (state.moves || seen.by_hand)) {
    begin(stroke_m, state);
  }
  if (seen.centred) {
    sink(bounds, stroke_m, elapsed_s, state);
  }
  const double off_m = std::abs(stroke_m - state.anchor_m);
  state.off_s = off_m > near_m(bounds) ? state.off_s + elapsed_s : 0.0;
  const bool moves = off_m > bounds.rest_m + state.coast_m && state.off_s >= kRestMoves_s;
  if (moves && !state.moves) {
    state.still_s = 0.0;
  }
  state.moves = state.moves || moves;
  return verdict(bounds, state);
}

}  // namespace graben
