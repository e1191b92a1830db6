// SPDX-License-Identifier: Apache-2.0
// Whole numbers of 64 bits, of which a processor with 32 makes two halves.

#include "firmware/core/whole.hpp"

#include <cstring>

#include "tests/unit/cmocka_cpp.hpp"

// Where a half ends, where a double rounds, and what lies between.
constexpr std::int64_t kNumbers[] = {0,
                                     1,
                                     -1,
                                     999,
                                     -1000,
                                     2147483647,
                                     -2147483648LL,
                                     4294967295LL,
                                     4294967296LL,
                                     -4294967297LL,
                                     123456789012345LL,
                                     -9007199254740993LL,
                                     9007199254740993LL,
                                     1234567890123456789LL,
                                     INT64_MAX,
                                     INT64_MIN};

TEST(the_nearest_double_bit_for_bit) {
  for (const std::int64_t number : kNumbers) {
    const volatile std::int64_t by_the_library = number;
    const auto wanted = static_cast<double>(by_the_library);
    const double by_halves = double_by_halves(number);
    assert_memory_equal(&by_halves, &wanted, sizeof wanted);
    const double found = as_double(number);
    assert_memory_equal(&found, &wanted, sizeof wanted);
  }
}

void check_quotient(std::int64_t number, std::int32_t by) {
  const volatile std::int64_t by_the_library = number;
  assert_true(quotient_by_double(number, by) == by_the_library / by);
  assert_true(quotient(number, by) == by_the_library / by);
}

TEST(a_quotient_is_rounded_to_0) {
  constexpr std::int64_t kExact = std::int64_t{1} << 53U;
  for (const std::int32_t by : {1, 3, 10, 1000, 2147483647}) {
    for (const std::int64_t number : kNumbers) {
      if (number > -kExact && number < kExact) {
        check_quotient(number, by);
      }
    }
    // One below a multiple is where a rounded quotient would be one too many.
    for (std::int64_t times = 1; times < kExact / by; times = 7 * times + 1) {
      check_quotient(times * by, by);
      check_quotient(times * by - 1, by);
      check_quotient(1 - times * by, by);
    }
  }
}
