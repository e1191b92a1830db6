// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A CAN frame as a port hands it over, whatever bus is behind it.

#include <array>
#include <cstdint>

#include "firmware/core/time.hpp"

namespace graben {

/// Of a frame: a port that is the only one says no more, and what is sent goes to every bus.
inline constexpr std::uint8_t kAnyBus = 0xFF;

/// What of an id says which message a frame is. On J1939 that is PGN and source address; the three
/// bits of priority above them are the sender's affair, and makers differ. An id of 11 bits has
/// none.
constexpr std::uint32_t identity_of(std::uint32_t id) { return id & 0x03FFFFFFU; }

constexpr bool same_message(std::uint32_t id, std::uint32_t other) {
  return identity_of(id) == identity_of(other);
}

/// The null address, which no sender of data has: in a DBC it stands for any.
inline constexpr std::uint32_t kAnySource = 0xFE;

/// A message of this 29-bit id is known by its PGN alone.
constexpr bool is_of_any_source(std::uint32_t id) { return (id & 0xFFU) == kAnySource; }

/// Of a message as a profile or a DBC names it, both of 29 bits.
constexpr bool is_named_by(std::uint32_t id, std::uint32_t named) {
  return same_message(id, named) ||
         (is_of_any_source(named) && same_message(id | 0xFFU, named | 0xFFU));
}

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
