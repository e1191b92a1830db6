// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The station's frames.

#include <array>
#include <cstdint>
#include <optional>

#include "app/operate/station.hpp"
#include "can_dbc/codec.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/message_transmitter.hpp"

namespace graben::operate {

/// Step of OperatorAxes, of a lever's travel.
inline constexpr double kLeverStep = 0.008;

/// Both of a cycle: enable first.
using CommandPair = std::array<CanFrame, 2>;

/// OperatorCommand, which all kinds share.
[[nodiscard]] dbc::Payload command_payload(const Request& request, dbc::Count echo);

class CommandFrames {
 public:
  static constexpr TimeUs kPeriod_us = 20 * kMillisecondUs;

  /// The next pair. In every second one each lever is told a step less, towards its middle: so
  /// levers that are held still, by a stop or a key, show that they are still read
  /// (safety.levers_alive).
  [[nodiscard]] CommandPair next(const Request& request, dbc::Count echo, TimeUs now);
  /// The pair that would be next and asks for nothing, for whoever has to send it in our place.
  [[nodiscard]] CommandPair last_words(TimeUs now) const;

 private:
  SendState command_;
  SendState axes_;
  bool less_ = false;  ///< In the next pair.
};

/// Says for 1 s that the tool is at a point, or that the tracks have moved.
class TouchFrames {
 public:
  static constexpr TimeUs kSaid_us = kSecondUs;

  /// The operator says so: a touch of its own, whatever was said before.
  void begin(TouchKind kind, TimeUs now);
  /// Once a cycle: the frame that is due.
  [[nodiscard]] std::optional<CanFrame> next(TimeUs now);

 private:
  SendState touch_;
  TouchKind kind_ = TouchKind::kMark;
  std::uint8_t number_ = 0;
  bool has_begun_ = false;
  TimeUs until_us_ = 0;
  TimeUs next_us_ = 0;
};

}  // namespace graben::operate
