// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The kernel's CAN frames and filters, and ours; what its error frames say of the bus; when a
/// frame came.

#include <linux/can.h>
#include <linux/can/error.h>
#include <cstdint>

#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/can_port.hpp"

namespace graben {

/// A frame from a raw socket without FD. A length that no classic frame has is cut to 8.
[[nodiscard]] CanFrame from_socketcan(const can_frame& frame, TimeUs stamp_us);

/// The frame for a raw socket. False, and `out` untouched, for what a classic controller cannot
/// send or nobody but it may: an FD or error frame, an id or a length out of range.
[[nodiscard]] bool to_socketcan(const CanFrame& frame, can_frame& out);

/// Passes data frames of this message only: no remote frame, none of the other length of ids. With
/// bit 31 the id has 11 bits; else 29, of which PGN and source count and the priority does not, and
/// source FE is any.
[[nodiscard]] can_filter message_filter(std::uint32_t id);

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

/// Takes from a stamp the frame's age only, and counts that back from the monotonic now. The
/// kernel offers CAN sockets no monotonic stamp. A wall clock that was stepped while a frame was
/// waiting would make its age wrong: a step is seen in the two clocks' difference, and until the
/// queue was empty once no stamp is used. A stamp that is not used, and an age below zero or above
/// 1 s, becomes `now`. Control uses the cycle's `now` alone; stamps are for logs and diagnosis.
class ReceiveStamp {
 public:
  /// Both clocks, read after the frames were taken from the socket.
  void set_now(TimeUs monotonic_us, TimeUs wall_us);

  /// Nothing waits that was stamped before the last set_now.
  void queue_is_empty() { trusted_ = true; }

  [[nodiscard]] TimeUs now_us() const { return monotonic_us_; }

  /// Never after the now of set_now, and at most 1 s before it.
  [[nodiscard]] TimeUs monotonic_us(TimeUs wall_stamp_us) const;

 private:
  TimeUs monotonic_us_ = 0;
  TimeUs wall_us_ = 0;
  bool has_now_ = false;
  bool trusted_ = true;
};

}  // namespace graben
