// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Counts the heap's use, to prove on the deployed binary that an armed controller makes none.
///
/// Linked as an object into an executable (graben_allocation_counter) it takes the place of malloc
/// and its kin for the whole process, operator new and the C library's own calls included; the
/// work is done by glibc as before. Cost: one relaxed atomic increment a call.

#include <cstdint>

namespace graben {

/// False where the sanitizers own the heap, or the C library is not glibc: the count stays 0 then.
[[nodiscard]] bool allocations_are_counted();

/// Calls that asked for memory since the process began; freeing is not counted.
[[nodiscard]] std::uint64_t allocation_count();

}  // namespace graben
