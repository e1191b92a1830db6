#include "app/scope/server/listen_address.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace graben::scope {
namespace {

using Found = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

Found resolve(const std::string& host, int port) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = host.empty()
                        ? EAI_NONAME
                        : getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found);
  if (error != 0) {
    throw std::runtime_error(
        fmt::format("--host '{}': {}; such as 127.0.0.1", host, gai_strerror(error)));
  }
  return {found, &freeaddrinfo};
}

/// What the library would be told when it binds, and would not tell us.
void try_to_bind(const addrinfo& at, const std::string& host, int port) {
  const int fd = socket(at.ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  const bool bound = fd >= 0 && setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
                     bind(fd, at.ai_addr, at.ai_addrlen) == 0 && listen(fd, 1) == 0;
  const int error = errno;
  if (fd >= 0) {
    close(fd);
  }
  if (!bound) {
    const char* hint = error == EADDRINUSE ? "; --port 0 takes one that is free" : "";
    throw std::runtime_error(
        fmt::format("{} port {}: {}{}", host, port, std::strerror(error), hint));
  }
}

bool is_loopback(const addrinfo& at) {
  if (at.ai_family == AF_INET6) {
    return IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6*>(at.ai_addr)->sin6_addr);
  }
  const auto* v4 = reinterpret_cast<const sockaddr_in*>(at.ai_addr);
  return (ntohl(v4->sin_addr.s_addr) >> 24U) == 127U;
}

}  // namespace

ListenAddress listen_address(const std::string& host, int port) {
  const Found found = resolve(host, port);
  try_to_bind(*found, host, port);
  std::array<char, NI_MAXHOST> numeric{};
  const int error = getnameinfo(found->ai_addr, found->ai_addrlen, numeric.data(),
                                static_cast<socklen_t>(numeric.size()), nullptr, 0, NI_NUMERICHOST);
  if (error != 0) {
    throw std::runtime_error(fmt::format("--host '{}': {}", host, gai_strerror(error)));
  }
  return {numeric.data(), found->ai_family == AF_INET6, is_loopback(*found)};
}

std::string url_of(const ListenAddress& address, int port) {
  return fmt::format(address.is_ipv6 ? "http://[{}]:{}/" : "http://{}:{}/", address.numeric, port);
}

}  // namespace graben::scope
