#pragma once
/// What the controller's error frames say of the bus.

#include <linux/can.h>
#include <linux/can/error.h>

#include "hal/can_port.hpp"

namespace graben {

/// The classes of error frames that a port asks the kernel for: the state's changes, and what is
/// only counted.
inline constexpr can_err_mask_t kCanErrorClasses = CAN_ERR_BUSOFF | CAN_ERR_RESTARTED |
                                                   CAN_ERR_CRTL | CAN_ERR_ACK | CAN_ERR_TX_TIMEOUT |
                                                   CAN_ERR_PROT;

/// The state after this frame, for a port that was in `state` before it. Anything but an error
/// frame changes nothing; neither does one that reports a single fault (no acknowledgement, a
/// protocol violation, a transmission that timed out): the controller's own error counters weigh
/// those, and it reports when they have reached a limit. Of two reports in one frame the worse one
/// holds.
///
/// - Bus-off is left by a restart or a report of error-active only; error-passive also by a
///   report that only the warning level is exceeded.
/// - kClosed and kDown are left by opening the port only.
[[nodiscard]] CanPortState next_state(CanPortState state, const can_frame& frame);

/// The frame reports that the controller had no room for what it received: frames were lost.
[[nodiscard]] bool reports_lost_frames(const can_frame& frame);

}  // namespace graben
