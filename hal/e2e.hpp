#pragma once
/// End-to-end protection in the layout of AUTOSAR profile 11, data id mode BOTH: byte 0 is the CRC,
/// the low nibble of byte 1 the counter (0 .. 14, 15 is invalid). The CRC runs over the data id
/// (low byte, high byte), then bytes 1 to 7; polynomial 0x1D, initial value and xor-out 0. The data
/// id is not sent: a frame under another message's id has a wrong CRC.
///
/// Reception, for each message. 'Good' means CRC right and counter not 15; delta is how far the
/// counter is ahead of the last good frame's, modulo 15.
///
///   state          frame                    result          accepted  next state
///   any            more than max_silence    as the row of   -         synchronising, run 0,
///                  since the last good one  the next state            before the frame is judged
///   any            wrong CRC                kWrongCrc       no        the same; run 0
///   any            counter 15               kWrongSequence  no        synchronising, run 0
///   synchronising  good, run 0              kSynchronising  no        run 1
///   synchronising  good, delta 0            kRepeated       no        run 1
///   synchronising  good, delta 1, run 1     kSynchronising  no        run 2
///   synchronising  good, delta 1, run 2     kOk             yes       synchronised
///   synchronising  good, delta 2 .. 14      kWrongSequence  no        run 1
///   synchronised   good, delta 0            kRepeated       no        the same
///   synchronised   good, delta 1            kOk             yes       the same
///   synchronised   good, delta 2 .. max     kSomeLost       yes       the same
///   synchronised   good, delta max+1 .. 14  kWrongSequence  no        synchronising, run 1
///
/// The start is 'synchronising, run 0': three consecutive good frames are needed, as after any
/// loss. A repeated frame is not a sign of life: a sender with a frozen counter falls silent.

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/time.hpp"

namespace graben {

using E2ePayload = std::array<std::uint8_t, 8>;

inline constexpr std::uint8_t kE2eCounterCount = 15;  ///< The counter runs 0 .. 14.
inline constexpr std::uint8_t kE2eSyncFrames = 3;     ///< The last of them is accepted.

enum class E2eCheck : std::uint8_t {
  kNoNewData = 0,  ///< Nothing yet, or nothing for longer than max_silence.
  kOk = 1,
  kSomeLost = 2,
  kRepeated = 3,
  kWrongSequence = 4,
  kWrongCrc = 5,
  kSynchronising = 6,
};

/// True for the results with which a frame's data may be used.
constexpr bool e2e_accepted(E2eCheck check) {
  return check == E2eCheck::kOk || check == E2eCheck::kSomeLost;
}

/// What a receiver must know of a message.
struct E2eConfig {
  std::uint16_t data_id = 0;
  std::uint8_t max_delta_counter = 1;  ///< 1 .. 14; 1 allows no lost frame.
  TimeUs max_silence_us = 0;  ///< Must be less than 15 cycles, or the counter is ambiguous.
};

/// What a receiver remembers of a message.
struct E2eState {
  bool synchronised = false;
  std::uint8_t run = 0;           ///< Consecutive good frames; meaningful while synchronising.
  std::uint8_t last_counter = 0;  ///< Of the last good frame.
  bool any_good = false;          ///< Without it last_counter and last_good_us mean nothing.
  TimeUs last_good_us = 0;        ///< When a good frame that was not repeated came last.
  E2eCheck last_check = E2eCheck::kNoNewData;
};

/// CRC-8 with polynomial 0x1D, continued from `crc`; no final xor.
std::uint8_t crc8(std::uint8_t crc, const std::uint8_t* data, std::size_t length);

/// Writes counter and CRC into the payload; the high nibble of byte 1 is data and stays. `counter`
/// must be 0 .. 14.
void e2e_protect(E2ePayload& payload, std::uint16_t data_id, std::uint8_t counter);

constexpr std::uint8_t e2e_next_counter(std::uint8_t counter) {
  return static_cast<std::uint8_t>((counter + 1U) % kE2eCounterCount);
}

/// Judges a frame received at `now` by the table above. A clock that runs backwards counts as no
/// time passed.
[[nodiscard]] E2eCheck e2e_check(const E2eConfig& config, E2eState& state,
                                 const E2ePayload& payload, TimeUs now);

/// The last result, or kNoNewData once no good frame has come for longer than max_silence.
[[nodiscard]] E2eCheck e2e_status(const E2eConfig& config, const E2eState& state, TimeUs now);

}  // namespace graben
