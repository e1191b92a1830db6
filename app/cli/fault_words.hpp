#pragma once
/// Faults in words.

#include "firmware/core/codes.hpp"

namespace graben::cli {

/// "a stroke is missing", ...; "none" for kNone.
[[nodiscard]] const char* fault_words(Fault fault);

}  // namespace graben::cli
