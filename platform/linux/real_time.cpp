#include "platform/linux/real_time.hpp"

#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstddef>

namespace graben {
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
