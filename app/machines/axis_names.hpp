#pragma once
/// The axes' names, in their order: as keys of a profile and in what a user reads.

#include <array>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

inline constexpr std::array<const char*, kAxisCount> kAxisNames = {"boom", "arm", "bucket"};
/// With the swing, in the order of DriveVector.
inline constexpr std::array<const char*, kDriveCount> kDriveNames = {"boom", "arm", "bucket",
                                                                     "swing"};

}  // namespace graben::machines
