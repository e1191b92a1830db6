// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A process that keeps deadlines and ends in order: errors without the heap, SIGTERM and
/// SIGINT as a flag, real time. Order: tune_heap, lock_memory, prefault_stack, then CPU and
/// priority, all before the first cycle. Each step that can fail returns what is missing, as text,
/// and has then changed nothing.

#include <array>
#include <cstdint>

namespace graben {

/// A short text; empty when nothing went wrong. One that is too long is cut.
class ErrorText {
 public:
  ErrorText() = default;

  [[nodiscard]] bool empty() const { return text_[0] == '\0'; }
  [[nodiscard]] const char* c_str() const { return text_.data(); }

  /// As printf.
  void set(const char* format, ...) __attribute__((format(printf, 2, 3)));
  void clear() { text_[0] = '\0'; }

 private:
  std::array<char, 240> text_{};
};

/// The C library's words for an errno, always in English and never from the heap.
[[nodiscard]] const char* error_words(int error_number);

/// From here on the first SIGTERM and the first SIGINT only set a flag. A second one of the same
/// kind kills, for a process that no longer looks at the flag.
[[nodiscard]] ErrorText catch_stop_signals();

[[nodiscard]] bool stop_requested();
/// The signal that asked for it last, as SIGINT; 0: none has.
[[nodiscard]] int stop_signal();
/// From anywhere, a signal handler too.
void request_stop();

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
