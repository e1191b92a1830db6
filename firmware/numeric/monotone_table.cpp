#include "firmware/numeric/monotone_table.hpp"

#include <cmath>

namespace graben {
namespace {

/// Lower end of the segment that holds `value`; `keys` has `count` >= 2 increasing entries.
int segment(const std::array<double, MonotoneTable::kCapacity>& keys, int count, double value) {
  int low = 0;
  int high = count - 1;
  // 5 halvings separate 32 points; the bound is a constant whatever the contents.
  for (int step = 0; step < 5 && high - low > 1; ++step) {
    const int middle = (low + high) / 2;
    (keys[static_cast<unsigned>(middle)] <= value ? low : high) = middle;
  }
  return low;
}

double interpolate(const std::array<double, MonotoneTable::kCapacity>& from,
                   const std::array<double, MonotoneTable::kCapacity>& to, int count,
                   double value) {
  if (value <= from[0]) {
    return to[0];
  }
  const auto last = static_cast<unsigned>(count - 1);
  if (value >= from[last]) {
    return to[last];
  }
  const auto low = static_cast<unsigned>(segment(from, count, value));
  const double share = (value - from[low]) / (from[low + 1] - from[low]);
  return to[low] + share * (to[low + 1] - to[low]);
}

}  // namespace

MonotoneTable::Fill MonotoneTable::fill(const double* x_values, const double* y_values, int count) {
  count_ = 0;
  if (count < 2) {
    return Fill::kTooFew;
  }
  if (count > kCapacity) {
    return Fill::kTooMany;
  }
  for (int i = 0; i < count; ++i) {
    if (!std::isfinite(x_values[i]) || !std::isfinite(y_values[i])) {
      return Fill::kNotFinite;
    }
    if (i > 0 && (x_values[i] <= x_values[i - 1] || y_values[i] <= y_values[i - 1])) {
      return Fill::kNotIncreasing;
    }
    x_[static_cast<unsigned>(i)] = x_values[i];
    y_[static_cast<unsigned>(i)] = y_values[i];
  }
  count_ = count;
  return Fill::kOk;
}

double MonotoneTable::at(double x_value) const { return interpolate(x_, y_, count_, x_value); }

double MonotoneTable::inverse(double y_value) const { return interpolate(y_, x_, count_, y_value); }

}  // namespace graben
