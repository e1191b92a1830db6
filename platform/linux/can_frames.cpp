// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/can_frames.hpp"

#include <algorithm>
#include <cstddef>

namespace graben {

CanFrame from_socketcan(const can_frame& frame, TimeUs stamp_us) {
  CanFrame result;
  result.error = (frame.can_id & CAN_ERR_FLAG) != 0;
  result.extended = (frame.can_id & CAN_EFF_FLAG) != 0;
  result.remote = (frame.can_id & CAN_RTR_FLAG) != 0;
  // The classes of an error frame use all 29 bits, whatever its flags say.
  result.id = frame.can_id & (result.extended || result.error ? CAN_EFF_MASK : CAN_SFF_MASK);
  result.length = std::min<std::uint8_t>(frame.can_dlc, CAN_MAX_DLEN);
  result.stamp_us = stamp_us;
  // A remote frame's length is that of the answer: it has no data of its own.
  if (!result.remote) {
    std::copy_n(frame.data, result.length, result.data.begin());
  }
  return result;
}

bool to_socketcan(const CanFrame& frame, can_frame& out) {
  const std::uint32_t largest_id = frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK;
  if (frame.error || frame.fd || frame.id > largest_id || frame.length > CAN_MAX_DLEN) {
    return false;
  }
  can_frame result{};
  result.can_id = frame.id;
  result.can_id |= frame.extended ? CAN_EFF_FLAG : 0U;
  result.can_id |= frame.remote ? CAN_RTR_FLAG : 0U;
  result.can_dlc = frame.length;
  if (!frame.remote) {
    std::copy_n(frame.data.begin(), frame.length, result.data);
  }
  out = result;
  return true;
}

can_filter message_filter(std::uint32_t id) {
  can_filter filter{};
  if ((id & CAN_EFF_FLAG) != 0U) {
    filter.can_id = id & CAN_SFF_MASK;
    filter.can_mask = CAN_EFF_FLAG | CAN_RTR_FLAG | CAN_SFF_MASK;
    return filter;
  }
  const std::uint32_t sender = is_of_any_source(id) ? 0xFFU : 0U;
  filter.can_id = (identity_of(id) & ~sender) | CAN_EFF_FLAG;
  filter.can_mask = CAN_EFF_FLAG | CAN_RTR_FLAG | (identity_of(CAN_EFF_MASK) & ~sender);
  return filter;
}

namespace {

bool is_error(const can_frame& frame, canid_t error_class) {
  return (frame.can_id & CAN_ERR_FLAG) != 0 && (frame.can_id & error_class) != 0;
}

/// Byte 1 of an error frame; it means something only in this class.
unsigned controller_status(const can_frame& frame) {
  return is_error(frame, CAN_ERR_CRTL) ? frame.data[1] : 0U;
}

constexpr unsigned kPassive = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
constexpr unsigned kWarning = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING;

}  // namespace

CanPortState next_state(CanPortState state, const can_frame& frame) {
  if (state == CanPortState::kClosed || state == CanPortState::kDown) {
    return state;
  }
  if (is_error(frame, CAN_ERR_BUSOFF)) {
    return CanPortState::kBusOff;
  }
  const bool restarted = is_error(frame, CAN_ERR_RESTARTED);
  const unsigned status = controller_status(frame);
  if (state == CanPortState::kBusOff && !restarted && (status & CAN_ERR_CRTL_ACTIVE) == 0) {
    return state;
  }
  if ((status & kPassive) != 0) {
    return CanPortState::kErrorPassive;
  }
  // A controller above the warning level only is error-active: the level is a hint, not a state of
  // the protocol.
  if (restarted || (status & (CAN_ERR_CRTL_ACTIVE | kWarning)) != 0) {
    return CanPortState::kActive;
  }
  return state;
}

bool reports_lost_frames(const can_frame& frame) {
  return (controller_status(frame) & CAN_ERR_CRTL_RX_OVERFLOW) != 0;
}

namespace {

constexpr TimeUs kMaxAgeUs = kSecondUs;
/// Time synchronisation slews by 500 ppm at most, 5 us a cycle; what is more than this is a step.
constexpr TimeUs kMaxSlewUs = kMillisecondUs;

}  // namespace

void ReceiveStamp::set_now(TimeUs monotonic_us, TimeUs wall_us) {
  const TimeUs slew_us = (wall_us - wall_us_) - (monotonic_us - monotonic_us_);
  if (has_now_ && (slew_us > kMaxSlewUs || slew_us < -kMaxSlewUs)) {
    trusted_ = false;
  }
  monotonic_us_ = monotonic_us;
  wall_us_ = wall_us;
  has_now_ = true;
}

TimeUs ReceiveStamp::monotonic_us(TimeUs wall_stamp_us) const {
  const TimeUs age_us = wall_us_ - wall_stamp_us;
  const bool possible = age_us >= 0 && age_us <= kMaxAgeUs;
  return trusted_ && possible ? monotonic_us_ - age_us : monotonic_us_;
}

}  // namespace graben
