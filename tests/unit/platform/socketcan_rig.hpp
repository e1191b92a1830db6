// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A port on one end of a socket pair that every kernel has, the test on the other as the bus.

#include <linux/can/error.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

#include "platform/linux/socketcan_port.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

/// What the next opening gives; the other end of it; what it was asked for.
inline OpenedCanSocket g_next;
inline int g_bus = -1;
inline CanSocketConfig g_config;

inline void set_bus(int fd) {
  if (g_bus >= 0) {
    close(g_bus);
  }
  g_bus = fd;
}

inline OpenedCanSocket open_pair(const CanSocketConfig& config) {
  g_config = config;
  OpenedCanSocket result = g_next;
  if (result.state == CanPortState::kDown) {
    return result;
  }
  int ends[2] = {-1, -1};
  assert_int_equal(socketpair(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0, ends), 0);
  const int on = 1;
  assert_int_equal(setsockopt(ends[0], SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on), 0);
  set_bus(ends[1]);
  result.fd = ends[0];
  return result;
}

/// One end's port, open.
struct Rig {
  SocketCanPort port{"can7", {0x18FF5027U}, &open_pair};
  std::array<CanFrame, 256> frames;

  Rig() {
    g_next = OpenedCanSocket{};
    g_next.state = CanPortState::kActive;
    assert_true(port.open());
  }
  int receive(int capacity = 256) { return port.receive(frames.data(), capacity); }
};

inline can_frame raw(canid_t id, unsigned char first = 0) {
  can_frame frame{};
  frame.can_id = id;
  frame.can_dlc = 8;
  frame.data[0] = first;
  return frame;
}

inline void from_bus(const can_frame& frame) {
  assert_int_equal(write(g_bus, &frame, sizeof frame), sizeof frame);
}

inline void report(canid_t classes, unsigned char status = 0) {
  can_frame frame = raw(CAN_ERR_FLAG | classes);
  frame.data[1] = status;
  from_bus(frame);
}

inline CanFrame outgoing(std::uint32_t id) {
  CanFrame frame;
  frame.id = id;
  frame.length = 8;
  return frame;
}

}  // namespace graben::test
