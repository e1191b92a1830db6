// SPDX-License-Identifier: Apache-2.0
// What comes in: batches, stamps, error frames, what was lost or is of no use.

#include <arpa/inet.h>
#include <netinet/in.h>

#include "platform/linux/cyclic_clock.hpp"
#include "tests/unit/platform/socketcan_rig.hpp"

using namespace graben::test;
using State = CanPortState;

TEST(frames_come_in_order_with_stamps) {
  Rig rig;
  const TimeUs before_us = monotonic_now_us();
  from_bus(raw(1U | CAN_EFF_FLAG, 11));
  from_bus(raw(2U | CAN_EFF_FLAG, 22));
  const TimeUs after_us = monotonic_now_us();
  usleep(3000);
  assert_int_equal(rig.receive(), 2);
  assert_int_equal(rig.frames[0].id, 1);
  assert_int_equal(rig.frames[1].id, 2);
  assert_int_equal(rig.frames[1].data[0], 22);
  // When they arrived, not when they were read; the two clocks are not read at one instant.
  assert_in_range(rig.frames[0].stamp_us, before_us - 1500, after_us + 1500);
  assert_int_equal(rig.receive(), 0);
  assert_int_equal(rig.port.counters().received, 2);
}

TEST(receive_is_bounded_and_goes_on) {
  Rig rig;
  for (unsigned char i = 0; i < 8; ++i) {
    from_bus(raw(CAN_EFF_FLAG, i));
  }
  assert_int_equal(rig.receive(0), 0);
  assert_int_equal(rig.receive(3), 3);
  assert_int_equal(rig.receive(3), 3);
  assert_int_equal(rig.frames[0].data[0], 3);
  assert_int_equal(rig.receive(3), 2);
  // What is not handed out takes nobody's place.
  report(CAN_ERR_PROT);
  for (unsigned char i = 0; i < 3; ++i) {
    from_bus(raw(CAN_EFF_FLAG, i));
  }
  assert_int_equal(rig.receive(3), 3);
}

/// UDP on the loopback interface: queues hold more than AF_UNIX's, and lost ones are counted.
OpenedCanSocket open_udp(const CanSocketConfig&) {
  OpenedCanSocket result;
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0);
  set_bus(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  const int on = 1;
  setsockopt(fd, SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on);
  auto* const generic = reinterpret_cast<sockaddr*>(&address);
  if (bind(fd, generic, length) != 0 || getsockname(fd, generic, &length) != 0 ||
      connect(g_bus, generic, length) != 0) {
    close(fd);
    return result;
  }
  result.fd = fd;
  result.state = State::kActive;
  return result;
}

TEST(a_long_queue_takes_several_batches) {
  SocketCanPort port("can7", {}, &open_udp);
  if (!port.open()) {
    skip();
  }
  for (unsigned i = 0; i < 100; ++i) {
    from_bus(raw(i | CAN_EFF_FLAG));
  }
  std::array<CanFrame, 100> frames;
  assert_int_equal(port.receive(frames.data(), 96), 96);
  for (std::uint32_t i = 0; i < 96; ++i) {
    assert_int_equal(frames[i].id, i);
  }
  assert_int_equal(port.receive(frames.data(), 96), 4);
  assert_int_equal(frames[3].id, 99);
}

TEST(what_the_queue_lost_is_counted_over_all_sockets) {
  SocketCanPort port("can7", {}, &open_udp);
  std::array<CanFrame, 256> frames;
  std::uint64_t expected = 0;
  for (int opening = 0; opening < 2; ++opening) {
    if (!port.open()) {
      skip();
    }
    repeat(4000, [&] { from_bus(raw(1U | CAN_EFF_FLAG)); });
    std::uint64_t taken = 0;
    for (int some = 256; some == 256; taken += static_cast<std::uint64_t>(some)) {
      some = port.receive(frames.data(), 256);
    }
    expected += 4000 - taken;
    // The next frame brings the count, and the one after it must not count it again.
    from_bus(raw(1U | CAN_EFF_FLAG));
    assert_int_equal(port.receive(frames.data(), 256), 1);
    from_bus(raw(1U | CAN_EFF_FLAG));
    assert_int_equal(port.receive(frames.data(), 256), 1);
    assert_true(taken < 4000);
    assert_int_equal(port.counters().receive_overflow, expected);
  }
}

TEST(a_flood_of_error_frames_is_bounded) {
  SocketCanPort port("can7", {}, &open_udp);
  if (!port.open()) {
    skip();
  }
  repeat(200, [&] { report(CAN_ERR_PROT); });
  from_bus(raw(1U | CAN_EFF_FLAG));
  std::array<CanFrame, 256> frames;
  assert_int_equal(port.receive(frames.data(), 256), 0);
  assert_int_equal(port.counters().error_frames, 128);
  assert_int_equal(port.receive(frames.data(), 256), 1);
  assert_int_equal(port.counters().error_frames, 200);
}

/// It has to stop the machine all the same.
TEST(a_bus_off_that_ends_within_a_call_is_seen) {
  Rig rig;
  report(CAN_ERR_BUSOFF);
  report(CAN_ERR_RESTARTED);
  assert_int_equal(rig.receive(), 0);
  assert_int_equal(rig.port.state(), State::kBusOff);
  assert_true(rig.port.send(outgoing(1)));
  assert_int_equal(rig.receive(), 0);
  assert_int_equal(rig.port.state(), State::kActive);
  can_frame seen{};
  assert_int_equal(read(g_bus, &seen, sizeof seen), sizeof seen);
}

TEST(error_frames_make_the_state) {
  Rig rig;
  report(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE);
  from_bus(raw(5U | CAN_EFF_FLAG));
  assert_int_equal(rig.port.state(), State::kActive);
  assert_int_equal(rig.receive(), 1);
  assert_int_equal(rig.frames[0].id, 5);
  assert_int_equal(rig.port.state(), State::kErrorPassive);
  assert_true(rig.port.send(outgoing(1)));
  report(CAN_ERR_BUSOFF);
  assert_int_equal(rig.receive(), 0);
  assert_int_equal(rig.port.state(), State::kBusOff);
  assert_false(rig.port.send(outgoing(2)));
  report(CAN_ERR_RESTARTED);
  assert_int_equal(rig.receive(), 0);
  assert_int_equal(rig.port.state(), State::kActive);
  assert_true(rig.port.send(outgoing(3)));
  assert_int_equal(rig.port.counters().error_frames, 3);
  assert_int_equal(rig.port.counters().received, 1);
  // Only what was sent on the bus is there: 1 and 3.
  can_frame seen{};
  assert_int_equal(read(g_bus, &seen, sizeof seen), sizeof seen);
  assert_int_equal(seen.can_id, 1U | CAN_EFF_FLAG);
  assert_int_equal(read(g_bus, &seen, sizeof seen), sizeof seen);
  assert_int_equal(seen.can_id, 3U | CAN_EFF_FLAG);
  assert_int_equal(read(g_bus, &seen, sizeof seen), -1);
}

TEST(a_controller_that_lost_frames_is_counted) {
  Rig rig;
  report(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW);
  assert_int_equal(rig.receive(), 0);
  assert_int_equal(rig.port.counters().receive_overflow, 1);
  assert_int_equal(rig.port.state(), State::kActive);
}

TEST(frames_of_another_size_are_counted_and_dropped) {
  Rig rig;
  const canfd_frame fd{};
  assert_int_equal(write(g_bus, &fd, sizeof fd), sizeof fd);
  assert_int_equal(write(g_bus, &fd, CAN_MTU - 1), CAN_MTU - 1);
  from_bus(raw(5U | CAN_EFF_FLAG));
  assert_int_equal(rig.receive(), 1);
  assert_int_equal(rig.port.counters().wrong_frames, 2);
  assert_int_equal(rig.frames[0].id, 5);
}
