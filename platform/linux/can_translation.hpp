#pragma once
/// The kernel's CAN frames and filters, and ours.

#include <linux/can.h>

#include <cstdint>

#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"

namespace graben {

/// A frame from a raw socket without FD. A length that no classic frame has is cut to 8.
[[nodiscard]] CanFrame from_socketcan(const can_frame& frame, TimeUs stamp_us);

/// The frame for a raw socket. False, and `out` untouched, for what a classic controller cannot
/// send or nobody but it may: an FD or error frame, an id or a length out of range.
[[nodiscard]] bool to_socketcan(const CanFrame& frame, can_frame& out);

/// Passes 29-bit data frames with this id only: no remote frame, no 11-bit frame of the same bits.
[[nodiscard]] can_filter exact_filter(std::uint32_t id);

}  // namespace graben
