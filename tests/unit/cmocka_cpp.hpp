// SPDX-License-Identifier: Apache-2.0
#pragma once
/// CMocka as C++ wants it, and what it lacks.

#include <cmath>
#include <csetjmp>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

extern "C" {
#include <cmocka.h>
}
// Members of that name would not compile.
#undef fail
#undef fail_msg
#define fail_msg(...) (print_error(__VA_ARGS__), print_error("\n"), _fail(__FILE__, __LINE__))

namespace graben {

/// Does it `count` times.
template <class Count, class Function>
void repeat(Count count, const Function& what) {
  for (Count n = 0; n < count; ++n) {
    what();
  }
}

}  // namespace graben

namespace graben::test {

inline void check_near(double actual, double expected, double tolerance, const char* expression,
                       const char* file, int line) {
  // Written so that NaN fails.
  if (!(std::fabs(actual - expected) <= tolerance)) {
    print_error("%s is %.17g, expected %.17g within %g\n", expression, actual, expected, tolerance);
    _fail(file, line);
  }
}

/// A test that has told of itself; all of a program are one list. A header's tests would be the
/// header's: what several sources share are functions that their tests call.
struct Registered {
  Registered(const char* name, const char* source, CMUnitTestFunction function) noexcept
      : test{name, function, nullptr, nullptr, nullptr}, file(source) {
    *end() = this;
    end() = &next;
  }
  Registered(const Registered&) = delete;
  Registered& operator=(const Registered&) = delete;

  static Registered*& first() noexcept {
    static Registered* head = nullptr;
    return head;
  }
  static Registered**& end() noexcept {
    static Registered** tail = &first();
    return tail;
  }

  CMUnitTest test;
  const char* file;
  Registered* next = nullptr;
};

/// A test on an object of its own.
template <class Object>
void call(void (*test)(Object)) {
  test(Object());
}

template <class Test, class Kind>
const char* name_of() noexcept {
  return __PRETTY_FUNCTION__;
}

/// The same test of several kinds, one after the other.
template <class Test, class... Kinds>
struct RegisteredForEach {
  explicit RegisteredForEach(const char* source) noexcept
      : each{{name_of<Test, Kinds>(), source, Test::template run<Kinds>}...} {}

  Registered each[sizeof...(Kinds)];
};

/// What a source needs before its first test and after its last.
struct Within {
  Within(const char* source, CMFixtureFunction first, CMFixtureFunction last) noexcept
      : file(source), before(first), after(last), next(newest()) {
    newest() = this;
  }
  static const Within*& newest() noexcept {
    static const Within* one = nullptr;
    return one;
  }

  const char* file;
  CMFixtureFunction before;
  CMFixtureFunction after;
  const Within* next;
};

/// Whether a compiler's name of a file is this path in the repository; "" is each.
inline bool is_file(const char* file, const char* path) {
  const std::size_t length = std::strlen(file);
  const std::size_t end = std::strlen(path);
  return length >= end && std::strcmp(file + (length - end), path) == 0;
}

/// Runs the tests of one source, in their order there. A source without any fails.
inline int run_source(const char* path) {
  std::vector<CMUnitTest> tests;
  for (const Registered* one = Registered::first(); one != nullptr; one = one->next) {
    if (is_file(one->file, path)) {
      tests.push_back(one->test);
    }
  }
  if (tests.empty()) {
    print_error("%s has no tests\n", path);
    return 1;
  }
  const Within* within = Within::newest();
  while (within != nullptr && !is_file(within->file, path)) {
    within = within->next;
  }
  return _cmocka_run_group_tests(path, tests.data(), tests.size(),
                                 within == nullptr ? nullptr : within->before,
                                 within == nullptr ? nullptr : within->after);
}

}  // namespace graben::test

// What is tested is named as its own code names it.
using namespace graben;

/// TEST(name) { ... }: a test, which is run by being there. TEST(name, Machine machine) { ... }:
/// one that begins with a machine of its own.
#define TEST(...) GRABEN_SECOND_OR(__VA_ARGS__, GRABEN_TEST_WITH, GRABEN_TEST, )(__VA_ARGS__)
#define GRABEN_SECOND_OR(name, object, which, ...) which
#define GRABEN_TEST(name)                                                        \
  static void name(void**);                                                      \
  static const graben::test::Registered name##_is_a_test(#name, __FILE__, name); \
  static void name(void**)
#define GRABEN_TEST_WITH(name, object)                            \
  static void name(object);                                       \
  static const graben::test::Registered name##_is_a_test(         \
      #name, __FILE__, [](void**) { graben::test::call(name); }); \
  static void name(object)

/// TEST_FOR_EACH(name, Kind, One, Other...) { ... }: a test of each of these types, which its body
/// knows as Kind.
#define TEST_FOR_EACH(name, Kind, ...)                                                        \
  struct name {                                                                               \
    template <class Kind>                                                                     \
    static void run(void**);                                                                  \
  };                                                                                          \
  static const graben::test::RegisteredForEach<name, __VA_ARGS__> name##_is_a_test(__FILE__); \
  template <class Kind>                                                                       \
  void name::run(void**)

/// Called before the first test of a source and after its last.
#define TESTS_WITHIN(before, after) \
  static const graben::test::Within fixture_of_all(__FILE__, before, after);

/// Fails, and prints the values, unless |a - b| <= tol.
#define assert_near(a, b, tol) graben::test::check_near((a), (b), (tol), #a, __FILE__, __LINE__)
