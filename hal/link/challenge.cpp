// SPDX-License-Identifier: Apache-2.0
#include "hal/link/challenge.hpp"

#include "hal/link/message_clock.hpp"

namespace graben {
namespace {

constexpr std::uint16_t kLastStamp = 64255;  ///< What J1939 leaves of 16 bits.

}  // namespace

// OperatorCommand comes every 20 ms. The machine answers in its next cycle of 10 ms, and names
// itself every second.
const Challenge::Times Challenge::kDriver{kMostLag_us + 20 * kMillisecondUs, 100 * kMillisecondUs};
const Challenge::Times Challenge::kMachine{kMostLag_us + 10 * kMillisecondUs,
                                           2500 * kMillisecondUs};

void Challenge::sent(TimeUs now) {
  driver_.awaited = true;
  machine_.awaited = true;
  last_ = next_;
  next_ = next_ == kLastStamp ? std::uint16_t{1} : static_cast<std::uint16_t>(next_ + 1U);
  sent_us_ = now;
}

void Challenge::hear(Station& station, const Times& times, const Signal<std::uint32_t>& echo,
                     TimeUs now) const {
  station.heard = echo.validity != Validity::kNotReceived && now - echo.stamp_us <= times.silent_us;
  station.mute = station.heard && echo.validity == Validity::kNotAvailable;
  if (!station.awaited) {
    return;
  }
  const bool is_right = echo.validity == Validity::kValid && echo.value == last_ &&
                        echo.stamp_us - sent_us_ <= times.answer_us;
  if (is_right) {
    station.awaited = false;
    station.unanswered = 0;
  } else if (now - sent_us_ >= times.answer_us) {
    station.awaited = false;
    station.unanswered = station.unanswered == 0 ? std::uint8_t{1} : std::uint8_t{2};
  }
}

void Challenge::hear(const Echoes& echoes, TimeUs now) {
  hear(driver_, kDriver, echoes.driver, now);
  hear(machine_, kMachine, echoes.machine, now);
}

bool Challenge::is_late(const Station& station, std::uint8_t most) {
  return station.heard && !station.mute && station.unanswered > most;
}

bool Challenge::is_late(bool in_motion) const {
  const std::uint8_t most = in_motion ? 1 : 0;
  return is_late(driver_, most) || is_late(machine_, most);
}

}  // namespace graben
