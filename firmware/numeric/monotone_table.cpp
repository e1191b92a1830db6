// SPDX-License-Identifier: Apache-2.0
#include "firmware/numeric/monotone_table.hpp"

#include <cmath>

namespace graben {

TableFill check_points(const double* x, const double* y, int count, int most) {
  if (count < 2) {
    return TableFill::kTooFew;
  }
  if (count > most) {
    return TableFill::kTooMany;
  }
  for (int i = 0; i < count; ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) {
      return TableFill::kNotFinite;
    }
    if (i > 0 && (x[i] <= x[i - 1] || y[i] <= y[i - 1])) {
      return TableFill::kNotIncreasing;
    }
  }
  return TableFill::kOk;
}

int segment_of(const double* keys, int count, double value) {
  int low = 0;
  int high = count - 1;
  // 5 halvings separate 32 points; the bound is a constant whatever the contents.
  for (int step = 0; step < 5 && high - low > 1; ++step) {
    const int middle = (low + high) / 2;
    (keys[middle] <= value ? low : high) = middle;
  }
  return low;
}

double interpolated(const double* from, const double* to, int count, double value) {
  if (value <= from[0]) {
    return to[0];
  }
  if (value >= from[count - 1]) {
    return to[count - 1];
  }
  const int low = segment_of(from, count, value);
  const double share = (value - from[low]) / (from[low + 1] - from[low]);
  return to[low] + share * (to[low + 1] - to[low]);
}

}  // namespace graben
