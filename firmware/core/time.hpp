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

}  // namespace graben
