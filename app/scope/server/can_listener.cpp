// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/can_listener.hpp"

#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include "platform/linux/can_frames.hpp"

namespace graben::scope {
namespace {

/// For 100 ms of a full bus of 1 Mbit/s, some 800 frames at a kilobyte each; the kernel gives what
/// it may.
constexpr int kReceiveBufferBytes = 1024 * 1024;
/// A bus that brings more than this at once must not keep the other ones waiting.
constexpr int kMostAtOnce = 4096;

struct Received {
  can_frame frame{};
  timespec stamp{};
  std::uint32_t lost = 0;
  bool has_lost = false;
};

template <class T>
bool read(const cmsghdr& header, T& to) {
  if (header.cmsg_len < CMSG_LEN(sizeof to)) {
    return false;
  }
  std::memcpy(&to, CMSG_DATA(&header), sizeof to);
  return true;
}

void read_ancillary(msghdr& message, Received& received) {
  bool has_stamp = false;
  for (cmsghdr* item = CMSG_FIRSTHDR(&message); item != nullptr;
       item = CMSG_NXTHDR(&message, item)) {
    if (item->cmsg_level == SOL_SOCKET && item->cmsg_type == SCM_TIMESTAMPNS) {
      has_stamp = read(*item, received.stamp);
    } else if (item->cmsg_level == SOL_SOCKET && item->cmsg_type == SO_RXQ_OVFL) {
      received.has_lost = read(*item, received.lost);
    }
  }
  if (!has_stamp) {
    static_cast<void>(clock_gettime(CLOCK_REALTIME, &received.stamp));
  }
}

/// 1: a frame. 0: something else, to be left out. -1: nothing, with errno.
int receive(int fd, Received& received) {
  alignas(cmsghdr) std::array<char, 128> control{};
  iovec data = {&received.frame, sizeof received.frame};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t size = recvmsg(fd, &message, MSG_DONTWAIT);
  if (size < 0) {
    return -1;
  }
  read_ancillary(message, received);
  return size == CAN_MTU && (message.msg_flags & MSG_TRUNC) == 0 ? 1 : 0;
}

/// Everything that candump hears, where the port of a controller asks for less.
void ask_for_all(int fd) {
  const can_err_mask_t errors = CAN_ERR_MASK;
  // A kernel that does not give these still gives the frames.
  static_cast<void>(setsockopt(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors));
  static_cast<void>(
      setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &kReceiveBufferBytes, sizeof kReceiveBufferBytes));
}

}  // namespace

CanListener::CanListener(CanListener&& other) noexcept
    : interface_(std::move(other.interface_)),
      opener_(other.opener_),
      fd_(std::exchange(other.fd_, -1)),
      lost_(other.lost_),
      socket_lost_(other.socket_lost_),
      error_(other.error_) {}

CanListener::~CanListener() { close(); }

void CanListener::close() {
  if (fd_ >= 0) {
    static_cast<void>(::close(std::exchange(fd_, -1)));
  }
}

bool CanListener::open() {
  close();
  CanSocketConfig config;
  config.interface = interface_;
  const OpenedCanSocket opened = opener_(config);
  fd_ = opened.fd;
  error_ = opened.error;
  socket_lost_ = 0;
  if (fd_ < 0) {
    return false;
  }
  ask_for_all(fd_);
  return true;
}

void CanListener::hear(const std::function<void(const CanFrame&)>& frame) {
  for (int i = 0; i < kMostAtOnce && fd_ >= 0; ++i) {
    Received received;
    const int result = receive(fd_, received);
    if (result < 0 && errno == EINTR) {
      continue;
    }
    if (result < 0) {
      if (errno != EAGAIN && errno != EWOULDBLOCK) {
        error_.set("%s: %s", interface_.c_str(), error_words(errno));
        close();
      }
      return;
    }
    if (received.has_lost) {
      lost_ +=
          static_cast<std::uint32_t>(received.lost - std::exchange(socket_lost_, received.lost));
    }
    if (result > 0) {
      const TimeUs stamp_us =
          TimeUs{received.stamp.tv_sec} * kSecondUs + received.stamp.tv_nsec / 1000;
      frame(from_socketcan(received.frame, stamp_us));
    }
  }
}

}  // namespace graben::scope
