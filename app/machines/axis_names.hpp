#pragma once
/// The axes' names, in their order: as keys of a profile and in what a user reads.

#include <array>

#include "firmware/signals/excavator_signals.hpp"

namespace graben::machines {

inline constexpr std::array<const char*, kAxisCount> kAxisNames = {"boom", "arm", "bucket"};

}  // namespace graben::machines
