// SPDX-License-Identifier: Apache-2.0
// Each way to the heap is counted once, freeing is not, and the memory is usable.

#include "platform/linux/allocation_counter.hpp"

#include <cstdlib>
#include <cstring>
#include <new>

#include "tests/unit/cmocka_cpp.hpp"

/// Where the compiler cannot see that memory is not needed, and leave it out.
void* volatile g_memory = nullptr;

/// How many allocations `allocate` makes, with the memory freed again.
template <class Allocate>
std::uint64_t counted(Allocate allocate) {
  const std::uint64_t before = allocation_count();
  g_memory = allocate();
  const std::uint64_t after = allocation_count();
  assert_non_null(g_memory);
  std::memset(g_memory, 0x5A, 8);
  std::free(g_memory);
  assert_int_equal(allocation_count(), after);
  return after - before;
}

int only_where_counted(void**) {
  if (!allocations_are_counted()) {
    // The sanitizers have the heap; the count must then stay at rest.
    g_memory = std::malloc(8);
    std::free(g_memory);
    assert_int_equal(allocation_count(), 0);
    return 1;
  }
  return 0;
}

TEST(the_c_librarys_calls) {
  if (only_where_counted(nullptr) != 0) {
    skip();
  }
  assert_int_equal(counted([] { return std::malloc(64); }), 1);
  assert_int_equal(counted([] { return std::calloc(8, 8); }), 1);
  assert_int_equal(counted([] { return std::realloc(nullptr, 64); }), 1);
  assert_int_equal(counted([] { return std::realloc(std::malloc(64), 1 << 20); }), 2);
  assert_int_equal(counted([] { return ::strdup("on the heap"); }), 1);
}

TEST(aligned_memory) {
  if (only_where_counted(nullptr) != 0) {
    skip();
  }
  assert_int_equal(counted([] { return std::aligned_alloc(256, 256); }), 1);
  assert_true(reinterpret_cast<std::uintptr_t>(g_memory) % 256 == 0);
  void* memory = nullptr;
  assert_int_equal(counted([&memory] {
                     assert_int_equal(posix_memalign(&memory, 4096, 64), 0);
                     return memory;
                   }),
                   1);
  assert_true(reinterpret_cast<std::uintptr_t>(g_memory) % 4096 == 0);
  volatile std::size_t odd = 24;
  assert_int_equal(posix_memalign(&memory, odd, 64), EINVAL);
  odd = 0;
  assert_int_equal(posix_memalign(&memory, odd, 64), EINVAL);
  odd = 4;
  assert_int_equal(posix_memalign(&memory, odd, 64), EINVAL);
}

TEST(operator_new) {
  if (only_where_counted(nullptr) != 0) {
    skip();
  }
  const std::uint64_t before = allocation_count();
  int* volatile number = new int(7);
  int* volatile numbers = new int[100];
  assert_int_equal(allocation_count() - before, 2);
  assert_int_equal(*number, 7);
  delete number;
  delete[] numbers;
  assert_int_equal(allocation_count() - before, 2);
  struct alignas(128) Wide {
    char bytes[128];
  };
  Wide* volatile wide = new Wide;
  assert_int_equal(allocation_count() - before, 3);
  delete wide;
}

TEST(nothing_is_counted_for_nothing) {
  const std::uint64_t before = allocation_count();
  char text[64];
  std::snprintf(text, sizeof text, "%d", 5);
  assert_int_equal(allocation_count() - before, 0);
}
