// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How much of the stack a run takes, by paint: of programs for the Cortex-M7.

#include <cstdint>

namespace graben::memory {

inline constexpr std::uint32_t kPaint = 0xA5C33C5AU;
inline constexpr int kPaintedWords = 8192;

/// Paints what lies below the caller's frame, whose stack pointer it gives.
[[gnu::always_inline]] inline volatile std::uint32_t* paint_stack() {
  volatile std::uint32_t* top = nullptr;
  asm volatile("mov %0, sp" : "=r"(top));
  for (int word = 1; word <= kPaintedWords; ++word) {
    *(top - word) = kPaint;
  }
  return top;
}

/// Bytes below `top` that were taken since.
inline int taken_below(const volatile std::uint32_t* top) {
  int untouched = 0;
  while (untouched < kPaintedWords && *(top - kPaintedWords + untouched) == kPaint) {
    ++untouched;
  }
  return static_cast<int>(sizeof(std::uint32_t)) * (kPaintedWords - untouched);
}

}  // namespace graben::memory
