// SPDX-License-Identifier: Apache-2.0
#pragma once
/// CMocka as C++ wants it, and what it lacks.

#include <cmath>
#include <csetjmp>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <sstream>

extern "C" {
#include <cmocka.h>
}
// Members of that name would not compile.
#undef fail
#undef fail_msg
#define fail_msg(...) (print_error(__VA_ARGS__), print_error("\n"), _fail(__FILE__, __LINE__))

namespace graben::test {

inline void check_near(double actual, double expected, double tolerance, const char* expression,
                       const char* file, int line) {
  // Written so that NaN fails.
  if (!(std::fabs(actual - expected) <= tolerance)) {
    print_error("%s is %.17g, expected %.17g within %g\n", expression, actual, expected, tolerance);
    _fail(file, line);
  }
}

}  // namespace graben::test

/// Fails, and prints the values, unless |a - b| <= tol.
#define assert_near(a, b, tol) graben::test::check_near((a), (b), (tol), #a, __FILE__, __LINE__)
