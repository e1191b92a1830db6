// SPDX-License-Identifier: Apache-2.0
/// What a controller leaves on the bus when a signal ends it.

#include "app/ecu/end_signals.hpp"

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <vector>

#include "platform/can_port_group.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using ecu::EndSignals;
using ecu::LastFrames;

std::array<int, 2> g_wire{-1, -1};

OpenedCanSocket open_wire(const CanSocketConfig&) {
  OpenedCanSocket result;
  result.fd = dup(g_wire[0]);
  result.state = CanPortState::kActive;
  return result;
}

CanFrame frame_with(std::uint8_t first) {
  CanFrame frame;
  frame.id = 0x0CFF3082;
  frame.length = 8;
  frame.data = {first, 1, 2, 3, 4, 5, 6, 7};
  return frame;
}

/// What a child did and said whose controller was caught in `body`.
struct Ended {
  int signal = 0;  ///< That ended it; 0 if it went on to its own end ...
  int status = 0;  ///< ... with this: 0 if it was asked to stop.
  std::array<std::uint8_t, 8> first{};
  int frames = 0;
};

template <class Body>
Ended end_of(const Body& body) {
  assert_int_equal(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, g_wire.data()), 0);
  const pid_t child = fork();
  if (child == 0) {
    std::deque<SocketCanPort> ports;
    ports.emplace_back("wire", std::vector<std::uint32_t>{}, &open_wire);
    LastFrames last;
    bool good = ports.back().open();
    const EndSignals signals(last, ports);
    good = good && signals.error().empty();
    const std::array<CanFrame, 2> older = {frame_with(1), frame_with(2)};
    const std::array<CanFrame, 2> newer = {frame_with(3), frame_with(4)};
    last.put(older);
    last.put(newer);
    body();
    _exit(good && stop_requested() ? 0 : 1);
  }
  Ended ended;
  int status = -1;
  assert_int_equal(waitpid(child, &status, 0), child);
  ended.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  can_frame raw{};
  while (recv(g_wire[1], &raw, sizeof raw, MSG_DONTWAIT) == static_cast<ssize_t>(sizeof raw)) {
    assert_int_equal(raw.can_id, 0x0CFF3082U | CAN_EFF_FLAG);
    ended.first.at(static_cast<std::size_t>(ended.frames++)) = raw.data[0];
  }
  close(g_wire[0]);
  close(g_wire[1]);
  return ended;
}

TEST(a_request_is_left_to_the_cycle) {
  for (const int signal :
       {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGPIPE, SIGALRM, SIGVTALRM, SIGPROF,
        SIGIO, SIGPWR, SIGSTKFLT, SIGXFSZ, SIGRTMIN, SIGRTMAX}) {
    const Ended ended = end_of([signal] { raise(signal); });
    assert_int_equal(ended.signal, 0);
    assert_int_equal(ended.status, 0);
    assert_int_equal(ended.frames, 0);
  }
}

TEST(the_second_request_ends_it_neutral) {
  const Ended ended = end_of([] {
    raise(SIGTERM);
    raise(SIGHUP);
    raise(SIGTERM);
  });
  assert_int_equal(ended.signal, SIGTERM);
  assert_int_equal(ended.frames, 2);
}

/// The newest frames, each once, in their order; then what the signal does anyway.
TEST(a_failure_ends_it_neutral) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP, SIGXCPU}) {
    const Ended ended = end_of([signal] { raise(signal); });
    assert_int_equal(ended.signal, signal);
    assert_int_equal(ended.frames, 2);
    assert_int_equal(ended.first[0], 3);
    assert_int_equal(ended.first[1], 4);
  }
}

TEST(abort_ends_it_neutral) {
  const Ended ended = end_of([] { std::abort(); });
  assert_int_equal(ended.signal, SIGABRT);
  assert_int_equal(ended.frames, 2);
}

/// As many as a controller with a bus profile may have.
TEST(none_is_left_out) {
  LastFrames last;
  std::array<CanFrame, LastFrames::kMost> many;
  for (std::size_t i = 0; i < many.size(); ++i) {
    many[i] = frame_with(static_cast<std::uint8_t>(i));
  }
  last.put(many);
  assert_int_equal(last.get().count, many.size());
  assert_int_equal(last.get().frame.back().data[0], many.size() - 1);
  last.put(many, 7);
  assert_int_equal(last.get().count, 7);
}

/// First bytes of what is on a wire.
std::vector<int> on_wire(int descriptor) {
  std::vector<int> first;
  can_frame raw{};
  while (recv(descriptor, &raw, sizeof raw, MSG_DONTWAIT) == static_cast<ssize_t>(sizeof raw)) {
    first.push_back(raw.data[0]);
  }
  return first;
}

/// What is for one bus is on no other; what is for any is on all.
TEST(a_frame_ends_on_the_bus_that_it_is_for) {
  std::array<std::array<int, 2>, 2> wires{};
  for (auto& wire : wires) {
    assert_int_equal(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, wire.data()), 0);
  }
  const pid_t child = fork();
  if (child == 0) {
    std::deque<SocketCanPort> ports;
    bool good = true;
    for (const auto& wire : wires) {
      g_wire = wire;
      ports.emplace_back("wire", std::vector<std::uint32_t>{}, &open_wire);
      good = ports.back().open() && good;
    }
    LastFrames last;
    const EndSignals signals(last, ports);
    std::array<CanFrame, 4> frames = {frame_with(1), frame_with(2), frame_with(3), frame_with(4)};
    frames[0].bus = 1;
    frames[1].bus = 0;
    frames[3].bus = 2;
    last.put(frames);
    raise(good && signals.error().empty() ? SIGSEGV : SIGKILL);
  }
  int status = -1;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_int_equal(WTERMSIG(status), SIGSEGV);
  assert_true(on_wire(wires[0][1]) == (std::vector<int>{2, 3}));
  assert_true(on_wire(wires[1][1]) == (std::vector<int>{1, 3}));
  for (const auto& wire : wires) {
    close(wire[0]);
    close(wire[1]);
  }
}

TEST(more_interfaces_than_there_is_room_for_are_an_error) {
  std::deque<SocketCanPort> ports;
  for (std::size_t i = 0; i <= CanPortGroup::kMost; ++i) {
    ports.emplace_back("wire", std::vector<std::uint32_t>{}, &open_wire);
  }
  const LastFrames last;
  const EndSignals signals(last, ports);
  assert_string_equal(signals.error().c_str(), "more than 4 interfaces");
}
