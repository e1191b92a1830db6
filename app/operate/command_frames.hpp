// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The station's frames.

#include <array>

#include "app/operate/station.hpp"
#include "can_dbc/codec.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/message_transmitter.hpp"

namespace graben::operate {

/// Both of a cycle: enable first.
using CommandPair = std::array<CanFrame, 2>;

class CommandFrames {
 public:
  static constexpr TimeUs kPeriod_us = 20 * kMillisecondUs;

  /// The next pair.
  [[nodiscard]] CommandPair next(const Request& request, dbc::Count echo, TimeUs now);
  /// The pair that would be next and asks for nothing, for whoever has to send it in our place.
  [[nodiscard]] CommandPair last_words(TimeUs now) const;

 private:
  SendState command_;
  SendState axes_;
};

}  // namespace graben::operate
