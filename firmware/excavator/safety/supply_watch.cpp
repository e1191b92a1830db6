// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/safety/supply_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/safety/tuning.hpp"
#include "firmware/machine/drive_bank.hpp"

namespace graben {
namespace {

bool is_starved(const DriveRow& drive, const ValidDrive& seen, double asked_mps, double speed_mps) {
  if (!seen.load_known || !(std::abs(asked_mps) > kSupplyLeastAsked_mps)) {
    return false;
  }
  const double way = std::copysign(1.0, asked_mps);
  const double open_from = drive.answer.towards(asked_mps).edge() + kSupplyOpenBeyond;
  const double fed_pa = way > 0.0 ? seen.cap_pressure_pa : seen.rod_pressure_pa;
  return way * seen.spool_ratio > open_from && fed_pa < kSupplyNone_pa &&
         way * speed_mps < kSupplyStarvedShare * std::abs(asked_mps);
}

}  // namespace

bool watch_supply(const DriveRow& drive, const ValidDrive& seen, double asked_mps, double period_s,
                  SupplyState& state) {
  if (!(period_s > 0.0)) {
    return false;
  }
  const double moved_mps = state.begun ? (seen.stroke_m - state.stroke_m) / period_s : 0.0;
  state.stroke_m = seen.stroke_m;
  state.begun = true;
  const double newest = period_s / (period_s + kSupplySpeed_s);
  state.speed_mps += newest * (moved_mps - state.speed_mps);
  state.asked_mps += newest * (asked_mps - state.asked_mps);
  const double late_s =
      drive.watch.senses_spool ? drive.watch.spool_late_s : spool_arrives_s(drive);
  const double most_s = kSupplyStarved_s + late_s;
  const double change_s =
      is_starved(drive, seen, asked_mps, state.speed_mps) ? period_s : -period_s;
  state.starved_s = std::clamp(state.starved_s + change_s, 0.0, most_s + period_s);
  return state.starved_s > most_s;
}

bool watch_supplies(DriveRows drives, Span<const ValidDrive> seen, Span<const double> asked_mps,
                    bool held, double period_s, SuppliesState& state) {
  bool starved = false;
  bool stand = !held;
  int asked = 0;
  double behind_mps = 0.0;
  double answers_s = 0.0;
  for (int i = 0; i < drives.count(); ++i) {
    SupplyState& drive = state.drive[static_cast<unsigned>(i)];
    starved = watch_supply(drives[i], seen[i], asked_mps[i], period_s, drive) || starved;
    const double most_mps = std::abs(drive.asked_mps);
    if (most_mps > kSupplyLeastAsked_mps) {
      const double along_mps = std::copysign(1.0, drive.asked_mps) * drive.speed_mps;
      stand = stand && along_mps < kSupplyStandsShare * most_mps;
      // One that goes is fed. One that stands tells nothing under an open bypass, or where its load
      // is not known.
      if (!seen[i].load_known || drives[i].spool.bypass_closes_at.is_gradual()) {
        continue;
      }
      ++asked;
      behind_mps = std::max(behind_mps, most_mps - along_mps);
      const SpoolAnswer& answer = drives[i].answer.towards(drive.asked_mps);
      answers_s = std::max(answers_s, answer.dead_time_s + answer.lag_s);
    }
  }
  // One alone may have a sensor that stands.
  if (!stand || asked < 2) {
    state.unmoved_m = 0.0;
    state.stood_s = 0.0;
    return starved;
  }
  state.unmoved_m += period_s * behind_mps;
  state.stood_s += period_s;
  return starved ||
         (state.unmoved_m > kSupplyUnmoved_m && state.stood_s > kSupplyStarved_s + answers_s);
}

}  // namespace graben
