#include "app/scope/server/http_guard.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace graben::scope {
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
