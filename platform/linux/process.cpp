// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/process.hpp"

#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstring>

namespace graben {

void ErrorText::set(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  static_cast<void>(std::vsnprintf(text_.data(), text_.size(), format, arguments));
  va_end(arguments);
}

const char* error_words(int error_number) {
  const char* const words = strerrordesc_np(error_number);
  return words == nullptr ? "unknown error" : words;
}

namespace {

std::atomic<bool> g_stop{false};
std::atomic<int> g_stop_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free, "or a signal handler could not set it");

void on_stop_signal(int signal) {
  g_stop_signal.store(signal, std::memory_order_relaxed);
  request_stop();
}

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

void request_stop() { g_stop.store(true, std::memory_order_relaxed); }

bool stop_requested() { return g_stop.load(std::memory_order_relaxed); }

int stop_signal() { return g_stop_signal.load(std::memory_order_relaxed); }

namespace {

constexpr std::size_t kStackBytes = 64 * 1024;
constexpr std::size_t kSmallestPageBytes = 4096;

}  // namespace

ErrorText tune_heap() {
  ErrorText error;
  if (mallopt(M_TRIM_THRESHOLD, -1) == 0 || mallopt(M_MMAP_MAX, 0) == 0) {
    error.set("mallopt: the C library refuses to keep freed memory");
  }
  return error;
}

ErrorText lock_memory() {
  ErrorText error;
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    error.set("mlockall: %s; needs CAP_IPC_LOCK or an unlimited memlock limit (ulimit -l)",
              error_words(errno));
  }
  return error;
}

// Not inlined: its frame has to be below the caller's, and gone afterwards.
__attribute__((noinline)) void prefault_stack() {
  volatile unsigned char stack[kStackBytes];
  for (std::size_t i = 0; i < kStackBytes; i += kSmallestPageBytes) {
    stack[i] = 0;
  }
  static_cast<void>(stack[0]);  // or the compiler takes them for unused
}

ErrorText pin_to_cpu(int cpu) {
  ErrorText error;
  if (cpu < 0 || cpu >= CPU_SETSIZE) {
    error.set("CPU %d: CPUs are numbered 0 to %d", cpu, CPU_SETSIZE - 1);
    return error;
  }
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(static_cast<std::size_t>(cpu), &only);
  if (sched_setaffinity(0, sizeof only, &only) != 0) {
    error.set("CPU %d: %s; it must be there, online and in the process's cpuset", cpu,
              error_words(errno));
  }
  return error;
}

ErrorText set_fifo_priority(int priority) {
  ErrorText error;
  sched_param parameter{};
  parameter.sched_priority = priority;
  if (priority < sched_get_priority_min(SCHED_FIFO) ||
      priority > sched_get_priority_max(SCHED_FIFO)) {
    error.set("SCHED_FIFO %d: a priority is 1 to 99", priority);
  } else if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameter) != 0) {
    error.set("SCHED_FIFO %d: %s; needs CAP_SYS_NICE or an rtprio limit of %d (ulimit -r)",
              priority, error_words(errno), priority);
  }
  return error;
}

PageFaults page_faults() {
  rusage usage{};
  static_cast<void>(getrusage(RUSAGE_THREAD, &usage));
  return {usage.ru_minflt, usage.ru_majflt};
}

}  // namespace graben
