// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Corrections change sign many times a second where a load varies. A spool that followed each
/// would cross its dead band all the time: wear, heat, and oil that is late. So it waits at the
/// edge of its dead band, on the side where it was, with its bypass closed.

#include "firmware/drives/learnt/learnt_valve.hpp"

namespace graben {

/// State of one drive from cycle to cycle.
struct ParkingState {
  int side = 0;               ///< To which its spool was open last; 0: to none yet.
  double reversals_ps = 0.0;  ///< Changes of side a second, of late.
  bool parked = false;
};

/// A cycle on; true: the drive is to stand, its spool waits. That is where its correction alone
/// would reverse it, for less than 40 mm/s at one reversal a second, in proportion, and never for
/// more. Where the path itself wants the other side with at least 3 mm/s, it goes there at once. A
/// slow path turns as often and wants less: `pace`, 0 .. 1, is its share of one that is fast, by
/// which those 3 mm/s are less, and by its root the others.
[[nodiscard]] bool park(double wanted_mps, double corrected_mps, double pace, double period_s,
                        ParkingState& state);

/// Signed duty, -1 .. 1, just within the dead band as it turned out to be.
[[nodiscard]] double parked_duty(const DriveRow& drive, const LearntValve& valve, int side);

}  // namespace graben
