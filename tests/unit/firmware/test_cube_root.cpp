#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include "firmware/numeric/cube_root.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace {

using graben::cube_root;

std::int64_t bits_of(double value) {
  std::int64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

/// Units in the last place between a root and that of a wider type.
double ulps_off(double value) {
  const double root = cube_root(value);
  const long double exact = std::cbrt(static_cast<long double>(value));
  const double unit =
      std::nextafter(std::abs(root), std::numeric_limits<double>::infinity()) - std::abs(root);
  return static_cast<double>(std::abs(static_cast<long double>(root) - exact)) / unit;
}

void it_is_within_a_unit_in_the_last_place(void**) {
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

void cubes_of_small_whole_numbers_are_exact(void**) {
  for (int n = 1; n <= 1000; ++n) {
    assert_near(cube_root(static_cast<double>(n) * n * n), n, 0.0);
    assert_near(cube_root(-static_cast<double>(n) * n * n), -n, 0.0);
  }
}

void the_ends_of_the_range_have_theirs(void**) {
  constexpr double kMost = std::numeric_limits<double>::max();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  for (const double value : {kMost, kLeast, 0x1p-1022, 0x1p900, 0x1p-900, 0x1.8p900, 0x1p-901}) {
    assert_true(ulps_off(value) <= 1.0);
    assert_near(cube_root(-value), -cube_root(value), 0.0);
  }
}

void what_has_no_digits_is_returned(void**) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  assert_int_equal(bits_of(cube_root(0.0)), bits_of(0.0));
  assert_int_equal(bits_of(cube_root(-0.0)), bits_of(-0.0));
  assert_true(cube_root(kInfinity) == kInfinity);
  assert_true(cube_root(-kInfinity) == -kInfinity);
  assert_true(std::isnan(cube_root(std::numeric_limits<double>::quiet_NaN())));
}

/// The same bits on every target: what this one has to give, taken from IEEE 754 arithmetic.
void its_bits_are_these(void**) {
  assert_true(bits_of(cube_root(2.0)) == bits_of(0x1.428a2f98d728bp+0));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(it_is_within_a_unit_in_the_last_place),
      cmocka_unit_test(cubes_of_small_whole_numbers_are_exact),
      cmocka_unit_test(the_ends_of_the_range_have_theirs),
      cmocka_unit_test(what_has_no_digits_is_returned),
      cmocka_unit_test(its_bits_are_these),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
