// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A set of fault codes: several can be there at once.

#include <cstdint>

#include "firmware/core/codes.hpp"

namespace graben {

/// Bit n stands for the Fault of number n; kNone is never in it.
class FaultSet {
 public:
  constexpr void add(Fault fault) { bits_ |= bit(fault); }
  constexpr void add(const FaultSet& other) { bits_ |= other.bits_; }
  constexpr void remove(Fault fault) { bits_ &= ~bit(fault); }
  [[nodiscard]] constexpr bool has(Fault fault) const { return (bits_ & bit(fault)) != 0; }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  [[nodiscard]] constexpr std::uint64_t bits() const { return bits_; }

  /// The one with the lowest number; kNone if there is none.
  [[nodiscard]] constexpr Fault first() const { return after(Fault::kNone); }
  /// The one with the next higher number than `fault`; kNone if there is none.
  [[nodiscard]] constexpr Fault after(Fault fault) const {
    int code = static_cast<int>(fault) + 1;
    // Nearly always there is none.
    for (std::uint64_t rest = bits_ >> code; rest != 0 && code < kFaultCount; rest >>= 1U, ++code) {
      if ((rest & 1U) != 0) {
        return static_cast<Fault>(code);
      }
    }
    return Fault::kNone;
  }

 private:
  static constexpr std::uint64_t bit(Fault fault) {
    return fault == Fault::kNone ? 0 : std::uint64_t{1} << static_cast<unsigned>(fault);
  }
  std::uint64_t bits_ = 0;
};

}  // namespace graben
