// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/service_notify.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace graben {
namespace {

/// A whole number and nothing else; false for null, empty, a sign, a rest, or too many digits.
bool parse(const char* text, std::int64_t& value) {
  if (text == nullptr || *text < '0' || *text > '9') {
    return false;
  }
  char* end = nullptr;
  errno = 0;
  value = std::strtoll(text, &end, 10);
  return errno == 0 && *end == '\0';
}

}  // namespace

ServiceNotify::ServiceNotify(const char* socket_name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::size_t length = socket_name == nullptr ? 0 : std::strlen(socket_name);
  if (length == 0 || length >= sizeof address.sun_path ||
      (socket_name[0] != '/' && socket_name[0] != '@')) {
    return;
  }
  std::memcpy(address.sun_path, socket_name, length);
  if (socket_name[0] == '@') {
    address.sun_path[0] = '\0';
  }
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + length);
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) {
    return;
  }
  if (connect(fd, reinterpret_cast<const sockaddr*>(&address), size) != 0) {
    static_cast<void>(close(fd));
    return;
  }
  socket_ = fd;
}

ServiceNotify::~ServiceNotify() {
  if (connected()) {
    static_cast<void>(close(socket_));
  }
}

bool ServiceNotify::send(const char* message) {
  if (!connected()) {
    return false;
  }
  const std::size_t length = std::strlen(message);
  return ::send(socket_, message, length, MSG_NOSIGNAL | MSG_DONTWAIT) ==
         static_cast<ssize_t>(length);
}

bool ServiceNotify::ready() { return send("READY=1"); }
bool ServiceNotify::stopping() { return send("STOPPING=1"); }
bool ServiceNotify::watchdog() { return send("WATCHDOG=1"); }

bool ServiceNotify::status(const char* line) {
  std::array<char, 256> message{};
  static_cast<void>(std::snprintf(message.data(), message.size(), "STATUS=%.200s", line));
  // A line break would begin another assignment.
  if (char* const line_end = std::strchr(message.data(), '\n')) {
    *line_end = '\0';
  }
  return send(message.data());
}

TimeUs watchdog_interval_us(const char* watchdog_usec, const char* watchdog_pid, pid_t own_pid) {
  std::int64_t interval_us = 0;
  if (!parse(watchdog_usec, interval_us)) {
    return 0;
  }
  std::int64_t pid = 0;
  if (watchdog_pid != nullptr && (!parse(watchdog_pid, pid) || pid != own_pid)) {
    return 0;
  }
  return interval_us;
}

}  // namespace graben
