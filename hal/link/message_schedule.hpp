#pragma once
/// When which frame is due, and its protection.

#include <array>
#include <cstddef>
#include <cstdint>

#include "can_dbc/codec.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/bus_parts.hpp"

namespace graben {

inline constexpr TimeUs kControlPeriod_us = 10 * kMillisecondUs;

/// How a message is sent.
struct SendRule {
  std::uint32_t id = 0;
  TimeUs period_us = 0;
  TimeUs phase_us = 0;  ///< Spreads the load: no cycle sends all.
  bool is_protected = false;
  std::uint16_t data_id = 0;
  BusPart part = nullptr;  ///< Sent only by a machine that has it.
};

template <class Message>
constexpr SendRule send_rule(TimeUs phase_us, BusPart part) {
  static_assert(Message::kLength == 8);
  return {Message::kId,     Message::kCycleTimeMs * kMillisecondUs,
          phase_us,         Message::kProtected,
          Message::kDataId, part};
}

/// What is remembered of a message that is sent.
struct SendState {
  TimeUs due_us = 0;
  std::uint8_t counter = 0;  ///< Of the next frame.
};

/// Whether a message is due, and when it is next. A call that comes up to half a control cycle
/// early or late keeps the schedule; one that comes later starts it afresh from there.
[[nodiscard]] bool take_due(TimeUs& due_us, TimeUs period_us, TimeUs now);

/// The frame of an 8-byte message without protection.
[[nodiscard]] CanFrame frame_of(std::uint32_t id, const dbc::Payload& payload, TimeUs now);

/// The frame of a message, protected if it is to be.
[[nodiscard]] CanFrame next_frame(const SendRule& rule, SendState& state,
                                  const dbc::Payload& payload, TimeUs now);

}  // namespace graben
