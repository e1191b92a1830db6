// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/end_signals.hpp"

#include <sys/socket.h>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>

#include "platform/can_port_group.hpp"
#include "platform/linux/can_frames.hpp"

namespace graben::ecu {
namespace {

constexpr std::array<int, 8> kFailures = {SIGSEGV, SIGBUS, SIGFPE,  SIGILL,
                                          SIGABRT, SIGSYS, SIGTRAP, SIGXCPU};
constexpr std::array<int, 14> kRequests = {SIGTERM, SIGINT,  SIGHUP,    SIGQUIT,   SIGUSR1,
                                           SIGUSR2, SIGPIPE, SIGALRM,   SIGVTALRM, SIGPROF,
                                           SIGIO,   SIGPWR,  SIGSTKFLT, SIGXFSZ};

/// What overflows its stack has none for a handler.
constexpr std::size_t kStackBytes = 32768;
alignas(16) std::array<unsigned char, kStackBytes> g_stack;

std::atomic<const LastFrames*> g_frames{nullptr};
std::array<const SocketCanPort*, CanPortGroup::kMost> g_ports{};
/// A bit for each signal that has asked already.
std::atomic<std::uint64_t> g_asked{0};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free &&
                  std::atomic<const LastFrames*>::is_always_lock_free,
              "or a signal handler could not use them");

/// Only what POSIX allows in a handler.
void send_last_frames() {
  const LastFrames* const last = g_frames.load(std::memory_order_acquire);
  if (last == nullptr) {
    return;
  }
  const LastFrames::Frames& frames = last->get();
  for (std::size_t i = 0; i < frames.count; ++i) {
    can_frame raw{};
    const std::uint8_t bus = frames.frame[i].bus;
    const bool good = to_socketcan(frames.frame[i], raw);
    for (std::size_t port = 0; port < g_ports.size(); ++port) {
      if (good && g_ports[port] != nullptr && (bus == kAnyBus || bus == port)) {
        // Nobody is left who could do anything about a frame that is not taken.
        static_cast<void>(
            ::send(g_ports[port]->descriptor(), &raw, sizeof raw, MSG_DONTWAIT | MSG_NOSIGNAL));
      }
    }
  }
}

/// It comes again when this handler has returned, and then does what it does by default.
void end_by(int signal) {
  const int kept = errno;
  send_last_frames();
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  static_cast<void>(sigaction(signal, &action, nullptr));
  static_cast<void>(raise(signal));
  errno = kept;
}

void on_failure(int signal) { end_by(signal); }

void on_request(int signal) {
  const std::uint64_t bit = std::uint64_t{1} << static_cast<unsigned>(signal - 1);
  if ((g_asked.fetch_or(bit, std::memory_order_relaxed) & bit) != 0) {
    end_by(signal);
    return;
  }
  request_stop();
}

bool caught(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_ONSTACK;
  return sigaction(signal, &action, nullptr) == 0;
}

}  // namespace

EndSignals::EndSignals(const LastFrames& frames, const std::deque<SocketCanPort>& ports) {
  if (ports.size() > g_ports.size()) {
    error_.set("more than %zu interfaces", g_ports.size());
    return;
  }
  g_ports = {};
  for (std::size_t i = 0; i < ports.size(); ++i) {
    g_ports[i] = &ports[i];
  }
  g_frames.store(&frames, std::memory_order_release);
  stack_t stack{};
  stack.ss_sp = g_stack.data();
  stack.ss_size = g_stack.size();
  bool all = sigaltstack(&stack, nullptr) == 0;
  for (const int signal : kFailures) {
    all = caught(signal, &on_failure) && all;
  }
  for (const int signal : kRequests) {
    all = caught(signal, &on_request) && all;
  }
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) {
    all = caught(signal, &on_request) && all;
  }
  if (!all) {
    error_.set("sigaction: %s", error_words(errno));
  }
}

EndSignals::~EndSignals() { g_frames.store(nullptr, std::memory_order_release); }

}  // namespace graben::ecu
