#pragma once
/// The system calls that make a CAN_RAW socket as a port wants it, and nothing else.

#include <linux/can.h>

#include <string>
#include <vector>

#include "hal/can_port.hpp"
#include "platform/linux/error_text.hpp"

namespace graben {

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
