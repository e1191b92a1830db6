// SPDX-License-Identifier: Apache-2.0
#pragma once
/// End-to-end protection in the layout of AUTOSAR profile 11, data id mode BOTH: byte 0 is the CRC,
/// the low nibble of byte 1 the counter (0 .. 14, 15 is invalid). The CRC runs over the data id
/// (low byte, high byte), then bytes 1 to 7; polynomial 0x1D, initial value and xor-out 0. The data
/// id is not sent: a frame under another message's id has a wrong CRC.
///
/// Reception, for each message. 'Good' means CRC right and counter not 15; delta is how far the
/// counter is ahead of the last good frame's, modulo 15; 'too early' is explained below.
///
///   state          frame                    result          accepted  next state
///   any            more than max_silence    as the row of   -         synchronising, run 0,
///                  since the last good one  the next state            before the frame is judged
///   any            wrong CRC                kWrongCrc       no        the same; run 0
///   any            counter 15               kWrongSequence  no        synchronising, run 0
///   synchronising  good, delta 0, run > 0,  kRepeated       no        run 1
///                  the same CRC
///   synchronised   good, delta 0, the same  kRepeated       no        the same
///                  CRC
///   any            good, too early          kTooMany        no        the same
///   synchronising  good, run 0              kSynchronising  no        run 1
///   synchronising  good, delta 0, other CRC kConflict       no        run 1
///   synchronising  good, delta 1, run 1     kSynchronising  no        run 2
///   synchronising  good, delta 1, run 2     kOk             yes       synchronised
///   synchronising  good, delta 2 .. 14      kWrongSequence  no        run 1
///   synchronised   good, delta 0, other CRC kConflict       no        the same
///   synchronised   good, delta 1            kOk             yes       the same
///   synchronised   good, delta 2 .. max     kSomeLost       yes       the same
///   synchronised   good, delta max+1 .. 12  kWrongSequence  no        synchronising, run 1
///   synchronised   good, delta 13, 14       kWrongSequence  no        the same: late by one or two
///
/// The start is 'synchronising, run 0': three consecutive good frames are needed, as after any
/// loss. Repeated, conflicting, late and early frames are no sign of life and leave the last
/// counter: a sender with a frozen counter falls silent. A pair out of order costs its second frame
/// only. A repeated frame is the last one again; a conflict is another one with its counter, from a
/// second sender or a replay. (An equal CRC byte by chance, 1 in 256, hides one conflict.)
///
/// Too early. A sender with one frame a cycle cannot have sent more frames than cycles have passed.
/// Frames that come together count from the time of those before them, each advances the time of
/// the next one by 4/5 of a cycle (senders' clocks differ), and a frame whose time has not come is
/// refused: two of a message at once after a cycle's pause, three after two, and so on. Without
/// this a replayed block could be used at the rate at which it comes.
///
/// A replayed block: old frames of consecutive counters beside the live ones, the first of them
/// `offset` ahead of the last live one; max is 3. The window of e2e_window.hpp counts conflicting,
/// late, early and jumping frames and trips at the third. 'Used' is how many control cycles at most
/// bring an old value as their newest one before that, 'held' how many at most end with one.
///
///   offset    old and live ones by turns          all old ones at once      used  held
///   0         the old one conflicts each time     conflicts, then as 1      1     1
///   1         the live one conflicts, from the    two accepted, the others  2     2
///             third cycle on frames are early     early
///   2         the live one is late; as 1          as 1                      2     2
///   3         the live one is late; as 1          as 1                      2     3
///   4 .. 12   both jump; no three in a row        jumps, and no three in    0     0
///                                                 a row before the others
///                                                 are early
///   13, 14    the old one is late each time       late, then early          0     0
///
/// An offset counted before a live frame of the same cycle is one less after it: 4 may act as 3, 1
/// as 0. A block too short to trip the window has ended by then. No counter can tell a block that
/// takes the live frames' place seamlessly: that is for the plausibility of the values.

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
  kConflict = 7,  ///< The last counter again, with other data.
  kTooMany = 8,   ///< More frames than the sender can have sent.
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
  TimeUs cycle_us = 0;        ///< The sender's; with 0 no frame comes too early.
};

/// What a receiver remembers of a message.
struct E2eState {
  bool synchronised = false;
  std::uint8_t run = 0;           ///< Consecutive good frames; meaningful while synchronising.
  std::uint8_t last_counter = 0;  ///< Of the last frame that synchronisation went by.
  std::uint8_t last_crc = 0;      ///< Its CRC byte.
  bool any_good = false;          ///< Without it the last counter, CRC and time mean nothing.
  TimeUs last_good_us = 0;        ///< When a frame that synchronisation went by came last.
  TimeUs batch_us = 0;            ///< When good frames, not repeated, came last.
  TimeUs due_us = 0;              ///< The next frame may come then.
  E2eCheck last_check = E2eCheck::kNoNewData;
};

/// CRC-8 with polynomial 0x1D, continued from `crc`; no final xor.
std::uint8_t crc8(std::uint8_t crc, const std::uint8_t* data, std::size_t length);

/// Writes counter and CRC into the payload; the high nibble of byte 1 is data and stays. `counter`
/// must be 0 .. 14.
void e2e_protect(E2ePayload& payload, std::uint16_t data_id, std::uint8_t counter);

/// What a data id adds to the CRC of a payload, which is linear in both.
[[nodiscard]] std::uint8_t e2e_signature(std::uint16_t data_id);

/// The signature of every data id that the payload's CRC fits.
[[nodiscard]] std::uint8_t e2e_fitting_signature(const E2ePayload& payload);

/// Whether the payload's CRC is that of a message with this data id.
[[nodiscard]] bool e2e_crc_fits(const E2ePayload& payload, std::uint16_t data_id);

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
