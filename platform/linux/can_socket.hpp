// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A CAN_RAW socket as a port wants it, and how its interface is at this moment: error frames tell
/// changes only, and a port that is opened on a bus that has been passive or off for long would
/// never hear of it.

#include <linux/can.h>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hal/can_port.hpp"
#include "platform/linux/process.hpp"

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

/// Which socket to make.
struct CanSocketConfig {
  std::string interface;            ///< "can0"
  std::vector<can_filter> filters;  ///< None: every frame passes.
};

/// A bound socket and the bus's state, or the reason why there is none. The caller closes it.
struct OpenedCanSocket {
  int fd = -1;
  CanPortState state = CanPortState::kDown;
  ErrorText error;
};

/// Makes a non-blocking socket without FD frames and own frames, with the filters, error frames,
/// receive stamps and the count of lost frames, and with room for about one cycle's frames to
/// send; asks how the controller is. Some system calls that may wait for the kernel's RTNL lock:
/// not for a cycle in which the machine moves.
[[nodiscard]] OpenedCanSocket open_can_socket(const CanSocketConfig& config);

}  // namespace graben
