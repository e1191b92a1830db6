// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/can_socket.hpp"

#include <linux/can/netlink.h>
#include <linux/can/raw.h>
#include <linux/if_link.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstring>

#include "platform/linux/can_frames.hpp"

namespace graben {
namespace {

struct Bytes {
  const unsigned char* data = nullptr;
  std::size_t length = 0;
};

constexpr std::size_t aligned(std::size_t length) {
  return (length + NLA_ALIGNTO - 1) & ~std::size_t{NLA_ALIGNTO - 1};
}

Bytes after(const Bytes& bytes, std::size_t skipped) {
  return skipped >= bytes.length ? Bytes{} : Bytes{bytes.data + skipped, bytes.length - skipped};
}

/// Copies the head of a message: its place need not be aligned for T.
template <class T>
bool read(const Bytes& from, T& to) {
  if (from.length < sizeof to) {
    return false;
  }
  std::memcpy(&to, from.data, sizeof to);
  return true;
}

/// The payload of the first attribute of this type; none if there is no such.
Bytes attribute(Bytes attributes, unsigned type) {
  nlattr head{};
  while (read(attributes, head) && head.nla_len >= sizeof head &&
         head.nla_len <= attributes.length) {
    if ((head.nla_type & NLA_TYPE_MASK) == type) {
      return {attributes.data + sizeof head, head.nla_len - sizeof head};
    }
    attributes = after(attributes, aligned(head.nla_len));
  }
  return {};
}

struct LinkRequest {
  nlmsghdr header{};
  ifinfomsg info{};
  nlattr mask_head{};
  std::uint32_t mask = RTEXT_FILTER_SKIP_STATS;
};

/// Why the kernel does not tell, should the answer be an error.
int refusal(const void* message, std::size_t length) {
  const Bytes bytes{static_cast<const unsigned char*>(message), length};
  nlmsghdr header{};
  nlmsgerr reason{};
  const bool given = read(bytes, header) && header.nlmsg_type == NLMSG_ERROR &&
                     read(after(bytes, sizeof header), reason);
  return given ? -reason.error : EBADMSG;
}

bool exchange(int fd, int interface_index, CanLink& link) {
  LinkRequest request;
  request.header.nlmsg_len = sizeof request;
  request.header.nlmsg_type = RTM_GETLINK;
  request.header.nlmsg_flags = NLM_F_REQUEST;
  request.info.ifi_index = interface_index;
  request.mask_head.nla_len = sizeof request.mask_head + sizeof request.mask;
  request.mask_head.nla_type = IFLA_EXT_MASK;
  if (send(fd, &request, sizeof request, 0) < 0) {
    return false;
  }
  // The kernel has queued the answer by now; there is nothing to wait for.
  std::array<unsigned char, 8192> answer{};
  const ssize_t length = recv(fd, answer.data(), answer.size(), MSG_DONTWAIT);
  if (length < 0) {
    return false;
  }
  errno = refusal(answer.data(), static_cast<std::size_t>(length));
  return parse_link(answer.data(), static_cast<std::size_t>(length), link);
}

}  // namespace

bool parse_link(const void* message, std::size_t length, CanLink& link) {
  Bytes rest{static_cast<const unsigned char*>(message), length};
  nlmsghdr header{};
  if (!read(rest, header) || header.nlmsg_type != RTM_NEWLINK || header.nlmsg_len > length) {
    return false;
  }
  rest.length = header.nlmsg_len;
  rest = after(rest, sizeof header);
  ifinfomsg info{};
  if (!read(rest, info)) {
    return false;
  }
  link = CanLink{};
  link.is_can = info.ifi_type == ARPHRD_CAN;
  link.is_up = (info.ifi_flags & IFF_UP) != 0;
  const Bytes link_info = attribute(after(rest, sizeof info), IFLA_LINKINFO);
  const Bytes kind = attribute(link_info, IFLA_INFO_KIND);
  // The numbers of the data's attributes belong to the kind; vcan and others use them differently.
  constexpr char kKind[] = "can";  // with its end, as the kernel sends it
  if (kind.length == sizeof kKind && std::memcmp(kind.data, kKind, sizeof kKind) == 0) {
    link.has_state =
        read(attribute(attribute(link_info, IFLA_INFO_DATA), IFLA_CAN_STATE), link.state);
  }
  return true;
}

CanPortState state_of(const CanLink& link) {
  if (!link.is_can || !link.is_up) {
    return CanPortState::kDown;
  }
  if (!link.has_state) {
    return CanPortState::kActive;
  }
  switch (link.state) {
    case CAN_STATE_ERROR_ACTIVE:
    case CAN_STATE_ERROR_WARNING:
      return CanPortState::kActive;
    case CAN_STATE_ERROR_PASSIVE:
      return CanPortState::kErrorPassive;
    case CAN_STATE_BUS_OFF:
      return CanPortState::kBusOff;
    default:
      break;
  }
  return CanPortState::kDown;
}

bool query_link(int interface_index, CanLink& link, ErrorText& error) {
  const int fd = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE);
  if (fd < 0) {
    error.set("socket(AF_NETLINK): %s", error_words(errno));
    return false;
  }
  const bool answered = exchange(fd, interface_index, link);
  if (!answered) {
    error.set("state of the interface: %s", error_words(errno));
  }
  static_cast<void>(close(fd));
  return answered;
}

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
