// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A CAN bus behind a raw socket of the Linux kernel.
///
/// Stale commands. A frame that send() accepted cannot be taken back, not by closing the socket
/// either: it waits in the interface's queue, then in the controller, which repeats it until
/// somebody acknowledges. A bus that comes back may so begin with frames from before it went.
/// What is done about it:
/// - at most about one cycle's frames can wait in the queue: the socket's send buffer is the least
///   that the kernel gives, and what finds no room is dropped, counted and never tried again;
/// - nothing is sent in bus-off or on an interface that is down, so no frame of that time can wait;
/// - the kernel empties the controller when it restarts after bus-off, and the queue when an
///   interface is set down; it empties the queue also in bus-off, but up to a second late: a
///   `restart-ms` of 0 (the default: no restart by itself) or above 1000 leaves nothing over.
/// What is left, and why it must not move anything: some frames of the first cycle after the last
/// acknowledged one, on a bus that was open or error-passive. Their counters go on where the valve
/// side heard the last one. It must therefore have closed by its own timeout (100 ms) and want a
/// run of good frames, then neutral ones, before it opens again. No port can do that for it.

#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hal/can_port.hpp"
#include "platform/linux/can_frames.hpp"
#include "platform/linux/can_socket.hpp"
#include "platform/linux/process.hpp"

namespace graben {

/// What became of frames; over all sockets that the port had, since it was made.
struct CanPortCounters {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;              ///< Accepted by the kernel; not yet on the bus for that.
  std::uint64_t receive_overflow = 0;  ///< Lost as the socket's queue or the controller was full.
  std::uint64_t dropped_transmit = 0;  ///< send() returned false.
  std::uint64_t error_frames = 0;
  std::uint64_t wrong_frames = 0;  ///< Not a classic frame by its size.
  std::uint64_t reopened = 0;      ///< Successful open() but the first.
};

// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor): final, and CanPort deletes nothing.
class SocketCanPort final : public CanPort {
 public:
  /// Makes the socket; another one than open_can_socket is for tests.
  using Opener = OpenedCanSocket (*)(const CanSocketConfig&);

  /// Closed at first. Takes data frames of these messages only (message_filter), and every frame if
  /// there are none. Allocates here and nowhere else.
  SocketCanPort(std::string interface, const std::vector<std::uint32_t>& receive_ids,
                Opener opener = &open_can_socket);
  ~SocketCanPort();
  SocketCanPort(const SocketCanPort&) = delete;
  SocketCanPort& operator=(const SocketCanPort&) = delete;

  /// A new socket, and with it an empty queue. True with state kBusOff or kErrorPassive if that is
  /// how the controller is; false, with last_error(), if there is no bus. May wait while somebody
  /// configures interfaces (see open_can_socket).
  ///
  /// Also the way out of a state whose end was not heard of: error frames are lost when the queue
  /// overflows. A port that stays kErrorPassive or kBusOff should be opened again now and then.
  [[nodiscard]] bool open() override;

  /// Frames come with the time of their reception on CLOCK_MONOTONIC. Error frames make the state
  /// and are not handed out; after 128 of them in one call the rest waits for the next.
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override;

  /// One system call that does not wait. False in every state but kActive and kErrorPassive.
  [[nodiscard]] bool send(const CanFrame& frame) override;

  /// The worst since the last receive() began: a bus-off that begins and ends within one call is
  /// still seen.
  [[nodiscard]] CanPortState state() const override { return std::max(state_, worst_); }

  [[nodiscard]] const CanPortCounters& counters() const { return counters_; }
  /// Of the socket, -1 without one: for a signal handler, which may not call send().
  [[nodiscard]] int descriptor() const { return fd_.load(std::memory_order_relaxed); }
  /// Why the last open() failed, or what took the interface away after it; empty if nothing did.
  [[nodiscard]] const char* last_error() const { return error_.c_str(); }

 private:
  static constexpr std::size_t kBatch = 32;
  static constexpr std::size_t kControlBytes = 128;

  /// Where the kernel puts a frame and what it says of it.
  struct Slot {
    can_frame frame;
    iovec data;
    alignas(std::max_align_t) std::array<unsigned char, kControlBytes> control;
  };

  void close_socket();
  void go_down(const char* call, int error_number);
  int read_batch(std::size_t limit);
  bool accept(const mmsghdr& message, const Slot& slot, CanFrame& frame);
  void note_overflow(std::uint32_t total);

  CanSocketConfig config_;
  Opener opener_;
  std::atomic<int> fd_{-1};  ///< A signal handler reads it too.
  bool was_open_ = false;
  CanPortState state_ = CanPortState::kClosed;
  CanPortState worst_ = CanPortState::kClosed;  ///< Since the last receive() began.
  std::uint32_t socket_overflow_ = 0;           ///< Of this socket, as the kernel counts.
  CanPortCounters counters_;
  ErrorText error_;
  ReceiveStamp stamp_;
  std::array<Slot, kBatch> slots_{};
  std::array<mmsghdr, kBatch> messages_{};
};

}  // namespace graben
