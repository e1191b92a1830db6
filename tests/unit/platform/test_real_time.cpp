// SPDX-License-Identifier: Apache-2.0
// Each step does what it says or says what it lacks; every attempt in a child of its own.

#include "platform/linux/process.hpp"

#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "tests/unit/cmocka_cpp.hpp"

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
constexpr bool kSanitized = false;
#endif

enum Outcome { kGood = 0, kWrong = 1, kCannotTry = 2 };

template <class Body>
int in_child(Body body) {
  const pid_t child = fork();
  if (child == 0) {
    _exit(body());
  }
  int status = -1;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFEXITED(status));
  return WEXITSTATUS(status);
}

/// For the child: no right and no limit that would allow anything here.
bool become_nobody() {
  const rlimit none{0, 0};
  if (setrlimit(RLIMIT_MEMLOCK, &none) != 0 || setrlimit(RLIMIT_RTPRIO, &none) != 0) {
    return false;
  }
  return getuid() != 0 || setresuid(65534, 65534, 65534) == 0;
}

bool contains(const ErrorText& text, const char* part) {
  const bool found = std::strstr(text.c_str(), part) != nullptr;
  if (!found) {
    std::fprintf(stderr, "'%s' does not say '%s'\n", text.c_str(), part);
  }
  return found;
}

/// How much of this process is locked, in kB; -1 if the kernel does not say.
long locked_kb() {
  std::FILE* const status = std::fopen("/proc/self/status", "r");
  long result = -1;
  char line[256];
  while (status != nullptr && std::fgets(line, sizeof line, status) != nullptr) {
    if (std::sscanf(line, "VmLck: %ld", &result) == 1) {
      break;
    }
  }
  if (status != nullptr) {
    std::fclose(status);
  }
  return result;
}

TEST(memory_is_locked) {
  if (kSanitized) {
    skip();  // the sanitizers make mlockall a no-operation: their shadow is terabytes
  }
  const int outcome = in_child([] {
    const ErrorText error = lock_memory();
    if (!error.empty()) {
      return contains(error, "CAP_IPC_LOCK") ? kCannotTry : kWrong;
    }
    const long before_kb = locked_kb();
    // What is mapped later is locked as well.
    void* const more =
        mmap(nullptr, 1 << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return more != MAP_FAILED && before_kb > 0 && locked_kb() >= before_kb + 1024 ? kGood : kWrong;
  });
  if (outcome == kCannotTry) {
    skip();
  }
  assert_int_equal(outcome, kGood);
}

TEST(what_is_missing_is_named) {
  assert_int_equal(
      in_child([] {
        if (!become_nobody()) {
          return kCannotTry;
        }
        const bool memory = kSanitized || contains(lock_memory(), "needs CAP_IPC_LOCK");
        const bool priority =
            contains(set_fifo_priority(80),
                     "SCHED_FIFO 80: Operation not permitted; needs CAP_SYS_NICE or an rtprio "
                     "limit of 80 (ulimit -r)");
        return memory && priority && sched_getscheduler(0) == SCHED_OTHER ? kGood : kWrong;
      }),
      kGood);
}

TEST(a_priority_is_set_and_not_inherited) {
  const int outcome = in_child([] {
    const ErrorText error = set_fifo_priority(10);
    if (!error.empty()) {
      return contains(error, "CAP_SYS_NICE") ? kCannotTry : kWrong;
    }
    sched_param parameter{};
    const bool own = (sched_getscheduler(0) & ~SCHED_RESET_ON_FORK) == SCHED_FIFO &&
                     sched_getparam(0, &parameter) == 0 && parameter.sched_priority == 10;
    const int inherited = in_child([] { return sched_getscheduler(0) == SCHED_OTHER ? 0 : 1; });
    return own && inherited == 0 ? kGood : kWrong;
  });
  if (outcome == kCannotTry) {
    skip();
  }
  assert_int_equal(outcome, kGood);
}

TEST(a_priority_out_of_range_is_refused) {
  for (const int priority : {-1, 0, 100}) {
    assert_true(contains(set_fifo_priority(priority), "a priority is 1 to 99"));
  }
  assert_int_equal(sched_getscheduler(0), SCHED_OTHER);
}

TEST(a_thread_is_pinned) {
  cpu_set_t allowed;
  assert_int_equal(sched_getaffinity(0, sizeof allowed, &allowed), 0);
  int last = -1;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    last = CPU_ISSET(static_cast<std::size_t>(cpu), &allowed) ? cpu : last;
  }
  assert_int_equal(in_child([last] {
                     cpu_set_t now;
                     const bool pinned =
                         pin_to_cpu(last).empty() && sched_getaffinity(0, sizeof now, &now) == 0 &&
                         CPU_COUNT(&now) == 1 && CPU_ISSET(static_cast<std::size_t>(last), &now);
                     return pinned && sched_getcpu() == last ? kGood : kWrong;
                   }),
                   kGood);
}

TEST(a_cpu_that_is_not_there_is_named) {
  assert_true(contains(pin_to_cpu(-1), "CPU -1: CPUs are numbered 0 to 1023"));
  assert_true(contains(pin_to_cpu(1024), "CPU 1024: CPUs are numbered 0 to 1023"));
  if (sysconf(_SC_NPROCESSORS_CONF) < 1023) {
    assert_true(contains(pin_to_cpu(1023), "CPU 1023: Invalid argument; it must be there"));
  }
}

TEST(page_faults_are_seen) {
  constexpr std::size_t kPages = 16;
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  auto* const memory = static_cast<volatile char*>(
      mmap(nullptr, kPages * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  const PageFaults before = page_faults();
  for (std::size_t i = 0; i < kPages; ++i) {
    memory[i * page] = 1;
  }
  const PageFaults after = page_faults();
  assert_true(faults_since(before, after) >= 1);
  // Ten times: the kernel may take a page of the program's for itself at any time.
  std::int64_t least = INT64_MAX;
  for (char round = 2; round < 12; ++round) {
    const PageFaults touched = page_faults();
    for (std::size_t i = 0; i < kPages; ++i) {
      memory[i * page] = round;
    }
    least = std::min(least, faults_since(touched, page_faults()));
  }
  assert_int_equal(least, 0);
  assert_int_equal(faults_since({3, 1}, {10, 2}), 8);
}

/// Of what must not fault: the kernel may take a page of a program's for itself at any time.
template <class Body>
int in_one_child_of_five(const Body& body) {
  int outcome = kWrong;
  for (int child = 0; child < 5 && outcome == kWrong; ++child) {
    outcome = in_child(body);
  }
  return outcome;
}

/// A cycle's stack, deep down. Returns the faults that it took.
__attribute__((noinline)) std::int64_t faults_of_deep_stack() {
  const PageFaults before = page_faults();
  volatile unsigned char stack[56 * 1024];
  for (std::size_t i = 0; i < sizeof stack; i += 1024) {
    stack[i] = 1;
  }
  static_cast<void>(stack[0]);
  return faults_since(before, page_faults());
}

TEST(a_touched_stack_does_not_fault) {
  // A child begins with fresh copies of its parent's pages: without the call there are faults.
  static_cast<void>(page_faults());
  assert_int_equal(in_child([] { return faults_of_deep_stack() > 0 ? kGood : kWrong; }), kGood);
  assert_int_equal(in_one_child_of_five([] {
                     static_cast<void>(page_faults());
                     prefault_stack();
                     return faults_of_deep_stack() == 0 ? kGood : kWrong;
                   }),
                   kGood);
}

TEST(the_heap_is_tuned) {
  if (kSanitized) {
    skip();  // their heap takes no tuning, and says so
  }
  assert_int_equal(in_one_child_of_five([] {
                     if (!tune_heap().empty()) {
                       return kWrong;
                     }
                     // Freed and asked for again, a large block causes no fault.
                     constexpr std::size_t kBytes = 4 << 20;
                     const auto fill = [] {
                       void* volatile block = std::malloc(kBytes);
                       std::memset(block, 1, kBytes);
                       std::free(block);
                     };
                     fill();
                     const PageFaults before = page_faults();
                     fill();
                     return faults_since(before, page_faults()) == 0 ? kGood : kWrong;
                   }),
                   kGood);
}

TEST(an_error_text_is_cut_not_overrun) {
  ErrorText text;
  assert_true(text.empty());
  assert_string_equal(text.c_str(), "");
  text.set("%s %d", "CPU", 3);
  assert_string_equal(text.c_str(), "CPU 3");
  text.set("%s", std::string(1000, 'x').c_str());
  assert_int_equal(std::strlen(text.c_str()), 239);
  text.clear();
  assert_true(text.empty());
  assert_string_equal(error_words(ENETDOWN), "Network is down");
  assert_string_equal(error_words(99999), "unknown error");
}
