// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A view of values that somebody else keeps: one a drive, one a pump.

#include <array>
#include <cstddef>

namespace graben {

/// Does not own what it shows; lives no longer than that. Indices are the caller's duty.
template <class T>
class Span {
 public:
  constexpr Span(T* first, int count) : first_(first), count_(count) {}
  template <class Value, std::size_t kSize>
  // NOLINTNEXTLINE(google-explicit-constructor): an array is one.
  constexpr Span(std::array<Value, kSize>& all)
      : first_(all.data()), count_(static_cast<int>(kSize)) {}
  template <class Value, std::size_t kSize>
  // NOLINTNEXTLINE(google-explicit-constructor)
  constexpr Span(const std::array<Value, kSize>& all)
      : first_(all.data()), count_(static_cast<int>(kSize)) {}
  // NOLINTNEXTLINE(google-explicit-constructor): what may be written may be read.
  constexpr operator Span<const T>() const { return {first_, count_}; }

  [[nodiscard]] constexpr int count() const { return count_; }
  [[nodiscard]] constexpr T& operator[](int i) const { return first_[i]; }
  [[nodiscard]] constexpr T* begin() const { return first_; }
  [[nodiscard]] constexpr T* end() const { return first_ + count_; }

 private:
  T* first_;
  int count_;
};

}  // namespace graben
