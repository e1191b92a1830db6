// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/socketcan_port.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include "platform/linux/can_frames.hpp"
#include "platform/linux/cyclic_clock.hpp"

namespace graben {
namespace {

/// A controller that reports each error may bring thousands a second; these are enough to learn
/// the state, and a cycle's time stays bounded.
constexpr int kMaxErrorFramesPerCall = 128;

TimeUs microseconds(const timespec& time) {
  return TimeUs{time.tv_sec} * kSecondUs + time.tv_nsec / 1000;
}

TimeUs wall_now_us() {
  timespec now{};
  static_cast<void>(clock_gettime(CLOCK_REALTIME, &now));
  return microseconds(now);
}

CanSocketConfig config_of(std::string interface, const std::vector<std::uint32_t>& receive_ids) {
  CanSocketConfig config;
  config.interface = std::move(interface);
  config.filters.reserve(receive_ids.size());
  for (const std::uint32_t id : receive_ids) {
    config.filters.push_back(message_filter(id));
  }
  return config;
}

/// What the kernel says of a frame beside its bytes.
struct Ancillary {
  bool has_stamp = false;
  bool has_overflow = false;
  TimeUs wall_stamp_us = 0;
  std::uint32_t overflow = 0;
};

template <class T>
bool read(const cmsghdr& header, T& to) {
  if (header.cmsg_len < CMSG_LEN(sizeof to)) {
    return false;
  }
  std::memcpy(&to, CMSG_DATA(&header), sizeof to);
  return true;
}

Ancillary ancillary_of(msghdr header) {
  Ancillary result;
  for (cmsghdr* item = CMSG_FIRSTHDR(&header); item != nullptr; item = CMSG_NXTHDR(&header, item)) {
    if (item->cmsg_level != SOL_SOCKET) {
      continue;
    }
    if (item->cmsg_type == SCM_TIMESTAMPNS) {
      timespec stamp{};
      result.has_stamp = read(*item, stamp);
      result.wall_stamp_us = microseconds(stamp);
    } else if (item->cmsg_type == SO_RXQ_OVFL) {
      result.has_overflow = read(*item, result.overflow);
    }
  }
  return result;
}

}  // namespace

SocketCanPort::SocketCanPort(std::string interface, const std::vector<std::uint32_t>& receive_ids,
                             Opener opener)
    : config_(config_of(std::move(interface), receive_ids)), opener_(opener) {
  for (std::size_t i = 0; i < kBatch; ++i) {
    slots_[i].data = {&slots_[i].frame, sizeof slots_[i].frame};
    messages_[i].msg_hdr.msg_iov = &slots_[i].data;
    messages_[i].msg_hdr.msg_iovlen = 1;
    messages_[i].msg_hdr.msg_control = slots_[i].control.data();
  }
}

SocketCanPort::~SocketCanPort() { close_socket(); }

void SocketCanPort::close_socket() {
  if (fd_ >= 0) {
    static_cast<void>(close(fd_));
    fd_ = -1;
  }
}

bool SocketCanPort::open() {
  close_socket();
  const OpenedCanSocket opened = opener_(config_);
  fd_ = opened.fd;
  state_ = opened.state;
  worst_ = opened.state;
  error_ = opened.error;
  socket_overflow_ = 0;
  if (fd_ < 0) {
    return false;
  }
  counters_.reopened += was_open_ ? 1 : 0;
  was_open_ = true;
  return true;
}

void SocketCanPort::go_down(const char* call, int error_number) {
  // The socket stays until it is opened again: closing it may wait for the kernel.
  state_ = CanPortState::kDown;
  error_.set("%s: %s: %s", config_.interface.c_str(), call, error_words(error_number));
}

int SocketCanPort::read_batch(std::size_t limit) {
  const auto wanted = static_cast<unsigned>(std::min(limit, kBatch));
  for (unsigned i = 0; i < wanted; ++i) {
    messages_[i].msg_hdr.msg_controllen = kControlBytes;  // the kernel has put in what it used
  }
  const int count = recvmmsg(fd_, messages_.data(), wanted, MSG_DONTWAIT, nullptr);
  if (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
    go_down("receive", errno);
  }
  stamp_.set_now(monotonic_now_us(), wall_now_us());
  return std::max(count, 0);
}

void SocketCanPort::note_overflow(std::uint32_t total) {
  counters_.receive_overflow += static_cast<std::uint32_t>(total - socket_overflow_);
  socket_overflow_ = total;
}

bool SocketCanPort::accept(const mmsghdr& message, const Slot& slot, CanFrame& frame) {
  const Ancillary ancillary = ancillary_of(message.msg_hdr);
  if (ancillary.has_overflow) {
    note_overflow(ancillary.overflow);
  }
  if (message.msg_len != CAN_MTU || (message.msg_hdr.msg_flags & MSG_TRUNC) != 0) {
    ++counters_.wrong_frames;
    return false;
  }
  if ((slot.frame.can_id & CAN_ERR_FLAG) != 0) {
    ++counters_.error_frames;
    counters_.receive_overflow += reports_lost_frames(slot.frame) ? 1 : 0;
    state_ = next_state(state_, slot.frame);
    worst_ = std::max(worst_, state_);
    return false;
  }
  ++counters_.received;
  frame = from_socketcan(
      slot.frame,
      stamp_.monotonic_us(ancillary.has_stamp ? ancillary.wall_stamp_us : INT64_MIN / 2));
  return true;
}

int SocketCanPort::receive(CanFrame* frames, int capacity) {
  int count = 0;
  int others = 0;
  worst_ = CanPortState::kClosed;
  while (count < capacity && others < kMaxErrorFramesPerCall && fd_ >= 0 &&
         state_ != CanPortState::kDown) {
    const auto limit = static_cast<std::size_t>(capacity - count);
    const int taken = read_batch(limit);
    for (int i = 0; i < taken; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      if (accept(messages_[slot], slots_[slot], frames[count])) {
        ++count;
      } else {
        ++others;
      }
    }
    if (static_cast<std::size_t>(taken) < std::min(limit, kBatch)) {
      stamp_.queue_is_empty();
      break;
    }
  }
  return count;
}

bool SocketCanPort::send(const CanFrame& frame) {
  const bool on_bus = state_ == CanPortState::kActive || state_ == CanPortState::kErrorPassive;
  can_frame raw{};
  if (!on_bus || !to_socketcan(frame, raw)) {
    ++counters_.dropped_transmit;
    return false;
  }
  if (::send(fd_, &raw, sizeof raw, MSG_DONTWAIT | MSG_NOSIGNAL) ==
      static_cast<ssize_t>(sizeof raw)) {
    ++counters_.sent;
    return true;
  }
  ++counters_.dropped_transmit;
  if (errno == ENETDOWN || errno == ENODEV || errno == ENXIO) {
    go_down("send", errno);
  }
  return false;
}

}  // namespace graben
