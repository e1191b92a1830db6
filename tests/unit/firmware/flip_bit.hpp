// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a particle or a bad cell does to memory.

#include <array>
#include <cstring>
#include <type_traits>

namespace graben::test {

/// Turns over one bit of an object, counted from its first byte's lowest, and round again after its
/// last.
template <class T>
void flip_bit(T& object, std::size_t bit) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::array<unsigned char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), &object, sizeof(T));
  bit %= 8 * sizeof(T);
  bytes[bit / 8] = static_cast<unsigned char>(bytes[bit / 8] ^ (1U << (bit % 8)));
  std::memcpy(static_cast<void*>(&object), bytes.data(), sizeof(T));
}

}  // namespace graben::test
