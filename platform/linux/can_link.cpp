#include "platform/linux/can_link.hpp"

#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

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

}  // namespace graben
