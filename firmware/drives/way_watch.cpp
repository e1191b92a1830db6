// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/way_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/tuning.hpp"

namespace graben {
namespace {

/// What was asked, where the drive is by now.
double follow(const SpoolAnswer& answer, double asked_mps, double period_s, WayState& state) {
  const double newest = period_s / (period_s + 0.5 * answer.lag_s);
  state.late_mps[0] += newest * (asked_mps - state.late_mps[0]);
  state.late_mps[1] += newest * (state.late_mps[0] - state.late_mps[1]);
  return state.late_mps[1];
}

}  // namespace

bool presses(const DriveRow& drive, const ValidDrive& seen, double asked_mps) {
  const double inlet_pa = asked_mps > 0.0 ? seen.cap_pressure_pa : seen.rod_pressure_pa;
  return seen.load_known && drive.watch.relief_pa > 0.0 &&
         inlet_pa > kWayPresses * drive.watch.relief_pa;
}

bool watch_way(const DriveRow& drive, const ValidDrive& seen, const WayAsk& ask, double period_s,
               WayState& state) {
  if (!(drive.watch.way_m > 0.0) || !(period_s > 0.0)) {
    return false;
  }
  const double moved_m = state.begun ? seen.stroke_m - state.stroke_m : 0.0;
  state.stroke_m = seen.stroke_m;
  state.begun = true;
  const double asked_mps =
      follow(drive.answer.towards(ask.asked_mps), ask.asked_mps, period_s, state);
  if (ask.held) {
    return false;
  }
  const double band_mps = kWayBand * std::abs(asked_mps) + kWayCreeps * drive.watch.fastest_mps;
  double behind_m = period_s * (asked_mps - band_mps) - moved_m;
  double ahead_m = moved_m - period_s * (asked_mps + band_mps);
  if (presses(drive, seen, ask.asked_mps)) {
    double& short_m = ask.asked_mps > 0.0 ? behind_m : ahead_m;
    short_m = std::min(short_m, 0.0);
  }
  const double kept = 1.0 - std::min(1.0, period_s / kWayForget_s);
  state.behind_m = kept * std::max(0.0, state.behind_m + behind_m);
  state.ahead_m = kept * std::max(0.0, state.ahead_m + ahead_m);
  return std::max(state.behind_m, state.ahead_m) > drive.watch.way_m;
}

}  // namespace graben
