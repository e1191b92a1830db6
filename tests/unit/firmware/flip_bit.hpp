// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a particle or a bad cell does to memory.

#include <cstddef>
#include <type_traits>

namespace graben::test {

/// Turns over one bit, counted from the lowest of the byte there.
inline void flip_bit_at(void* memory, std::size_t bit) {
  auto* bytes = static_cast<unsigned char*>(memory);
  bytes[bit / 8] = static_cast<unsigned char>(bytes[bit / 8] ^ (1U << (bit % 8)));
}

/// Turns over one bit of an object, counted from its first byte's lowest, and round again after its
/// last.
template <class T>
void flip_bit(T& object, std::size_t bit) {
  static_assert(std::is_trivially_copyable_v<T>);
  flip_bit_at(&object, bit % (8 * sizeof(T)));
}

}  // namespace graben::test
