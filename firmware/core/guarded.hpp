// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A stored value with its complement: a bit that flips in memory is found before it is used.

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace graben {

/// As constructed or assigned it is intact; a change of any bit of either copy is not.
template <class T>
class Guarded {
  // Padding would not be copied along and then differ from its complement.
  static_assert(std::is_floating_point_v<T> || std::has_unique_object_representations_v<T>);

 public:
  Guarded() : Guarded(T{}) {}
  // NOLINTNEXTLINE(google-explicit-constructor): it is the value, kept twice.
  Guarded(const T& value) : value_(value) {
    complement_ = bytes();
    for (unsigned char& byte : complement_) {
      byte = static_cast<unsigned char>(~byte);
    }
  }

  [[nodiscard]] bool intact() const {
    const Bytes plain = bytes();
    unsigned differing = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      differing |= 0xFFU ^ plain[i] ^ complement_[i];
    }
    return differing == 0;
  }
  [[nodiscard]] const T& value() const { return value_; }

 private:
  using Bytes = std::array<unsigned char, sizeof(T)>;

  [[nodiscard]] Bytes bytes() const {
    Bytes plain{};
    std::memcpy(plain.data(), &value_, sizeof(T));
    return plain;
  }

  T value_;
  Bytes complement_{};
};

}  // namespace graben
