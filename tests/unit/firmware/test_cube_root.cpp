// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include "firmware/numeric/cube_root.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using graben::cube_root;

std::int64_t bits_of(double value) {
  std::int64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

struct Product {
  double value;
  double lost;  ///< What rounding took of it.
};

/// Dekker's: exact, where no wider type and no fused operation can be had.
Product product(double a, double b) {
  constexpr double kHalves = 134217729.0;  // 2^27 + 1
  const double a_high = kHalves * a - (kHalves * a - a);
  const double b_high = kHalves * b - (kHalves * b - b);
  const double a_low = a - a_high;
  const double b_low = b - b_high;
  const double value = a * b;
  return {value, ((a_high * b_high - value) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

/// Units in the last place that a root is off: by what its cube leaves of the number.
double ulps_off(double number) {
  const double root_as_is = cube_root(number);
  // Where nothing overflows or loses digits.
  int exponent = 0;
  std::frexp(root_as_is, &exponent);
  const double root = std::ldexp(std::abs(root_as_is), -exponent);
  const double value = std::ldexp(std::abs(number), -3 * exponent);
  const Product square = product(root, root);
  const Product cube = product(square.value, root);
  const double left = ((value - cube.value) - cube.lost) - square.lost * root;
  const double unit = std::nextafter(root, 1.0) - root;
  return std::abs(left) / (3.0 * square.value) / unit;
}

TEST(it_is_within_a_unit_in_the_last_place) {
  std::mt19937_64 random(1);
  double worst = 0.0;
  for (int n = 0; n < 300000; ++n) {
    // Any positive finite number, subnormal ones included.
    const std::uint64_t bits = random() % 0x7FF0000000000000U;
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof(value));
    worst = std::max(worst, value > 0.0 ? ulps_off(value) : 0.0);
  }
  // All of the mantissa at every exponent modulo 3, where the start is best and worst.
  for (int n = 0; n < 300000; ++n) {
    worst = std::max(worst, ulps_off(1.0 + 7.0 * n / 300000.0));
  }
  print_message("%.3f units off at most\n", worst);
  assert_true(worst <= 1.0);
  assert_true(worst > 0.5);
}

TEST(cubes_of_small_whole_numbers_are_exact) {
  for (int n = 1; n <= 1000; ++n) {
    assert_near(cube_root(static_cast<double>(n) * n * n), n, 0.0);
    assert_near(cube_root(-static_cast<double>(n) * n * n), -n, 0.0);
  }
}

TEST(the_ends_of_the_range_have_theirs) {
  constexpr double kMost = std::numeric_limits<double>::max();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  for (const double value : {kMost, kLeast, 0x1p-1022, 0x1p900, 0x1p-900, 0x1.8p900, 0x1p-901}) {
    assert_true(ulps_off(value) <= 1.0);
    assert_near(cube_root(-value), -cube_root(value), 0.0);
  }
}

TEST(what_has_no_digits_is_returned) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  assert_int_equal(bits_of(cube_root(0.0)), bits_of(0.0));
  assert_int_equal(bits_of(cube_root(-0.0)), bits_of(-0.0));
  assert_true(cube_root(kInfinity) == kInfinity);
  assert_true(cube_root(-kInfinity) == -kInfinity);
  assert_true(std::isnan(cube_root(std::numeric_limits<double>::quiet_NaN())));
}

/// The same bits on every target: what this one has to give, taken from IEEE 754 arithmetic.
TEST(its_bits_are_these) { assert_true(bits_of(cube_root(2.0)) == bits_of(0x1.428a2f98d728bp+0)); }
