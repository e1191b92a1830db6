// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A drive that its oil drives against its spool: hoses, ports or a valve's coils changed over.

#include "firmware/core/fault_set.hpp"
#include "firmware/drives/drive_validation.hpp"

namespace graben {

/// State of one drive from cycle to cycle.
struct DirectionState {
  int side = 0;  ///< Where the spool is open to; 0 while it is closed.
  /// Since the spool opened to this side the drive has stood or gone with it: it does not coast.
  bool turned = false;
  double stroke_m = 0.0;
  double wrong_m = 0.0;         ///< Gone against the spool, driven by its own oil.
  double pushed_pa = 0.0;       ///< Of the side that pushes it so, low-passed ...
  double most_pushed_pa = 0.0;  ///< ... and the most of late.
};

/// kWrongDirection: against its open spool the drive goes `wrong_m`, and the pressures of its sides
/// push it that way. A load that pushes a drive back meets oil that holds against it; a drive that
/// coasts is braked by its oil. What it has gone with the spool since that opened is set off, up to
/// four times the bound: a drive that shakes on soft oil swings back by no more. A cylinder's oil
/// is a spring: what the side that pushes it has let off of late moved it that far by itself.
///
/// Seen only where the load does not weigh more than the oil: a boom that sinks instead of rising
/// is held up by its oil either way, and is left to watch_flow. A drive whose pressures are not
/// known is not checked.
[[nodiscard]] FaultSet watch_direction(DriveRows drives, Span<const ValidDrive> seen,
                                       double period_s, Span<DirectionState> state);

}  // namespace graben
