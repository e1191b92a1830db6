// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Drives that stand open to a pump that gives nothing: its engine stands, whatever its speed says.

#include <array>

#include "firmware/drives/drive_validation.hpp"
#include "firmware/excavator/excavator_signals.hpp"

namespace graben {

/// State of one drive from cycle to cycle.
struct SupplyState {
  double stroke_m = 0.0;
  double speed_mps = 0.0;  ///< Low-passed.
  double starved_s =
      0.0;  ///< That it has stood, open and unfed, less the time in which it did not.
  double asked_mps = 0.0;  ///< Low-passed.
  bool begun = false;
};

/// True: the drive gets nothing. Its spool is open, beyond where its dead band may end, to the side
/// to which it was asked; it does not do a third of that; and the side that is fed has no pressure,
/// which it would have of any line that has one: for 0.3 s, and as long as a spool may be late that
/// is not measured. What its load or another drive moves is no sign of its pump. A drive whose
/// pressures are not known is not looked at. The state goes on by a cycle.
[[nodiscard]] bool watch_supply(const DriveRow& drive, const ValidDrive& seen, double asked_mps,
                                double period_s, SupplyState& state);

/// Of all drives.
struct SuppliesState {
  std::array<SupplyState, kDriveCount> drive{};
  /// Way that the one that was farthest behind was asked, and did not go, since any of them went.
  double unmoved_m = 0.0;
  double stood_s = 0.0;  ///< Time since then.
};

/// True: some drive gets nothing, or all that are asked, two or more, stand and are pushed back
/// until the one that is farthest behind is so by 25 mm, for 0.3 s and as long as a valve takes to
/// answer: pumps that feed any would move one. A drive whose load is not known, or whose spool
/// leaves a bypass open, is none of the two. `held`: a load holds a drive against its pump, and how
/// they stand says nothing.
[[nodiscard]] bool watch_supplies(DriveRows drives, Span<const ValidDrive> seen,
                                  Span<const double> asked_mps, bool held, double period_s,
                                  SuppliesState& state);

}  // namespace graben
