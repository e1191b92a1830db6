// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the server listens, and who may talk to it. A browser lets any page open a WebSocket to
/// any address, this machine's own included, and says only by what page: `Origin`. And a foreign
/// name can be made to lead to this machine (DNS rebinding), with which a foreign page becomes one
/// of the same origin: but `Host` still has the foreign name.

#include <string>
#include <string_view>

namespace graben::scope {

struct ListenAddress {
  std::string numeric;  ///< "127.0.0.1", "::1"
  bool is_ipv6 = false;
  bool is_loopback = false;  ///< Nobody but this machine reaches it.
};

/// A name or an address, and a port, 0 for any that is free. Throws std::runtime_error that says
/// what is wrong: no such name, port in use, not allowed.
[[nodiscard]] ListenAddress listen_address(const std::string& host, int port);

/// "http://127.0.0.1:8080/"
[[nodiscard]] std::string url_of(const ListenAddress& address, int port);

/// Whether a `Host` header, with or without a port, names this server: by an address, which nobody
/// can make lead elsewhere, as localhost, or by the name that it was told to listen on.
[[nodiscard]] bool is_own_host(std::string_view host, std::string_view listened_on);

/// Whether an `Origin` header is the page that this server gives under `host`, the `Host` header of
/// the same request. What is no browser has none, which is the caller's to know.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host);

}  // namespace graben::scope
