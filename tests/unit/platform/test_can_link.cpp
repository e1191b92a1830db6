// SPDX-License-Identifier: Apache-2.0
// The kernel's answer on an interface, made by hand and asked for.

#include "platform/linux/can_socket.hpp"

#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>

#include <cstring>
#include <string>
#include <vector>

#include "tests/unit/cmocka_cpp.hpp"

using Buffer = std::vector<unsigned char>;

template <class T>
void append(Buffer& to, const T& value) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(&value);
  to.insert(to.end(), bytes, bytes + sizeof value);
}

Buffer attribute(unsigned type, const Buffer& payload) {
  Buffer result;
  nlattr head{};
  head.nla_len = static_cast<std::uint16_t>(sizeof head + payload.size());
  head.nla_type = static_cast<std::uint16_t>(type);
  append(result, head);
  result.insert(result.end(), payload.begin(), payload.end());
  result.resize((result.size() + 3) / 4 * 4);
  return result;
}

Buffer text(const std::string& words) {
  return {words.begin(), words.end() + 1};  // with its end, as the kernel sends it
}

Buffer number(std::uint32_t value) {
  Buffer result;
  append(result, value);
  return result;
}

Buffer operator+(Buffer left, const Buffer& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

Buffer message(unsigned short type, unsigned flags, const Buffer& attributes,
               std::uint16_t kind = RTM_NEWLINK) {
  nlmsghdr header{};
  ifinfomsg info{};
  info.ifi_type = type;
  info.ifi_flags = flags;
  header.nlmsg_type = kind;
  header.nlmsg_len = static_cast<std::uint32_t>(sizeof header + sizeof info + attributes.size());
  Buffer result;
  append(result, header);
  append(result, info);
  return result + attributes;
}

/// As a controller's interface has it, with others of its attributes around what is read.
Buffer can_attributes(std::uint32_t state, const std::string& kind = "can") {
  const Buffer data = attribute(IFLA_CAN_CLOCK, number(8'000'000)) +
                      attribute(IFLA_CAN_STATE, number(state)) +
                      attribute(IFLA_CAN_RESTART_MS, number(0));
  return attribute(IFLA_IFNAME, text("can0")) +
         attribute(IFLA_LINKINFO | NLA_F_NESTED,
                   attribute(IFLA_INFO_KIND, text(kind)) + attribute(IFLA_INFO_DATA, data)) +
         attribute(IFLA_MTU, number(16));
}

CanLink parsed(const Buffer& bytes) {
  CanLink link;
  assert_true(parse_link(bytes.data(), bytes.size(), link));
  return link;
}

TEST(a_controller_has_a_state) {
  const CanLink link = parsed(message(ARPHRD_CAN, IFF_UP, can_attributes(CAN_STATE_BUS_OFF)));
  assert_true(link.is_can);
  assert_true(link.is_up);
  assert_true(link.has_state);
  assert_int_equal(link.state, CAN_STATE_BUS_OFF);
}

TEST(flags_and_type_are_told) {
  const CanLink down =
      parsed(message(ARPHRD_CAN, IFF_RUNNING, can_attributes(CAN_STATE_ERROR_ACTIVE)));
  assert_false(down.is_up);
  assert_true(down.is_can);
  assert_false(parsed(message(ARPHRD_ETHER, IFF_UP, {})).is_can);
}

TEST(a_virtual_interface_has_none) {
  // Of another kind the same number may be anything.
  for (const char* const kind : {"vcan", "vxcan", "canx", "cab", "ca", ""}) {
    assert_false(parsed(message(ARPHRD_CAN, IFF_UP, can_attributes(3, kind))).has_state);
  }
  assert_false(parsed(message(ARPHRD_CAN, IFF_UP, {})).has_state);
  assert_false(parsed(message(ARPHRD_CAN, IFF_UP, attribute(IFLA_LINKINFO, {}))).has_state);
}

TEST(anything_else_is_refused) {
  const Buffer good = message(ARPHRD_CAN, IFF_UP, can_attributes(0));
  CanLink link;
  assert_true(parse_link(good.data(), good.size(), link));
  assert_false(parse_link(good.data(), good.size() - 1, link));
  assert_false(parse_link(good.data(), 0, link));
  const Buffer other = message(ARPHRD_CAN, IFF_UP, {}, NLMSG_ERROR);
  assert_false(parse_link(other.data(), other.size(), link));
  Buffer no_info = message(ARPHRD_CAN, IFF_UP, {});
  const std::uint32_t too_short = sizeof(nlmsghdr) + sizeof(ifinfomsg) - 1;
  std::memcpy(no_info.data(), &too_short, sizeof too_short);
  assert_false(parse_link(no_info.data(), no_info.size(), link));
}

/// Whatever lengths the attributes claim, reading ends and stays inside; the sanitizers look on.
TEST(broken_lengths_are_survived) {
  const Buffer good = message(ARPHRD_CAN, IFF_UP, can_attributes(CAN_STATE_BUS_OFF));
  for (std::size_t at = sizeof(nlmsghdr) + sizeof(ifinfomsg); at < good.size(); ++at) {
    for (const int value : {0, 1, 3, 4, 5, 7, 8, 127, 255}) {
      const std::size_t size = good.size();
      std::vector<unsigned char> broken = good;
      broken[at] = static_cast<unsigned char>(value);
      CanLink link;
      static_cast<void>(parse_link(broken.data(), size, link));
    }
  }
}

TEST(states_of_a_port) {
  const auto state = [](std::uint32_t controller) {
    return state_of({true, true, true, controller});
  };
  assert_int_equal(state(CAN_STATE_ERROR_ACTIVE), CanPortState::kActive);
  assert_int_equal(state(CAN_STATE_ERROR_WARNING), CanPortState::kActive);
  assert_int_equal(state(CAN_STATE_ERROR_PASSIVE), CanPortState::kErrorPassive);
  assert_int_equal(state(CAN_STATE_BUS_OFF), CanPortState::kBusOff);
  assert_int_equal(state(CAN_STATE_STOPPED), CanPortState::kDown);
  assert_int_equal(state(CAN_STATE_SLEEPING), CanPortState::kDown);
  assert_int_equal(state(99), CanPortState::kDown);
  assert_int_equal(state_of({true, true, false, CAN_STATE_BUS_OFF}), CanPortState::kActive);
  assert_int_equal(state_of({false, true, false, 0}), CanPortState::kDown);
  assert_int_equal(state_of({true, false, true, CAN_STATE_ERROR_ACTIVE}), CanPortState::kDown);
}

TEST(the_kernel_answers) {
  CanLink link;
  ErrorText error;
  const int index = static_cast<int>(if_nametoindex("lo"));
  if (index == 0) {
    skip();
  }
  assert_true(query_link(index, link, error));
  assert_true(error.empty());
  assert_false(link.is_can);
  assert_int_equal(state_of(link), CanPortState::kDown);
}

TEST(an_interface_that_is_not_there) {
  CanLink link;
  ErrorText error;
  assert_false(query_link(0x7FFFFFF0, link, error));
  assert_string_equal(error.c_str(), "state of the interface: No such device");
}
