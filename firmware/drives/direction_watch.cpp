// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/direction_watch.hpp"

#include <algorithm>
#include <cmath>

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

void follow(const DriveRow& drive, const ValidDrive& seen, DirectionState& state) {
  const int side = side_of(drive, seen.spool_ratio);
  if (side == 0 || side != state.side) {
    state = {side, false, seen.stroke_m, 0.0};
    return;
  }
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

FaultSet watch_direction(DriveRows drives, Span<const ValidDrive> seen,
                         Span<DirectionState> state) {
  FaultSet faults;
  for (int i = 0; i < drives.count(); ++i) {
    const DriveWatch& bounds = drives[i].watch;
    if (bounds.wrong_m == 0.0 || !seen[i].load_known) {
      state[i] = {};
      continue;
    }
    follow(drives[i], seen[i], state[i]);
    if (state[i].wrong_m > bounds.wrong_m) {
      faults.add(Fault::kWrongDirection);
    }
  }
  return faults;
}

}  // namespace graben
