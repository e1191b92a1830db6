// SPDX-License-Identifier: Apache-2.0
#include "firmware/numeric/power.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {
namespace {

/// Terms of the logarithm's series. [-; size: z^2 is at most 0.0295, so the first one that is left
/// out is 2e-17 of the first]
constexpr int kTerms = 10;
/// ln 2. [-; derived: to more digits than a double has]
constexpr double kLn2 = 0.69314718055994530942;
/// Least mantissa of the series, sqrt(1/2). [-; derived: its doubled one is as far beyond 1]
constexpr double kRootHalf = 0.70710678118654752440;

/// ln(m) = 2 artanh(z) with z = (m - 1) / (m + 1), of the mantissa around 1.
double logarithm(double value) {
  int exponent = 0;
  double mantissa = std::frexp(value, &exponent);
  if (mantissa < kRootHalf) {
    mantissa *= 2.0;
    --exponent;
  }
  const double z = (mantissa - 1.0) / (mantissa + 1.0);
  const double squared = z * z;
  double sum = 0.0;
  for (int term = kTerms - 1; term >= 0; --term) {
    sum = sum * squared + 1.0 / (2 * term + 1);
  }
  return 2.0 * z * sum + exponent * kLn2;
}

}  // namespace

double power(double base, double exponent) {
  if (!(base > 0.0)) {
    return 0.0;
  }
  return std::exp(exponent * logarithm(std::min(base, std::numeric_limits<double>::max())));
}

}  // namespace graben
