// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What of the last frames of a message was wrong, and whether that is a fault. One wrong frame is
/// none: a disturbance on the wire, a pair out of order. Three of the last 16 are.
///
/// Frames are counted, not time: the same three errors weigh the same at any cycle time, and the
/// good frames that re-arming needs push them out. A message of which nothing comes any more is
/// missing, which is another fault; after a second of that the window is empty.

#include <cstdint>

#include "firmware/core/fault_set.hpp"
#include "firmware/core/time.hpp"

namespace graben {

inline constexpr int kE2eWindowFrames = 16;
inline constexpr int kE2eWindowLimit = 3;
inline constexpr TimeUs kE2eWindowForget_us = kSecondUs;

enum class E2eMark : std::uint8_t {
  kGood = 0,
  kSequence = 1,    ///< Conflicting, jumping, late, early, surplus, counter 15.
  kCorrupt = 2,     ///< Wrong CRC.
  kMasquerade = 3,  ///< Wrong CRC, and it fits another message.
};

/// A bit for each of the last frames, the newest lowest. Repeated frames are not noted: they are
/// neither an error nor a sign that errors have ended.
struct E2eWindow {
  std::uint16_t sequence = 0;
  std::uint16_t corrupt = 0;  ///< Every wrong CRC.
  std::uint16_t masquerade = 0;
  TimeUs last_us = 0;
};

void e2e_note(E2eWindow& window, E2eMark mark, TimeUs now);

/// kMessageSequence, and kMessageMasquerade or else kMessageCorrupt. A random wrong CRC fits one of
/// a dozen other messages in 5 of 100 cases: masquerade is a diagnosis, no proof.
[[nodiscard]] FaultSet e2e_faults(const E2eWindow& window, TimeUs now);

}  // namespace graben
