#include "platform/linux/stop_signal.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>

namespace graben {
namespace {

std::atomic<bool> g_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "or a signal handler could not set it");

void on_stop_signal(int /*signal*/) { g_stop.store(true, std::memory_order_relaxed); }

}  // namespace

ErrorText catch_stop_signals() {
  ErrorText error;
  struct sigaction action {};
  action.sa_handler = &on_stop_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  if (sigaction(SIGTERM, &action, nullptr) != 0 || sigaction(SIGINT, &action, nullptr) != 0) {
    error.set("sigaction: %s", error_words(errno));
  }
  return error;
}

bool stop_requested() { return g_stop.load(std::memory_order_relaxed); }

}  // namespace graben
