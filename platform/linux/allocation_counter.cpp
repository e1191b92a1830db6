// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/allocation_counter.hpp"

#include <atomic>
#include <cerrno>
#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define GRABEN_COUNTS_ALLOCATIONS 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || \
    __has_feature(thread_sanitizer)
#define GRABEN_COUNTS_ALLOCATIONS 0
#else
#define GRABEN_COUNTS_ALLOCATIONS 1
#endif
#else
#define GRABEN_COUNTS_ALLOCATIONS 1
#endif

namespace graben {
namespace {

// Constant-initialised: the loader allocates before any constructor has run.
std::atomic<std::uint64_t> g_allocations{0};

}  // namespace

bool allocations_are_counted() { return GRABEN_COUNTS_ALLOCATIONS != 0; }

std::uint64_t allocation_count() { return g_allocations.load(std::memory_order_relaxed); }

}  // namespace graben

#if GRABEN_COUNTS_ALLOCATIONS

// glibc lets a program replace these, and keeps its own under the names below. free stays its own:
// what comes from here is its memory. <cstdlib> is left out, as its names of the parameters differ.
extern "C" {

void* __libc_malloc(std::size_t bytes);
void* __libc_calloc(std::size_t count, std::size_t bytes);
void* __libc_realloc(void* old, std::size_t bytes);
void* __libc_memalign(std::size_t alignment, std::size_t bytes);

static void count_allocation() { graben::g_allocations.fetch_add(1, std::memory_order_relaxed); }

void* malloc(std::size_t bytes) noexcept {
  count_allocation();
  return __libc_malloc(bytes);
}

void* calloc(std::size_t count, std::size_t bytes) noexcept {
  count_allocation();
  return __libc_calloc(count, bytes);
}

void* realloc(void* old, std::size_t bytes) noexcept {
  count_allocation();
  return __libc_realloc(old, bytes);
}

void* memalign(std::size_t alignment, std::size_t bytes) noexcept {
  count_allocation();
  return __libc_memalign(alignment, bytes);
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) noexcept {
  count_allocation();
  return __libc_memalign(alignment, bytes);
}

int posix_memalign(void** result, std::size_t alignment, std::size_t bytes) noexcept {
  const bool power_of_two = alignment != 0 && (alignment & (alignment - 1)) == 0;
  if (!power_of_two || alignment % sizeof(void*) != 0) {
    return EINVAL;
  }
  count_allocation();
  void* const memory = __libc_memalign(alignment, bytes);
  if (memory == nullptr) {
    return ENOMEM;
  }
  *result = memory;
  return 0;
}

}  // extern "C"

#endif
