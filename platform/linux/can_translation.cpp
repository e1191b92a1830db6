#include "platform/linux/can_translation.hpp"

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

can_filter exact_filter(std::uint32_t id) {
  can_filter filter{};
  filter.can_id = (id & CAN_EFF_MASK) | CAN_EFF_FLAG;
  filter.can_mask = CAN_EFF_FLAG | CAN_RTR_FLAG | CAN_EFF_MASK;
  return filter;
}

}  // namespace graben
