// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether a message's frames are longer and longer on their way. A counter in order says that none
/// was lost, not that it is fresh: a queue that drains too slowly hands out every frame, seconds
/// late. But a protected message also has a known cycle, so its counter is the sender's clock. What
/// that clock has fallen behind ours since it was least behind is the frame's lag:
///
///   lag = max(0, lag + passed - sent - passed / 1000)
///
/// with `passed` by our clock and `sent` the counter's steps times the cycle, both since the last
/// accepted frame. Lost frames count as sent. The last term lets clocks differ: a sender's may be
/// slow by 1 per mille, ten times what two bad crystals make of it. So a lag that grows by less
/// than 1 ms a second is not seen here; one that grows by 1 % is seen when it is 67 ms, one that
/// grows by 10 % at 61 ms. Nor is one seen that was there at the first accepted frame, or that came
/// about in a pause long enough to synchronise anew: for those is hal/link/challenge.hpp.
///
/// A frame is judged in control cycles: what comes late by the phase of two cycles, or by a late
/// cycle of ours, is made good by the frame after it. A sender that leaves out cycles without
/// counting them looks like a queue: six of them within ten seconds are too many.

#include <cstdint>

#include "firmware/core/time.hpp"

namespace graben {

/// A frame that lags by more than this is stale.
inline constexpr TimeUs kMostLag_us = 60 * kMillisecondUs;

/// Of one message; a new one begins with each synchronisation.
struct MessageClock {
  std::int32_t lag_us = 0;
};

/// An accepted frame came `passed_us` after the one before, `sent_us` after it by its counter.
void advance(MessageClock& clock, TimeUs passed_us, TimeUs sent_us);

[[nodiscard]] constexpr bool is_stale(const MessageClock& clock) {
  return clock.lag_us > kMostLag_us;
}

}  // namespace graben
