// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/bus_lock.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>

namespace graben {

BusLock::BusLock(const std::string& interface) {
  const std::string name = "graben-ecu/" + interface;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // A leading 0 makes the name an abstract one.
  if (name.size() + 1 > sizeof address.sun_path) {
    error_.set("%s: too long for an interface's name", interface.c_str());
    return;
  }
  std::memcpy(address.sun_path + 1, name.data(), name.size());
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  fd_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd_ < 0 || bind(fd_, reinterpret_cast<const sockaddr*>(&address), size) != 0) {
    if (errno == EADDRINUSE) {
      error_.set("%s: another graben-ecu controls this bus; end it first", interface.c_str());
    } else {
      error_.set("%s: lock: %s", interface.c_str(), error_words(errno));
    }
  }
}

BusLock::~BusLock() {
  if (fd_ >= 0) {
    static_cast<void>(close(fd_));
  }
}

}  // namespace graben
