// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether a command has two senders: their counters do not fit into one sequence.

#include <cstdint>

#include "firmware/core/time.hpp"

namespace graben::plant {

/// Three frames out of sequence among the last 16, or one that the caller knows to be another's.
/// Holds until there has been only one sender for kAloneUs.
class SenderWatch {
 public:
  static constexpr TimeUs kAloneUs = 500 * kMillisecondUs;

  void note(bool in_sequence, TimeUs now) {
    frames_ = static_cast<std::uint16_t>((static_cast<unsigned>(frames_) << 1U) |
                                         (in_sequence ? 0U : 1U));
    constexpr int kMost = 2;
    int wrong = 0;
    for (unsigned left = frames_; left != 0; left &= left - 1) {
      ++wrong;
    }
    if (!in_sequence && (wrong > kMost || are_two(now))) {
      note_other(now);
    }
  }
  void note_other(TimeUs now) {
    two_ = true;
    last_us_ = now;
  }
  [[nodiscard]] bool are_two(TimeUs now) const { return two_ && now - last_us_ < kAloneUs; }

 private:
  std::uint16_t frames_ = 0;  ///< A bit for each, the newest lowest; set: out of sequence.
  bool two_ = false;
  TimeUs last_us_ = 0;
};

}  // namespace graben::plant
