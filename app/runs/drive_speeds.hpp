// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Speeds of the drives, each alone, by what is known of a machine.

#include "app/identify/machine/estimate.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::runs {

/// Where a side's speed counts as found, of full.
inline constexpr double kSpeedFound = 0.03;

/// Sides of the cylinders, two each.
struct SpeedErrors {
  double most = 0.0;  ///< Of the sides that were driven.
  int within = 0;     ///< Sides that were driven and are within kSpeedFound.
  int sides = 0;
};

/// Largest difference of a cylinder's steady speed between two estimates of one machine, as a share
/// of `truth`'s speed at full duty: of each side, at each duty that `found` has seen driven. Each
/// drive is alone, at rated engine speed and the swash of a dig, with 5 MPa in
/// the chamber that is fed and nothing in the other.
[[nodiscard]] SpeedErrors speed_errors(const ExcavatorProfile& profile,
                                       const identify::MachineEstimate& found,
                                       const identify::MachineEstimate& truth);

/// The same of one side of the swing.
[[nodiscard]] double swing_speed_error(const ExcavatorProfile& profile,
                                       const identify::MachineEstimate& found,
                                       const identify::MachineEstimate& truth, bool left);

}  // namespace graben::runs
