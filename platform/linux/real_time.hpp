#pragma once
/// What an ordinary process needs to become one that keeps deadlines. Order: tune_heap,
/// lock_memory, prefault_stack, then CPU and priority, all before the first cycle. Each step that
/// can fail returns what is missing, in words, and has then changed nothing.

#include <cstdint>

#include "platform/linux/error_text.hpp"

namespace graben {

/// The heap keeps what it was given: memory once faulted in stays so, and nothing is mapped or
/// unmapped behind our back. Before other allocations, best of all first in main().
[[nodiscard]] ErrorText tune_heap();

/// Every page of the process, present and to come, stays in memory.
[[nodiscard]] ErrorText lock_memory();

/// Touches 64 KiB of stack below the caller's, so that no cycle is the first one there.
void prefault_stack();

/// Runs the calling thread on this CPU only.
[[nodiscard]] ErrorText pin_to_cpu(int cpu);

/// SCHED_FIFO at `priority`, 1 .. 99, for the calling thread; not for processes it starts.
[[nodiscard]] ErrorText set_fifo_priority(int priority);

/// Page faults of the calling thread since it began.
struct PageFaults {
  std::int64_t minor = 0;  ///< Served from memory.
  std::int64_t major = 0;  ///< Waited for a disk.
};
[[nodiscard]] PageFaults page_faults();

/// What came up since `mark`, both kinds together.
[[nodiscard]] constexpr std::int64_t faults_since(const PageFaults& mark, const PageFaults& now) {
  return (now.minor - mark.minor) + (now.major - mark.major);
}

}  // namespace graben
