// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A CAN frame as a port hands it over, whatever bus is behind it.

#include <array>
#include <cstdint>

#include "firmware/core/time.hpp"

namespace graben {

/// Of a frame: a port that is the only one says no more, and what is sent goes to every bus.
inline constexpr std::uint8_t kAnyBus = 0xFF;

/// One frame. A CAN FD frame keeps its first eight bytes only and has `fd` set; none is used here.
struct CanFrame {
  std::uint32_t id = 0;  ///< 29 or 11 bits, without flags.
  bool extended = true;  ///< 29-bit id.
  bool remote = false;   ///< Remote transmission request.
  bool error = false;    ///< Report of the bus controller; `id` is then no message's.
  bool fd = false;
  std::uint8_t length = 0;  ///< Data bytes, 0 .. 8; more for an FD frame.
  std::array<std::uint8_t, 8> data{};
  std::uint8_t bus = kAnyBus;  ///< Which of several it came on, or is for; in their order, from 0.
  TimeUs stamp_us = 0;         ///< When the port received or sent it, on the port's clock.
};

}  // namespace graben
