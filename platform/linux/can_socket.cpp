#include "platform/linux/can_socket.hpp"

#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "platform/linux/can_errors.hpp"
#include "platform/linux/can_link.hpp"

namespace graben {
namespace {

/// Asks for the least that the kernel gives: 4608 bytes on x86-64, charged with 704 to 1024 for a
/// frame, are the five to seven frames that wait in the interface's queue; a cycle of ours has one
/// to five. What the controller has taken over is no longer charged.
constexpr int kSendBufferBytes = 1;

bool set_option(int fd, int level, int option, const void* value, std::size_t length) {
  return setsockopt(fd, level, option, value, static_cast<socklen_t>(length)) == 0;
}

bool set_option(int fd, int level, int option, int value) {
  return set_option(fd, level, option, &value, sizeof value);
}

bool configure(int fd, const CanSocketConfig& config, ErrorText& error) {
  const can_err_mask_t error_classes = kCanErrorClasses;
  // An empty list would let nothing pass; without one everything does.
  const bool filtered =
      config.filters.empty() || set_option(fd, SOL_CAN_RAW, CAN_RAW_FILTER, config.filters.data(),
                                           config.filters.size() * sizeof(can_filter));
  if (!filtered ||
      !set_option(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &error_classes, sizeof error_classes) ||
      !set_option(fd, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, 0) ||
      !set_option(fd, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, 0) ||
      !set_option(fd, SOL_SOCKET, SO_SNDBUF, kSendBufferBytes) ||
      !set_option(fd, SOL_SOCKET, SO_RXQ_OVFL, 1) ||
      !set_option(fd, SOL_SOCKET, SO_TIMESTAMPNS, 1)) {
    error.set("%s: setsockopt: %s", config.interface.c_str(), error_words(errno));
    return false;
  }
  return true;
}

/// The interface's index; 0 if there is none of this name.
int interface_index(int fd, const std::string& name, ErrorText& error) {
  ifreq request{};
  if (name.empty() || name.size() >= sizeof request.ifr_name) {
    error.set("'%s': an interface's name has 1 to %zu characters", name.c_str(),
              sizeof request.ifr_name - 1);
    return 0;
  }
  std::memcpy(request.ifr_name, name.data(), name.size());
  if (ioctl(fd, SIOCGIFINDEX, &request) != 0) {
    error.set("%s: %s; is the interface there (ip link show)?", name.c_str(), error_words(errno));
    return 0;
  }
  return request.ifr_ifindex;
}

bool bind_to(int fd, int index, const std::string& name, ErrorText& error) {
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index;
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    error.set("%s: bind: %s; is it a CAN interface?", name.c_str(), error_words(errno));
    return false;
  }
  return true;
}

/// The state as it is now. After bind: a change from there on comes as an error frame.
CanPortState current_state(int index, const std::string& name, ErrorText& error) {
  CanLink link;
  if (!query_link(index, link, error)) {
    return CanPortState::kDown;
  }
  const CanPortState state = state_of(link);
  if (state == CanPortState::kDown) {
    error.set("%s: the interface is %s (ip -details link show %s)", name.c_str(),
              link.is_up ? "up, but its controller is stopped" : "down", name.c_str());
  }
  return state;
}

}  // namespace

OpenedCanSocket open_can_socket(const CanSocketConfig& config) {
  OpenedCanSocket result;
  const int fd = socket(AF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (fd < 0) {
    result.error.set("socket(AF_CAN): %s; needs a kernel with CAN (modprobe can-raw)",
                     error_words(errno));
    return result;
  }
  const int index = interface_index(fd, config.interface, result.error);
  if (index != 0 && configure(fd, config, result.error) &&
      bind_to(fd, index, config.interface, result.error)) {
    result.state = current_state(index, config.interface, result.error);
  }
  if (result.state == CanPortState::kDown) {
    static_cast<void>(close(fd));
    return result;
  }
  result.fd = fd;
  return result;
}

}  // namespace graben
