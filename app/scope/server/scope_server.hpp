// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The page and its WebSocket: one thread, no state beside the connections, no privilege. Whoever
/// can reach the address can look; nobody can send to a bus from here.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "app/scope/server/show.hpp"

namespace graben::scope {

struct ServerOptions {
  std::string host = "127.0.0.1";
  int port = 8080;  ///< 0: any that is free.
};

/// Pages that are served at once; the next one is told that there are too many.
inline constexpr std::size_t kClientsMost = 32;

class ScopeServer {
 public:
  /// Listens from here on. `page` and `show` must outlive it. Throws std::runtime_error if the
  /// address cannot be had.
  ScopeServer(const ServerOptions& options, std::string_view page, Show& show);
  ScopeServer(const ScopeServer&) = delete;
  ScopeServer& operator=(const ScopeServer&) = delete;
  ~ScopeServer();

  [[nodiscard]] const std::string& url() const;
  [[nodiscard]] int port() const;
  [[nodiscard]] bool is_loopback() const;

  /// Serves until `should_stop`, which is asked some ten times a second.
  void run(const std::function<bool()>& should_stop);

  /// There is something new to send. From any thread, while run() is at work or before it.
  void wake();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace graben::scope
