// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A set of fault codes: several can be there at once.

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/codes.hpp"

namespace graben {

/// Bit n of its words stands for the Fault of number n; kNone is never in it.
class FaultSet {
 public:
  /// Numbers that it can hold are below that. [-; size: two words]
  static constexpr int kNumbers = 128;
  static_assert(kFaultCount <= kNumbers);

  constexpr void add(Fault fault) { words_[word(fault)] |= bit(fault); }
  constexpr void add(const FaultSet& other) {
    words_[0] |= other.words_[0];
    words_[1] |= other.words_[1];
  }
  constexpr void remove(Fault fault) { words_[word(fault)] &= ~bit(fault); }
  [[nodiscard]] constexpr bool has(Fault fault) const {
    return (words_[word(fault)] & bit(fault)) != 0;
  }
  [[nodiscard]] constexpr bool has_any(const FaultSet& of) const {
    return ((words_[0] & of.words_[0]) | (words_[1] & of.words_[1])) != 0;
  }
  /// How many are in it.
  [[nodiscard]] constexpr int count() const { return ones(words_[0]) + ones(words_[1]); }
  [[nodiscard]] constexpr bool empty() const { return (words_[0] | words_[1]) == 0; }
  [[nodiscard]] constexpr bool operator==(const FaultSet& other) const {
    return words_[0] == other.words_[0] && words_[1] == other.words_[1];
  }

  /// The one with the lowest number; kNone if there is none.
  [[nodiscard]] constexpr Fault first() const { return after(Fault::kNone); }
  /// The one with the next higher number than `fault`; kNone if there is none.
  [[nodiscard]] constexpr Fault after(Fault fault) const {
    return static_cast<Fault>(next(static_cast<int>(fault), kFaultCount));
  }
  /// The next higher number than `number`, of those below `count`; 0 if there is none.
  [[nodiscard]] constexpr int next(int number, int count) const {
    int code = number + 1;
    if (code < kWordBits) {
      const int found = lowest(words_[0] >> code, code, count);
      if (found != 0) {
        return found;
      }
      code = kWordBits;
    }
    return code < kNumbers ? lowest(words_[1] >> (code - kWordBits), code, count) : 0;
  }

 private:
  static constexpr int kWordBits = 64;  ///< In one word. [-; size: its type]

  /// Number of the lowest bit, the last one being that of `code`; 0 if it is not below `count`.
  static constexpr int lowest(std::uint64_t rest, int code, int count) {
    const int found = rest == 0 ? count : code + zeros_below(rest);
    return found < count ? found : 0;
  }
  /// Of what is not 0; by halves, which every processor of ours has an instruction for.
  static constexpr int zeros_below(std::uint64_t word) {
    const auto low = static_cast<std::uint32_t>(word);
    return low != 0 ? __builtin_ctz(low)
                    : kWordBits / 2 + __builtin_ctz(static_cast<std::uint32_t>(word >> 32U));
  }
  /// Bits that are set: sums of pairs, of fours, of bytes, and the bytes' sum in the highest of
  /// them.
  static constexpr int ones(std::uint64_t word) {
    word -= (word >> 1U) & 0x5555555555555555U;
    word = (word & 0x3333333333333333U) + ((word >> 2U) & 0x3333333333333333U);
    word = (word + (word >> 4U)) & 0x0F0F0F0F0F0F0F0FU;
    return static_cast<int>((word * 0x0101010101010101U) >> 56U);
  }
  static constexpr std::size_t word(Fault fault) {
    return static_cast<std::size_t>(fault) / kWordBits % 2U;
  }
  /// In its word; none of a number that has no place.
  static constexpr std::uint64_t bit(Fault fault) {
    const auto number = static_cast<int>(fault);
    return fault == Fault::kNone || number >= kNumbers ? 0
                                                       : std::uint64_t{1} << (number % kWordBits);
  }

  std::array<std::uint64_t, 2> words_{};
};

}  // namespace graben
