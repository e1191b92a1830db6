// SPDX-License-Identifier: Apache-2.0
#include "tests/timing/counts/section.hpp"

// Each a block of its own that nothing can be moved across or leave out.
extern "C" {
__attribute__((noinline)) void graben_count_begin() { asm volatile("" ::: "memory"); }
__attribute__((noinline)) void graben_count_end() { asm volatile("" ::: "memory"); }
}

namespace graben::timing {

void burn(std::uint32_t instructions) {
  constexpr std::uint32_t kPerRound = 2;
  std::uint32_t rounds = instructions / kPerRound;
  if (rounds == 0) {
    return;
  }
#if defined(__x86_64__)
  asm volatile("1: subl $1, %0\n\tjnz 1b" : "+r"(rounds)::"cc");
#elif defined(__aarch64__)
  asm volatile("1: subs %w0, %w0, #1\n\tb.ne 1b" : "+r"(rounds)::"cc");
#elif defined(__arm__)
  asm volatile("1: subs %0, %0, #1\n\tbne 1b" : "+r"(rounds)::"cc");
#else
#error "no loop of two instructions is known for this processor"
#endif
}

}  // namespace graben::timing
