#pragma once
/// Where the server is to listen, looked at before it does: what is wrong with it gets words.

#include <string>

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

}  // namespace graben::scope
