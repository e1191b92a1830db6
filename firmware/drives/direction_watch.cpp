// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/direction_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/oil_lengths.hpp"
#include "firmware/drives/tuning.hpp"

namespace graben {
namespace {

int side_of(const DriveRow& drive, double spool_ratio) {
  if (std::abs(spool_ratio) <= drive.answer.towards(spool_ratio).edge()) {
    return 0;
  }
  return spool_ratio > 0.0 ? 1 : -1;
}

/// For certain. A platform swings back on the oil that a closed spool has shut in.
bool is_open(const DriveRow& drive, double spool_ratio) {
  return std::abs(spool_ratio) > drive.answer.towards(spool_ratio).edge() + kDirectionEdgeBand;
}

/// Its own oil pushes it against its spool.
bool pushed_back(const DriveRow& drive, const ValidDrive& seen, int side) {
  const double push_n =
      drive.extend_area_m2 * seen.cap_pressure_pa - drive.retract_area_m2 * seen.rod_pressure_pa;
  return side * push_n < -kDirectionZero_pa * drive.extend_area_m2;
}

/// The pressure that pushes it against its spool.
void feel_push(double pushes_pa, double period_s, DirectionState& state) {
  state.pushed_pa += kFlowPressureShare * (pushes_pa - state.pushed_pa);
  const double lets_off_pa = std::max(0.0, state.most_pushed_pa - state.pushed_pa);
  const double kept = 1.0 - std::min(1.0, period_s / kDirectionSpringFor_s);
  state.most_pushed_pa = state.pushed_pa + kept * lets_off_pa;
}

/// What the oil that pushes it has moved it by letting off. A motor's hangs on long hoses that
/// hold little.
double sprung_m(const DriveRow& drive, const ValidDrive& seen, const DirectionState& state) {
  const OilLengths oil = oil_lengths(drive, seen.stroke_m);
  const double oil_m = state.side > 0 ? oil.rod_m : oil.cap_m;
  const double share = (state.most_pushed_pa - state.pushed_pa) / kFlowSoftest_pa;
  return drive.control.has_end_stops ? share * oil_m : 0.0;
}

void follow(const DriveRow& drive, const ValidDrive& seen, double period_s, DirectionState& state) {
  const int side = side_of(drive, seen.spool_ratio);
  const double pushes_pa = side > 0 ? seen.rod_pressure_pa : seen.cap_pressure_pa;
  if (side == 0 || side != state.side) {
    state = {side, false, seen.stroke_m, 0.0, pushes_pa, pushes_pa};
    return;
  }
  feel_push(pushes_pa, period_s, state);
  if (!seen.stroke_is_new) {
    return;
  }
  const double with_m = side * (seen.stroke_m - state.stroke_m);
  state.stroke_m = seen.stroke_m;
  state.turned = state.turned || with_m >= 0.0;
  if (with_m > 0.0) {
    state.wrong_m = std::max(-kDirectionCredit * drive.watch.wrong_m, state.wrong_m - with_m);
  } else if (state.turned && is_open(drive, seen.spool_ratio) && pushed_back(drive, seen, side)) {
    state.wrong_m -= with_m;
  }
}

}  // namespace

FaultSet watch_direction(DriveRows drives, Span<const ValidDrive> seen, double period_s,
                         Span<DirectionState> state) {
  FaultSet faults;
  for (int i = 0; i < drives.count(); ++i) {
    const DriveWatch& bounds = drives[i].watch;
    if (bounds.wrong_m == 0.0 || !seen[i].load_known) {
      state[i] = {};
      continue;
    }
    follow(drives[i], seen[i], period_s, state[i]);
    if (state[i].wrong_m - sprung_m(drives[i], seen[i], state[i]) > bounds.wrong_m) {
      faults.add(Fault::kWrongDirection);
    }
  }
  return faults;
}

}  // namespace graben
