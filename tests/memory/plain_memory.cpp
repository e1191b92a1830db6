// SPDX-License-Identifier: Apache-2.0
/// The C library's functions over bytes, as plain loops, for a static image of a machine with
/// Linux: glibc chooses its own when a process starts, by a pointer that no image shows. Theirs
/// need fewer instructions.

#include <cstddef>

extern "C" {

void* memcpy(void* to, const void* from, std::size_t count) {
  auto* const out = static_cast<unsigned char*>(to);
  const auto* const in = static_cast<const unsigned char*>(from);
  for (std::size_t n = 0; n < count; ++n) {
    out[n] = in[n];
  }
  return to;
}

void* memset(void* to, int value, std::size_t count) {
  auto* const out = static_cast<unsigned char*>(to);
  for (std::size_t n = 0; n < count; ++n) {
    out[n] = static_cast<unsigned char>(value);
  }
  return to;
}

void* memmove(void* to, const void* from, std::size_t count) {
  auto* const out = static_cast<unsigned char*>(to);
  const auto* const in = static_cast<const unsigned char*>(from);
  if (out < in) {
    return memcpy(to, from, count);
  }
  for (std::size_t n = count; n > 0; --n) {
    out[n - 1] = in[n - 1];
  }
  return to;
}

int memcmp(const void* one, const void* other, std::size_t count) {
  const auto* const left = static_cast<const unsigned char*>(one);
  const auto* const right = static_cast<const unsigned char*>(other);
  for (std::size_t n = 0; n < count; ++n) {
    if (left[n] != right[n]) {
      return left[n] < right[n] ? -1 : 1;
    }
  }
  return 0;
}

/// Where glibc's own functions find their stack overwritten, the process ends.
[[noreturn]] void __stack_chk_fail() { __builtin_trap(); }

}  // extern "C"
