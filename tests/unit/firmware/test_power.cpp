// SPDX-License-Identifier: Apache-2.0
// Powers by the core's own logarithm, against the C library's.

#include "firmware/numeric/power.hpp"

#include <cmath>
#include <limits>

#include "tests/unit/cmocka_cpp.hpp"

using graben::power;

TEST(it_is_the_c_librarys_within_2e14) {
  double worst = 0.0;
  for (int n = -900; n <= 900; ++n) {
    const double base = std::pow(10.0, 0.01 * n);
    for (const double exponent : {-4.0, -1.0, 1.0 / 6.4, 0.5, 1.0, 1.3, 1.6, 2.5, 4.0}) {
      const double is = std::pow(base, exponent);
      worst = std::max(worst, std::abs(power(base, exponent) - is) / is);
    }
  }
  // Just above and below where the mantissa changes over.
  for (const double base :
       {std::sqrt(0.5), std::nextafter(std::sqrt(0.5), 0.0), 1.0, 1.0 - 1e-16}) {
    worst = std::max(worst, std::abs(power(base, 1.0) - base) / base);
  }
  print_message("%.2g off at most\n", worst);
  assert_true(worst <= 2e-14);
}

TEST(what_is_no_positive_number_has_a_power_too) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  assert_near(power(0.0, 1.6), 0.0, 0.0);
  assert_near(power(-2.0, 1.6), 0.0, 0.0);
  assert_near(power(std::numeric_limits<double>::quiet_NaN(), 1.6), 0.0, 0.0);
  assert_near(power(1.0, 1.6), 1.0, 0.0);
  assert_true(std::isfinite(power(kInfinity, 0.5)));
  assert_true(power(std::numeric_limits<double>::denorm_min(), 0.5) > 0.0);
}
