// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the plugin counts: everything between these two calls.

#include <cstdint>

extern "C" {
void graben_count_begin();
void graben_count_end();
}

namespace graben::timing {

/// Executes so many instructions and does nothing: for the canary. Within 2 of it.
void burn(std::uint32_t instructions);

}  // namespace graben::timing
