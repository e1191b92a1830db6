// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A drive's stroke against what was asked of it: a sensor that stands, shows half or twice of what
/// its drive does, or drifts.

#include <array>

#include "firmware/core/fault_set.hpp"
#include "firmware/drives/drive_validation.hpp"

namespace graben {

/// State of one drive from cycle to cycle.
struct WayState {
  std::array<double, 2> late_mps{};  ///< What was asked, behind the drive's lag.
  double stroke_m = 0.0;
  double behind_m = 0.0;  ///< That it fell short of the least that was asked ...
  double ahead_m = 0.0;   ///< ... and went beyond the most.
  bool begun = false;
};

/// What is asked of a drive, and whether its load holds it or throws it.
struct WayAsk {
  double asked_mps = 0.0;  ///< Of its spool in the last cycle, with feedback.
  bool held = false;
};

/// The side that is fed has a third of its line's relief or more: its load may slow the drive,
/// whatever its valve lets through. A drive whose pressures or whose relief are not known never
/// presses.
[[nodiscard]] bool presses(const DriveRow& drive, const ValidDrive& seen, double asked_mps);

/// True: the stroke is off by more than `way_m` from what was asked; a row with 0 is not looked at.
/// Feedback does with the drive what the sensor hides: where a sensor shows half, twice as much is
/// asked. So no valve, spool or pressure has to be known. Asked speeds count by 20 % more and less,
/// as far as a valve may be off that is learnt, and by 1 % of the drive's fastest for what an
/// opening near its dead band may do; what is within that wears the difference off, as do 6 s. A
/// drive that presses may fall short, and be pushed back; one whose load holds it is left out.
[[nodiscard]] bool watch_way(const DriveRow& drive, const ValidDrive& seen, const WayAsk& ask,
                             double period_s, WayState& state);

}  // namespace graben
