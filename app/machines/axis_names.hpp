// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Names of axes, drives and control laws, in their order: in a profile and in what a user reads.

#include <array>
#include <string>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

inline constexpr std::array<const char*, kAxisCount> kAxisNames = {"boom", "arm", "bucket"};
/// With the swing, in the order of DriveVector.
inline constexpr std::array<const char*, kDriveCount> kDriveNames = {"boom", "arm", "bucket",
                                                                     "swing"};
/// Keys of a drive's sides, in the order extend, retract; and as a reader is told those of the
/// swing.
inline constexpr std::array<const char*, 2> kSideNames = {"extend", "retract"};
inline constexpr std::array<const char*, 2> kSwingSideNames = {"left", "right"};

/// "extend", "left".
[[nodiscard]] inline const char* side_word(int drive, bool extends) {
  return (drive == kSwing ? kSwingSideNames : kSideNames)[extends ? 0 : 1];
}
/// "boom, extend", "swing, left": a side as tables name it.
[[nodiscard]] inline std::string side_name(int drive, bool extends) {
  return std::string(kDriveNames[static_cast<unsigned>(drive)]) + ", " + side_word(drive, extends);
}

/// In the order of ControlLaw.
inline constexpr std::array<const char*, 3> kLawNames = {"servo", "oil", "kim"};

}  // namespace graben::machines
