// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/serve.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

#include "app/scope/server/live_show.hpp"
#include "platform/linux/process.hpp"

namespace graben::scope {
namespace {

void catch_signals() {
  if (const ErrorText error = catch_stop_signals(); !error.empty()) {
    throw std::runtime_error(error.c_str());
  }
}

void say_where(const ScopeServer& server, const Show& show) {
  if (!server.is_loopback()) {
    fmt::print(stderr,
               "graben scope: warning: whoever reaches this machine's address can look, and in a "
               "simulation give orders; there is no password\n");
  }
  fmt::print("graben scope: {} ({})\n", server.url(), show.words());
  std::fflush(stdout);
}

/// The source's thread wakes the server: it must have ended before the server does.
class Running {
 public:
  Running(LiveShow& show, ScopeServer& server) : show_(show) {
    show.start([&server] { server.wake(); });
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() { show_.stop(); }

 private:
  LiveShow& show_;
};

}  // namespace

void serve(const ServerOptions& options, std::string_view page, FrameSource& source,
           const nlohmann::json& parts) {
  catch_signals();
  LiveShow show(source, parts);
  ScopeServer server(options, page, show);
  {
    const Running running(show, server);
    say_where(server, show);
    server.run([&show] { return stop_requested() || show.has_ended(); });
  }
  show.stop_and_rethrow();
}

void serve(const ServerOptions& options, std::string_view page, Show& show) {
  catch_signals();
  ScopeServer server(options, page, show);
  say_where(server, show);
  server.run([] { return stop_requested(); });
}

}  // namespace graben::scope
