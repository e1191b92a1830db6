// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Changes of frames on their way. `Kind` is a machine kind: its Dbc names the messages.

#include "can_dbc/codec.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/e2e.hpp"

namespace graben::runs {

/// Of a message that the DBC has.
template <class Kind>
[[nodiscard]] const dbc::MessageInfo& info_of(std::uint32_t id) {
  const dbc::MessageInfo* found = &Kind::Dbc::kMessages[0];
  for (const dbc::MessageInfo& message : Kind::Dbc::kMessages) {
    found = message.id == id ? &message : found;
  }
  return *found;
}

[[nodiscard]] inline std::uint8_t counter_of(const CanFrame& frame) {
  return static_cast<std::uint8_t>(frame.data[1] & 0x0FU);
}

/// Right again after its data were changed.
template <class Kind>
void protect(CanFrame& frame, std::uint8_t counter) {
  const dbc::MessageInfo& info = info_of<Kind>(frame.id);
  if (info.is_protected) {
    e2e_protect(frame.data, info.data_id, counter);
  }
}

/// Another value than it had, nothing else: within range for every message of ours.
inline void alter(CanFrame& frame) {
  frame.data[2] = static_cast<std::uint8_t>(frame.data[2] ^ 0x10U);
}

inline void corrupt(CanFrame& frame) {
  frame.data[0] = static_cast<std::uint8_t>(frame.data[0] ^ 0x5AU);
}

template <class Kind>
void set_raw(CanFrame& frame, const dbc::Field& field, std::uint32_t raw) {
  dbc::insert(frame.data, field.start_bit, field.width, raw);
  protect<Kind>(frame, counter_of(frame));
}

/// The special value of a field whose 16-bit form is `raw16`.
[[nodiscard]] inline std::uint32_t special_raw(const dbc::Field& field, std::uint32_t raw16) {
  constexpr unsigned kBits = 16;
  return raw16 << (field.width - kBits);
}

}  // namespace graben::runs
