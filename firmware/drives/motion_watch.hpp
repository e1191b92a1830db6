// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Checks that drives move as their spools let them, and that their pressures are those of a
/// machine in motion.

#include <array>

#include "firmware/core/fault_set.hpp"
#include "firmware/drives/drive_validation.hpp"
#include "firmware/drives/tuning.hpp"

namespace graben {

/// State of one drive's motion from cycle to cycle.
struct MotionState {
  int direction = 0;       ///< Where the spool lets the oil go; 0 while it is closed.
  double since_s = 0.0;    ///< Since it has been so.
  double anchor_m = 0.0;   ///< Furthest that the drive was allowed to come.
  double still_m = 0.0;    ///< Stroke at its last change.
  double unmoved_m = 0.0;  ///< What it was asked to move since then, and of late.
};

/// kUncommandedMotion: with its spool closed a drive leaves the place where it came to rest
/// (`rest_s`), or it runs back against its open spool, by more than `uncommanded_m`. Within 3 % of
/// the travel before its dead band's end a spool may let it go its way. What oil gives
/// way under a load is less; leakage, which creeps, is forgotten within seconds.
///
/// kStrokeStuck: with its spool open in the direction asked for, a stroke stands still to within
/// its resolution while `stuck_m` were asked of it. What was asked is forgotten within seconds too:
/// held against leakage for minutes, a cylinder is not stuck.
///
/// `asked_mps` is what the spools were opened for in the last cycle; the states go on by a cycle.
[[nodiscard]] FaultSet watch_motion(DriveRows drives, Span<const ValidDrive> seen,
                                    Span<const double> asked_mps, double period_s,
                                    Span<MotionState> state);

/// State of one pressure sensor from cycle to cycle.
struct PressureState {
  double last_pa = 0.0;
  double stroke_m = 0.0;  ///< Up to which `way_m` is counted.
  double way_m = 0.0;     ///< To and fro, since its last change.
  double at_rail_s = 0.0;
};

/// Of one drive: cap and rod side.
using PressurePair = std::array<PressureState, 2>;

struct PressureBounds {
  double empty_pa = kEmptyChamber_pa;
  double rail_pa = 0.0;  ///< From there on it is at its end.
};

/// True where a pressure is wrong; its drive's load then is not known any more. At its rail: at or
/// above `pressure_rail_pa` for 0.3 s, longer than any peak that a port relief lets stand. Stuck:
/// the same number, to the last bit and above what an empty chamber shows, while its drive moves
/// by 0.06 m, to and fro. Wrong until it changes. A drive whose load is not known is not looked at.
[[nodiscard]] bool watch_pressures(DriveRows drives, double empty_pa, Span<ValidDrive> seen,
                                   double period_s, Span<PressurePair> state);

}  // namespace graben
