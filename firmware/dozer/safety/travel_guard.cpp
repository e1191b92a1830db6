// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/safety/travel_guard.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

double forget(double value, double period_s) {
  return value * std::max(0.0, 1.0 - period_s / kTravelForget_s);
}

/// To which side all that is under way takes the machine; 0: to both, or to none.
int way_of(const TravelGuardState& state) {
  return (state.since_forward_s < kTravelUnderWay_s ? 1 : 0) -
         (state.since_back_s < kTravelUnderWay_s ? 1 : 0);
}

void follow_sent(double sent_ratio, double period_s, TravelGuardState& state) {
  const auto since = [period_s](bool now, double& since_s) {
    since_s = now ? 0.0 : std::min(since_s + period_s, kTravelComesToRest_s);
  };
  since(sent_ratio > 0.0, state.since_forward_s);
  since(sent_ratio < 0.0, state.since_back_s);
}

void follow_way(double velocity_mps, double sent_ratio, double period_s, TravelGuardState& state) {
  const double step_m = velocity_mps * period_s;
  const int way = way_of(state);
  const bool rests = std::min(state.since_forward_s, state.since_back_s) >= kTravelComesToRest_s;
  state.wrong_m = way == 0 ? 0.0 : std::max(0.0, forget(state.wrong_m, period_s) - way * step_m);
  state.free_m = rests ? forget(state.free_m, period_s) + step_m : 0.0;
  const bool told = std::abs(sent_ratio) >= kTravelSurelyMoves;
  const bool stands = std::copysign(1.0, sent_ratio) * state.speed_mps < kTrackAtRest_mps;
  state.stands_s = told && stands ? state.stands_s + period_s : 0.0;
}

/// It has to be stopped now, to be stopped within its window.
bool leaves(const StrokeWindow& window, double way_m, const TravelGuardState& state, int side) {
  const double room_m = side > 0 ? window.most_m - way_m : way_m - window.least_m;
  return room_m <= std::max(0.0, side * state.speed_mps) * kTravelStops_s;
}

Fault fault_of(const StrokeWindow& window, double way_m, const TravelGuardState& state) {
  if (state.wrong_m > kTravelWrong_m) {
    return Fault::kWrongDirection;
  }
  if (std::abs(state.free_m) > kTravelWrong_m) {
    return Fault::kUncommandedMotion;
  }
  if (state.stands_s > kTravelStands_s) {
    return Fault::kStalled;
  }
  const bool outside =
      way_m > window.most_m + kTravelOutside_m || way_m < window.least_m - kTravelOutside_m;
  const bool fast = std::abs(state.speed_mps) > window.most_mps;
  return is_travel_window(window) && (outside || fast) ? Fault::kCommissionBound : Fault::kNone;
}

}  // namespace

bool is_travel_window(const StrokeWindow& window) {
  return window.most_mps > 0.0 && window.least_m < 0.0 && window.most_m > 0.0 &&
         window.least_m >= -kTravelMostWay_m && window.most_m <= kTravelMostWay_m;
}

TravelGuardResult next_travel(const TravelAsk& ask, const DozerValid& seen, double period_s,
                              TravelGuardState& state) {
  if (!state.begun) {
    state = {};
    state.begun = true;
    state.from_m = seen.position_m;
  }
  if (!state.moves) {
    state.moves = true;
    state.since_forward_s = state.since_back_s = kTravelComesToRest_s;
    state.speed_mps = seen.velocity_mps;
  }
  const double tracks_mps = 0.5 * (seen.track_speed_mps[kLeft] + seen.track_speed_mps[kRight]);
  // Of body and tracks the faster: one of them may slip, or be wrong.
  const double fastest_mps =
      std::abs(tracks_mps) > std::abs(seen.velocity_mps) ? tracks_mps : seen.velocity_mps;
  state.speed_mps += (fastest_mps - state.speed_mps) * std::min(1.0, period_s / kTravelSpeedLag_s);
  follow_sent(ask.sent_ratio, period_s, state);
  follow_way(seen.velocity_mps, ask.sent_ratio, period_s, state);

  const double way_m = seen.position_m - state.from_m;
  const int side = ask.wanted_ratio > 0.0 ? 1 : (ask.wanted_ratio < 0.0 ? -1 : 0);
  if (side == 0 || side != state.held_side) {
    state.held_side = 0;
  }
  if (side != 0 && (!is_travel_window(ask.window) || leaves(ask.window, way_m, state, side))) {
    state.held_side = side;
  }
  const bool held = state.held_side != 0;
  return {fault_of(ask.window, way_m, state), held ? 0.0 : std::clamp(ask.wanted_ratio, -1.0, 1.0),
          held};
}

void rest_travel(bool forgets, TravelGuardState& state) {
  state.moves = false;
  state.held_side = 0;
  state.wrong_m = 0.0;
  state.free_m = 0.0;
  state.stands_s = 0.0;
  state.begun = state.begun && !forgets;
}

}  // namespace graben
