// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether a message that nothing protects comes faster than its one sender can send it: then there
/// are two.

#include <algorithm>

#include "firmware/core/time.hpp"

namespace graben {

/// Of one message: when it may come again.
struct Pace {
  TimeUs due_us = 0;
  bool any = false;
};

/// Frames of up to so long ago may come in one cycle of ours.
inline constexpr TimeUs kTogether_us = 25 * kMillisecondUs;

/// True for a frame that comes too early; else the next one is due `least_us` later. Of frames that
/// come together each is counted from the one before, as in hal/link/e2e.hpp.
[[nodiscard]] inline bool is_early(TimeUs now, TimeUs least_us, Pace& pace) {
  if (pace.any && now + kTogether_us < pace.due_us) {
    return true;
  }
  pace.due_us = (pace.any ? std::max(pace.due_us, now) : now) + least_us;
  pace.any = true;
  return false;
}

}  // namespace graben
