#include "platform/linux/can_errors.hpp"

namespace graben {
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

}  // namespace graben
