// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/access.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

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

namespace {

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 &&
         text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_address(std::string_view text, int family) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return text.find('\0') == std::string_view::npos &&
         inet_pton(family, std::string(text).c_str(), address.data()) == 1;
}

struct HostAndPort {
  bool is_valid = false;
  bool in_brackets = false;  ///< As an address of version 6 is written.
  std::string_view host;
};

HostAndPort split(std::string_view text) {
  HostAndPort result;
  std::string_view rest;
  if (!text.empty() && text.front() == '[') {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) {
      return result;
    }
    result.in_brackets = true;
    result.host = text.substr(1, end - 1);
    rest = text.substr(end + 1);
  } else {
    const std::size_t end = std::min(text.find(':'), text.size());
    result.host = text.substr(0, end);
    rest = text.substr(end);
  }
  result.is_valid = rest.empty() || (rest.front() == ':' && is_port(rest.substr(1)));
  return result;
}

}  // namespace

bool is_own_host(std::string_view host, std::string_view listened_on) {
  const HostAndPort parts = split(host);
  if (!parts.is_valid || parts.host.empty()) {
    return false;
  }
  if (parts.in_brackets) {
    return is_address(parts.host, AF_INET6);
  }
  return is_address(parts.host, AF_INET) || equal_ignoring_case(parts.host, "localhost") ||
         equal_ignoring_case(parts.host, listened_on);
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  constexpr std::string_view kScheme = "http://";
  return !host.empty() && origin.substr(0, kScheme.size()) == kScheme &&
         equal_ignoring_case(origin.substr(kScheme.size()), host);
}

}  // namespace graben::scope
