// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Names of axes, drives and control laws, in their order: in a profile and in what a user reads.

#include <array>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

inline constexpr std::array<const char*, kAxisCount> kAxisNames = {"boom", "arm", "bucket"};
/// With the swing, in the order of DriveVector.
inline constexpr std::array<const char*, kDriveCount> kDriveNames = {"boom", "arm", "bucket",
                                                                     "swing"};
/// In the order of ControlLaw.
inline constexpr std::array<const char*, 3> kLawNames = {"servo", "oil", "kim"};

}  // namespace graben::machines
