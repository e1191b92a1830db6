#pragma once
/// How a CAN interface is at this moment. Error frames tell changes only: a port that is opened on
/// a bus that has been passive or off for long would never hear of it.

#include <cstddef>
#include <cstdint>

#include "hal/can_port.hpp"
#include "platform/linux/error_text.hpp"

namespace graben {

/// What the kernel says of an interface (rtnetlink, RTM_NEWLINK).
struct CanLink {
  bool is_can = false;
  bool is_up = false;
  bool has_state = false;   ///< A virtual interface has no controller and reports none.
  std::uint32_t state = 0;  ///< CAN_STATE_*, if has_state.
};

/// Reads the answer to a request for one link. False if it is anything else, or cut short.
[[nodiscard]] bool parse_link(const void* message, std::size_t length, CanLink& link);

/// The state of a port that has just been opened on this interface: kDown unless it is a CAN
/// interface that is up and whose controller runs.
[[nodiscard]] CanPortState state_of(const CanLink& link);

/// Asks the kernel. False, with the reason in `error`, if it does not answer. Waits for whoever is
/// configuring a network interface just now (the kernel's RTNL lock).
[[nodiscard]] bool query_link(int interface_index, CanLink& link, ErrorText& error);

}  // namespace graben
