// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whole numbers of 64 bits, as times are, where a processor has registers of 32.

#include <cstdint>

namespace graben {

/// The nearest double of a whole number, made of two halves: what as_double() is where a library
/// would do it, larger and slower.
[[nodiscard]] constexpr double double_by_halves(std::int64_t number) {
  /// Of one bit of the upper half. [-; derived: 2^32]
  constexpr double kUpperHalf = 4294967296.0;
  // Both halves are exact, so that the sum alone rounds.
  return static_cast<double>(static_cast<std::int32_t>(number >> 32U)) * kUpperHalf +
         static_cast<double>(static_cast<std::uint32_t>(number));
}

/// `number / by`, rounded to 0, of a number below 2^53; beyond that it may be off by its last bits.
[[nodiscard]] constexpr std::int64_t quotient_by_double(std::int64_t number, std::int32_t by) {
  return static_cast<std::int64_t>(double_by_halves(number) / static_cast<double>(by));
}

/// Whether a register holds 64 bits: a processor's own instructions are the cheapest
/// then. [-; derived: size of a pointer]
inline constexpr bool kWideRegisters = sizeof(void*) >= sizeof(std::int64_t);

[[nodiscard]] constexpr double as_double(std::int64_t number) {
  return kWideRegisters ? static_cast<double>(number) : double_by_halves(number);
}
/// As quotient_by_double.
[[nodiscard]] constexpr std::int64_t quotient(std::int64_t number, std::int32_t by) {
  return kWideRegisters ? number / by : quotient_by_double(number, by);
}

}  // namespace graben
