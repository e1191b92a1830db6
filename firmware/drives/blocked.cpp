// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/blocked.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/tuning.hpp"

namespace graben {
namespace {

int sign_of(double value) { return value > 0.0 ? 1 : (value < 0.0 ? -1 : 0); }

/// Low-passes, and what they say.
bool strains_and_stands(double relief_pa, const ValidDrive& seen, double asked_mps, double line_pa,
                        double period_s, BlockedState& state) {
  const double newest = period_s / (period_s + kBlockedFilter_s);
  const double inlet_pa = state.way > 0 ? seen.cap_pressure_pa : seen.rod_pressure_pa;
  const double moved_m = state.way * (seen.stroke_m - state.stroke_m);
  state.inlet_pa += newest * (inlet_pa - state.inlet_pa);
  state.asked_mps += newest * (state.way * asked_mps - state.asked_mps);
  state.speed_mps += newest * ((period_s > 0.0 ? moved_m / period_s : 0.0) - state.speed_mps);
  const double line_share = state.strains ? kBlockedStrainsYet : kBlockedStrains;
  state.strains = line_pa > 0.0 && relief_pa > 0.0 && state.inlet_pa >= line_share * line_pa &&
                  state.inlet_pa >= kBlockedReliefShare * relief_pa;
  const double share = state.side == 0 ? kBlockedStandsShare : kBlockedMovesShare;
  const bool stands = state.asked_mps > kBlockedLeastAsked_mps
                          ? state.speed_mps < share * state.asked_mps
                          : state.speed_mps < kBlockedStill_mps;
  return state.strains && stands;
}

void begin(int way, BlockedState& state) {
  BlockedState begun;
  begun.way = way;
  begun.stroke_m = state.stroke_m;
  begun.less = state.less;
  begun.last_side = state.last_side;
  begun.wary_s = state.wary_s;
  begun.held_at_m = state.held_at_m;
  state = begun;
}

void go_on(Easing easing, BlockedState& state) {
  state.easing = easing;
  state.for_s = 0.0;
}

/// Of a blocked drive.
void ease_pressure(double relief_pa, double stroke_m, double period_s, BlockedState& state) {
  state.for_s += period_s;
  switch (state.easing) {
    case Easing::kPushes:
      if (state.for_s >= kBlockedPushes_s && state.inlet_pa >= kBlockedHardShare * relief_pa) {
        go_on(Easing::kLetsOff, state);
        state.wary_s = kBlockedWary_s;
      }
      return;
    case Easing::kLetsOff:
      if (state.inlet_pa <= kBlockedLetOffShare * relief_pa || state.for_s >= kBlockedLetsOff_s) {
        go_on(Easing::kRests, state);
        state.rests_at_m = stroke_m;
      }
      return;
    case Easing::kRests:
      if (state.for_s >= kBlockedRests_s) {
        begin(state.way, state);
      }
      return;
  }
}

void follow(const DriveRow& drive, const ValidDrive& seen, double asked_mps, double line_pa,
            double period_s, BlockedState& state) {
  const bool held =
      strains_and_stands(drive.watch.relief_pa, seen, asked_mps, line_pa, period_s, state);
  state.stood_s = held ? std::min(state.stood_s + period_s, kBlockedKnown_s) : 0.0;
  if (state.side == 0 && state.stood_s >= kBlockedKnown_s) {
    state.side = state.way;
    state.last_side = state.way;
    state.held_at_m = seen.stroke_m;
    go_on(Easing::kPushes, state);
  }
  if (state.side == 0) {
    return;
  }
  // What rests goes towards its load only where that is gone.
  const double from_m = state.easing == Easing::kRests ? state.rests_at_m : state.held_at_m;
  const bool gave_way = state.side * (seen.stroke_m - from_m) > kBlockedGaveWay_m;
  if (gave_way || (state.easing == Easing::kPushes && !held)) {
    begin(state.way, state);
    return;
  }
  ease_pressure(drive.watch.relief_pa, seen.stroke_m, period_s, state);
}

}  // namespace

void next_blocked(DriveRows drives, Span<const ValidDrive> seen, const BlockedAsk& ask,
                  double period_s, Span<BlockedState> state) {
  for (int i = 0; i < drives.count(); ++i) {
    BlockedState& drive = state[i];
    const int way = seen[i].load_known ? sign_of(ask.towards_mps[i]) : 0;
    if (way == 0 || way != drive.way) {
      begin(way, drive);
    } else {
      follow(drives[i], seen[i], ask.asked_mps[i], ask.line_pa[i], period_s, drive);
    }
    drive.stroke_m = seen[i].stroke_m;
    const bool past = drive.last_side * (seen[i].stroke_m - drive.held_at_m) > kBlockedPast_m;
    const double passed_s = drive.side == 0 ? period_s : 0.0;
    drive.wary_s = past ? 0.0 : std::max(0.0, drive.wary_s - passed_s);
    const double step = period_s / kBlockedEase_s;
    drive.less = std::clamp(drive.less + (drive.side != 0 ? step : -step), 0.0, 1.0);
  }
}

double eased_mps(const BlockedState& state, double wanted_mps, double corrected_mps) {
  if (state.side != 0 && state.easing == Easing::kLetsOff) {
    return -state.side * kBlockedLetsOff_mps;
  }
  const int side = state.last_side;
  const bool rests = state.side != 0 && state.easing == Easing::kRests;
  const double most_mps = rests ? 0.0 : side * std::max(0.0, side * wanted_mps);
  const double over_mps = corrected_mps - most_mps;
  return side * over_mps > 0.0 ? corrected_mps - (rests ? 1.0 : state.less) * over_mps
                               : corrected_mps;
}

bool any_eases(Span<const BlockedState> state) {
  bool any = false;
  for (int i = 0; i < state.count(); ++i) {
    any = any || (state[i].side != 0 && state[i].easing != Easing::kPushes);
  }
  return any;
}

double rested_s(Span<const BlockedState> state) {
  double least_s = kBlockedRests_s;
  bool any = false;
  for (int i = 0; i < state.count(); ++i) {
    if (state[i].side != 0 && state[i].easing != Easing::kPushes) {
      any = true;
      least_s = std::min(least_s, state[i].easing == Easing::kRests ? state[i].for_s : 0.0);
    }
  }
  return any ? least_s : 0.0;
}

bool any_wary(Span<const BlockedState> state) {
  bool any = false;
  for (int i = 0; i < state.count(); ++i) {
    any = any || state[i].wary_s > 0.0;
  }
  return any;
}

bool any_blocked(Span<const BlockedState> state) {
  return blocked_limit(state).kind != LimitKind::kNone;
}

Limit blocked_limit(Span<const BlockedState> state) {
  for (int i = 0; i < state.count(); ++i) {
    if (state[i].side != 0) {
      return {LimitKind::kBackFlow, static_cast<std::uint8_t>(i)};
    }
  }
  return {};
}

}  // namespace graben
