// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Loads of a machine whose pressures nobody measures.

#include <array>

#include "firmware/drives/drive_servo.hpp"
#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"

namespace graben {

/// Chamber pressures that hold the links up where they are, by the masses of `[oil]`, with nothing
/// in the bucket and nothing against it: the likely load. 0 where the masses or the pose are not
/// known, and of the swing.
[[nodiscard]] std::array<LoadState, kDriveCount> links_alone(const ExcavatorProfile& profile,
                                                             const KinematicState& now);

/// The same with the worst that a drive is taken to push against on the way that it is to go: its
/// fed side has at least `bus.worst_load_ratio` of its pump's relief. A drive that is to stand
/// keeps its likely load.
[[nodiscard]] std::array<LoadState, kDriveCount> worst_loads(
    const ExcavatorProfile& profile, DriveRows drives,
    const std::array<LoadState, kDriveCount>& likely, const DriveVector& wanted_mps);

}  // namespace graben
