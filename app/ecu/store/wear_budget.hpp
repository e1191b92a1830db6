// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How often a store may be written: so that no fault that comes and goes, and no process that
/// starts again and again, wears out what it is written to.
///
/// 32 writes are there at first; each 60 s of operation bring one, up to 32. What is left is stored
/// itself, and only operation fills it up again: a process that starts and ends each second has
/// written at most 32 times when it writes no more. In a day of operation that is at most
/// kMostWritesADay writes of at most 4096 bytes.

#include <algorithm>
#include <cstdint>

#include "app/ecu/store/record_format.hpp"
#include "firmware/core/time.hpp"

namespace graben::ecu {

inline constexpr int kMostTokens = 32;
inline constexpr TimeUs kTokenUs = 60 * kSecondUs;
inline constexpr TimeUs kDayUs = 86'400 * kSecondUs;
inline constexpr int kMostWritesADay = kMostTokens + static_cast<int>(kDayUs / kTokenUs);
inline constexpr std::int64_t kMostBytesADay =
    std::int64_t{kMostWritesADay} * static_cast<std::int64_t>(kMostRecordBytes);
static_assert(kMostWritesADay == 1472 && kMostBytesADay == 6'029'312, "as the manual says");

class WearBudget {
 public:
  /// With so many left, which a record had.
  void begin(int tokens, TimeUs now_us) {
    tokens_ = std::clamp(tokens, 0, kMostTokens);
    filled_us_ = now_us;
  }
  /// Writes that are left now.
  [[nodiscard]] int left(TimeUs now_us) {
    const TimeUs periods = std::max<TimeUs>(now_us - filled_us_, 0) / kTokenUs;
    filled_us_ += periods * kTokenUs;
    tokens_ = static_cast<int>(std::min<TimeUs>(tokens_ + periods, kMostTokens));
    return tokens_;
  }
  /// No more than so many, which another disk's record had: what that has borne counts too.
  void limit(int tokens) { tokens_ = std::min(tokens_, std::max(tokens, 0)); }
  /// Takes so many, of which there are as many.
  void take(int count) { tokens_ -= count; }

 private:
  int tokens_ = kMostTokens;
  TimeUs filled_us_ = 0;
};

}  // namespace graben::ecu
