// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether the way to the stations and back takes too long, from the start or from some time on.
///
/// Each EcuIdentity carries another Stamp. The operator's station repeats the last one that it
/// heard in every OperatorCommand, the machine's answers with a MachineIdentity in its next cycle.
/// The right echo has to be here within 60 ms and a cycle of the sender's: it says that what the
/// station hears and what it sends together are not late by more. That holds at any age of the
/// frames: an old echo is another number.
///
/// Until each station has answered once, and after an answer that is wrong, late or missing, the
/// stations count as late outside motion; in motion a single answer may be lost, two in a row not.
/// A lag that begins in motion is so seen within 2.1 s; what grows is seen sooner by
/// hal/link/message_clock.hpp.
///
/// An echo that is 'not available' is that of a station which cannot answer: it is not checked, and
/// cannot_answer() says so. One that has heard no stamp yet sends 0.

#include <cstdint>

#include "firmware/signals/signal.hpp"

namespace graben {

/// The last stamps that the stations say they heard, each with the time of the frame.
struct Echoes {
  Signal<std::uint32_t> driver;
  Signal<std::uint32_t> machine;
};

class Challenge {
 public:
  /// Of the next EcuIdentity, 1 .. 64255.
  [[nodiscard]] std::uint16_t next_stamp() const { return next_; }
  /// An EcuIdentity with next_stamp() went out.
  void sent(TimeUs now);
  /// Once a cycle, with what has come up to now.
  void hear(const Echoes& echoes, TimeUs now);

  /// Whether a station that is heard has not answered as it has to.
  [[nodiscard]] bool is_late(bool in_motion) const;
  /// A station is heard that cannot answer.
  [[nodiscard]] bool cannot_answer() const { return driver_.mute || machine_.mute; }

 private:
  struct Station {
    bool heard = false;
    bool mute = false;            ///< Heard, and it cannot answer.
    bool awaited = false;         ///< Its answer to the last stamp.
    std::uint8_t unanswered = 1;  ///< Stamps in a row, up to 2. The first of all is still to come.
  };
  /// A station's frames: their cycle, and how long after the last one it counts as heard.
  struct Times {
    TimeUs answer_us = 0;
    TimeUs silent_us = 0;
  };
  static const Times kDriver;
  static const Times kMachine;

  void hear(Station& station, const Times& times, const Signal<std::uint32_t>& echo,
            TimeUs now) const;
  [[nodiscard]] static bool is_late(const Station& station, std::uint8_t most);

  Station driver_;
  Station machine_;
  std::uint16_t next_ = 1;
  std::uint16_t last_ = 0;  ///< 0: none was sent.
  TimeUs sent_us_ = 0;
};

}  // namespace graben
