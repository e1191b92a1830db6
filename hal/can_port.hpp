// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The way to a CAN bus: SocketCAN or the bus in memory. Nothing here blocks.

#include <cstdint>

#include "hal/can_frame.hpp"

namespace graben {

/// What the bus lets us do. An unacknowledged bus stays kErrorPassive for ever and never becomes
/// kBusOff: both must be watched.
enum class CanPortState : std::uint8_t {
  kClosed = 0,  ///< Not opened yet.
  kActive = 1,
  kErrorPassive = 2,
  kBusOff = 3,
  kDown = 4,  ///< The interface is down or gone.
};

class CanPort {
 public:
  /// Opens the port, or opens it again; whatever was queued before is discarded, so that no stale
  /// frame is taken for a fresh one. False if the bus is not there.
  [[nodiscard]] virtual bool open() = 0;

  /// Moves up to `capacity` pending frames, oldest first, into `frames`; returns how many. What
  /// does not fit stays for the next call: a flood cannot hold up a cycle.
  [[nodiscard]] virtual int receive(CanFrame* frames, int capacity) = 0;

  /// Hands one frame to the bus. False if it was dropped; it is never tried again, because a late
  /// motion command is worse than none.
  [[nodiscard]] virtual bool send(const CanFrame& frame) = 0;

  [[nodiscard]] virtual CanPortState state() const = 0;

 protected:
  // Not virtual: nobody deletes a port through this interface, and a virtual destructor would make
  // the core's archive refer to operator delete.
  ~CanPort() = default;
};

}  // namespace graben
