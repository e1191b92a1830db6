// SPDX-License-Identifier: Apache-2.0
// What goes out, what takes the port away and what brings it back. The calls that must fail are
// made to.

#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>

#include "platform/linux/allocation_counter.hpp"
#include "platform/linux/cyclic_clock.hpp"
#include "tests/unit/platform/socketcan_rig.hpp"

int g_send_errno = 0;
int g_receive_errno = 0;
std::size_t g_receive_calls = 0;
std::int64_t g_wall_clock_ahead_us = 0;

// In the C library's place.
extern "C" ssize_t send(int fd, const void* data, std::size_t length, int flags) {
  if (g_send_errno != 0) {
    errno = g_send_errno;
    return -1;
  }
  return syscall(SYS_sendto, fd, data, length, flags, nullptr, 0);
}

extern "C" int recvmmsg(int fd, mmsghdr* messages, unsigned count, int flags, timespec* timeout) {
  ++g_receive_calls;
  if (g_receive_errno != 0) {
    errno = g_receive_errno;
    return -1;
  }
  return static_cast<int>(syscall(SYS_recvmmsg, fd, messages, count, flags, timeout));
}

extern "C" int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const auto result = static_cast<int>(syscall(SYS_clock_gettime, clock, now));
  if (clock == CLOCK_REALTIME) {
    const std::int64_t ns = now->tv_nsec + g_wall_clock_ahead_us * 1000;
    now->tv_sec += static_cast<time_t>(ns / 1'000'000'000);
    now->tv_nsec = static_cast<long>(ns % 1'000'000'000);
  }
  return result;
}

using namespace graben::test;
using State = CanPortState;

/// With no call failing yet, whatever the test before left.
struct FaultyRig : Rig {
  FaultyRig() {
    g_send_errno = 0;
    g_receive_errno = 0;
  }
};

TEST(a_new_port_is_closed) {
  SocketCanPort port("can7", {}, &open_pair);
  CanFrame frame;
  assert_int_equal(port.state(), State::kClosed);
  assert_int_equal(port.receive(&frame, 1), 0);
  assert_false(port.send(outgoing(1)));
  assert_int_equal(port.counters().dropped_transmit, 1);
  assert_string_equal(port.last_error(), "");
}

TEST(it_asks_for_its_ids_or_for_all) {
  g_next = OpenedCanSocket{};
  SocketCanPort two("can7", {0x18FF5027U, 0x0CF00400U}, &open_pair);
  assert_false(two.open());
  assert_string_equal(g_config.interface.c_str(), "can7");
  assert_int_equal(g_config.filters.size(), 2);
  // Of every priority.
  assert_int_equal(g_config.filters[1].can_id, 0x00F00400U | CAN_EFF_FLAG);
  assert_int_equal(g_config.filters[1].can_mask & CAN_EFF_MASK, 0x03FFFFFFU);
  SocketCanPort all("can8", {}, &open_pair);
  assert_false(all.open());
  assert_true(g_config.filters.empty());
}

TEST(a_full_queue_drops_and_goes_on) {
  FaultyRig rig;
  std::uint32_t sent = 0;
  while (rig.port.send(outgoing(sent))) {
    ++sent;
    assert_true(sent < 10'000);
  }
  assert_true(sent > 0);
  for (const int reason : {ENOBUFS, EAGAIN, EINTR, ENOMEM}) {
    g_send_errno = reason;
    assert_false(rig.port.send(outgoing(0)));
    assert_int_equal(rig.port.state(), State::kActive);
  }
  g_send_errno = 0;
  can_frame seen{};
  for (std::uint32_t i = 0; i < sent; ++i) {
    assert_int_equal(read(g_bus, &seen, sizeof seen), sizeof seen);
    assert_int_equal(seen.can_id, i | CAN_EFF_FLAG);
  }
  // What was dropped is not tried again.
  assert_true(rig.port.send(outgoing(77)));
  assert_int_equal(read(g_bus, &seen, sizeof seen), sizeof seen);
  assert_int_equal(seen.can_id, 77U | CAN_EFF_FLAG);
  assert_int_equal(rig.port.counters().sent, sent + 1);
  assert_int_equal(rig.port.counters().dropped_transmit, 5);
}

TEST(what_no_controller_sends_is_refused) {
  FaultyRig rig;
  CanFrame frame = outgoing(1);
  frame.length = 9;
  assert_false(rig.port.send(frame));
  assert_int_equal(rig.port.counters().dropped_transmit, 1);
  can_frame seen{};
  assert_int_equal(read(g_bus, &seen, sizeof seen), -1);
}

TEST(an_interface_that_goes_is_down_until_opened) {
  for (const int reason : {ENETDOWN, ENODEV, ENXIO}) {
    for (const bool sending : {true, false}) {
      FaultyRig rig;
      from_bus(raw(5U | CAN_EFF_FLAG));
      (sending ? g_send_errno : g_receive_errno) = reason;
      if (sending) {
        assert_false(rig.port.send(outgoing(1)));
      } else {
        assert_int_equal(rig.receive(), 0);
      }
      assert_int_equal(rig.port.state(), State::kDown);
      assert_non_null(
          std::strstr(rig.port.last_error(), sending ? "can7: send: " : "can7: receive: "));
      g_send_errno = 0;
      g_receive_errno = 0;
      // Not even what is queued: it is of before.
      const std::size_t calls = g_receive_calls;
      assert_int_equal(rig.receive(), 0);
      assert_int_equal(g_receive_calls, calls);
      assert_false(rig.port.send(outgoing(1)));
      assert_true(rig.port.open());
      assert_int_equal(rig.port.state(), State::kActive);
      assert_string_equal(rig.port.last_error(), "");
      assert_int_equal(rig.receive(), 0);
      assert_true(rig.port.send(outgoing(1)));
    }
  }
}

TEST(a_short_queue_is_one_call) {
  FaultyRig rig;
  from_bus(raw(5U | CAN_EFF_FLAG));
  g_receive_calls = 0;
  assert_int_equal(rig.receive(), 1);
  assert_int_equal(g_receive_calls, 1);
}

TEST(nothing_to_read_is_no_fault) {
  FaultyRig rig;
  for (const int reason : {EAGAIN, EINTR}) {
    g_receive_errno = reason;
    assert_int_equal(rig.receive(), 0);
    assert_int_equal(rig.port.state(), State::kActive);
  }
  // What is not known takes the safe way.
  g_receive_errno = EBADF;
  assert_int_equal(rig.receive(), 0);
  assert_int_equal(rig.port.state(), State::kDown);
}

TEST(opening_again_discards_what_was_queued) {
  FaultyRig rig;
  from_bus(raw(5U | CAN_EFF_FLAG));
  report(CAN_ERR_BUSOFF);
  assert_true(rig.port.open());
  assert_int_equal(rig.receive(), 0);
  assert_int_equal(rig.port.state(), State::kActive);
  assert_int_equal(rig.port.counters().error_frames, 0);
  assert_int_equal(rig.port.counters().reopened, 1);
  from_bus(raw(6U | CAN_EFF_FLAG));
  assert_int_equal(rig.receive(), 1);
  assert_int_equal(rig.frames[0].id, 6);
}

TEST(the_old_socket_is_closed) {
  FaultyRig rig;
  const int old_bus = dup(g_bus);
  assert_true(rig.port.open());
  const can_frame frame = raw(5U | CAN_EFF_FLAG);
  assert_int_equal(write(old_bus, &frame, sizeof frame), -1);
  close(old_bus);
}

/// The kernel's stamps go on by the true clock here; only what the port reads is ahead.
TEST(a_step_of_the_wall_clock_makes_no_frame_old) {
  constexpr TimeUs kStepUs = 500'000;
  FaultyRig rig;
  from_bus(raw(5U | CAN_EFF_FLAG));
  assert_int_equal(rig.receive(), 1);
  from_bus(raw(5U | CAN_EFF_FLAG));
  g_wall_clock_ahead_us = kStepUs;
  const TimeUs before_us = monotonic_now_us();
  assert_int_equal(rig.receive(), 1);
  assert_true(rig.frames[0].stamp_us >= before_us);
  // The queue was empty since: stamps count again.
  from_bus(raw(5U | CAN_EFF_FLAG));
  assert_int_equal(rig.receive(), 1);
  g_wall_clock_ahead_us = 0;
  assert_true(rig.frames[0].stamp_us <= monotonic_now_us() - kStepUs);
}

TEST(the_state_found_on_opening_counts) {
  FaultyRig rig;
  for (const State found : {State::kErrorPassive, State::kBusOff}) {
    g_next.state = found;
    assert_true(rig.port.open());
    assert_int_equal(rig.port.state(), found);
    assert_int_equal(rig.port.send(outgoing(1)), found == State::kErrorPassive);
  }
}

TEST(a_failed_opening_says_why) {
  FaultyRig rig;
  g_next = OpenedCanSocket{};
  g_next.error.set("no bus today");
  assert_false(rig.port.open());
  assert_int_equal(rig.port.state(), State::kDown);
  assert_string_equal(rig.port.last_error(), "no bus today");
  assert_int_equal(rig.receive(), 0);
  assert_false(rig.port.send(outgoing(1)));
  assert_int_equal(rig.port.counters().reopened, 0);
  g_next = OpenedCanSocket{};
  g_next.state = State::kActive;
  assert_true(rig.port.open());
  assert_string_equal(rig.port.last_error(), "");
  assert_int_equal(rig.port.counters().reopened, 1);
}

/// Here and anywhere: with CAN or without it in the kernel, no interface has these names.
TEST(the_real_opener_names_what_is_missing) {
  g_send_errno = 0;
  for (const char* const name : {"", "no-such-can", "a-name-that-is-too-long"}) {
    SocketCanPort port(name, {0x18FF5027U});
    assert_false(port.open());
    assert_int_equal(port.state(), State::kDown);
    const bool no_can = std::strstr(port.last_error(), "modprobe can-raw") != nullptr;
    const char* const reason = std::strlen(name) == 11 ? "no-such-can: No such device" : "'";
    assert_true(no_can || std::strstr(port.last_error(), reason) == port.last_error());
  }
}

TEST(a_cycle_and_an_opening_allocate_nothing) {
  FaultyRig rig;
  SocketCanPort real("no-such-can", {0x18FF5027U});
  const std::uint64_t before = allocation_count();
  assert_false(real.open());
  for (unsigned char i = 0; i < 5; ++i) {
    from_bus(raw(CAN_EFF_FLAG, i));
    report(CAN_ERR_PROT);
  }
  const int count = rig.receive();
  const bool sent = rig.port.send(outgoing(1));
  assert_int_equal(allocation_count() - before, 0);
  assert_int_equal(count, 5);
  assert_true(sent);
}
