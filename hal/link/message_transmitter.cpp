// SPDX-License-Identifier: Apache-2.0
#include "hal/link/message_transmitter.hpp"

#include "hal/link/e2e.hpp"

namespace graben {

bool take_due(TimeUs& due_us, TimeUs period_us, TimeUs now) {
  constexpr TimeUs kSlack_us = kControlPeriod_us / 2;
  const TimeUs late_us = now - due_us;
  const bool clock_went_back = late_us < -(period_us + kControlPeriod_us);
  if (late_us < -kSlack_us && !clock_went_back) {
    return false;
  }
  const bool on_schedule = !clock_went_back && late_us <= kSlack_us;
  due_us = (on_schedule ? due_us : now) + period_us;
  return true;
}

CanFrame frame_of(std::uint32_t id, const dbc::Payload& payload, TimeUs now) {
  CanFrame frame;
  frame.id = id;
  frame.length = 8;
  frame.data = payload;
  frame.stamp_us = now;
  return frame;
}

CanFrame next_frame(const SendRule& rule, SendState& state, const dbc::Payload& payload,
                    TimeUs now) {
  CanFrame frame = frame_of(rule.id, payload, now);
  if (rule.is_protected) {
    e2e_protect(frame.data, rule.data_id, state.counter);
    state.counter = e2e_next_counter(state.counter);
  }
  return frame;
}

}  // namespace graben
