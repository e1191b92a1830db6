// SPDX-License-Identifier: Apache-2.0
#include "hal/link/message_clock.hpp"

#include <algorithm>

#include "firmware/core/whole.hpp"

namespace graben {
namespace {

/// Of the time that passes: what a sender's clock may be slow by.
constexpr std::int32_t kDriftShare = 1000;
/// It counts no further; a queue of ours would have overflowed long before.
constexpr TimeUs kMostCounted_us = 1000 * kSecondUs;

}  // namespace

void advance(MessageClock& clock, TimeUs passed_us, TimeUs sent_us) {
  const TimeUs lag_us = clock.lag_us + passed_us - sent_us - quotient(passed_us, kDriftShare);
  clock.lag_us = static_cast<std::int32_t>(std::clamp<TimeUs>(lag_us, 0, kMostCounted_us));
}

}  // namespace graben
