// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Time as the core sees it: an argument, never a clock.

#include <cstdint>

namespace graben {

/// Microseconds since any fixed instant; only differences count. Signed, so that differences are
/// too.
using TimeUs = std::int64_t;

inline constexpr TimeUs kMillisecondUs = 1000;
inline constexpr TimeUs kSecondUs = 1'000'000;

/// A controller's cycle, s: what a place of a ring of commands stands for.
inline constexpr double kCyclePeriod_s = 0.01;
/// A cycle that comes later than so many after the last one is a stall, which stops (watch_time).
inline constexpr int kMostCyclesLate = 5;

/// Whole cycles since the last one: a command that stood for longer, as the next one came late, has
/// been under way as often. 1 to kMostCyclesLate, and 1 after a stall: what that stops does not
/// catch up.
[[nodiscard]] constexpr int cycles_in(double elapsed_s) {
  const int cycles = static_cast<int>(elapsed_s / kCyclePeriod_s + 0.5);
  return cycles < 1 || cycles > kMostCyclesLate ? 1 : cycles;
}

}  // namespace graben
