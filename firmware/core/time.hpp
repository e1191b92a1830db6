// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Time as the core sees it: an argument, never a clock.

#include <cstdint>

#include "firmware/core/tuning.hpp"

namespace graben {

/// Microseconds since any fixed instant; only differences count. Signed, so that differences are
/// too.
using TimeUs = std::int64_t;

/// Microseconds of a millisecond. [us; standard: SI prefixes]
inline constexpr TimeUs kMillisecondUs = 1000;
/// Microseconds of a second. [us; standard: SI prefixes]
inline constexpr TimeUs kSecondUs = 1'000'000;

/// Whole cycles since the last one: a command that stood for longer, as the next one came late, has
/// been under way as often. 1 to kMostCyclesLate, and 1 after a stall: what that stops does not
/// catch up.
[[nodiscard]] constexpr int cycles_in(double elapsed_s) {
  const int cycles = static_cast<int>(elapsed_s / kCyclePeriod_s + 0.5);
  return cycles < 1 || cycles > kMostCyclesLate ? 1 : cycles;
}

}  // namespace graben
