#pragma once
/// Faults, and what keeps a controller from arming, in words.

#include "firmware/core/codes.hpp"
#include "firmware/signals/machine_signals.hpp"

namespace graben::runs {

/// "a stroke is missing", ...; "none" for kNone.
[[nodiscard]] const char* fault_words(Fault fault);

/// What a bit of MachineStatus::why_not_armed says; two of them say it of one kind of machine or
/// the other.
[[nodiscard]] const char* arm_block_words(ArmBlock block);

}  // namespace graben::runs
