// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Piecewise-linear, strictly increasing tables with fixed capacity, readable both ways.

#include <array>

namespace graben {

/// What came of filling a table.
enum class TableFill { kOk, kTooFew, kTooMany, kNotFinite, kNotIncreasing };

/// kOk where `count` points make a table with room for `most`.
[[nodiscard]] TableFill check_points(const double* x, const double* y, int count, int most);

/// Least end of the segment that holds `value`, among `count` >= 2 increasing keys; the first or
/// the last segment outside of them. One bisection over at most 32 keys.
[[nodiscard]] int segment_of(const double* keys, int count, double value);

/// What `to` is where `from` is `value`: between the points linear, outside held at the ends.
[[nodiscard]] double interpolated(const double* from, const double* to, int count, double value);

/// y over x, both strictly increasing and finite; between the points linear, outside held at the
/// ends. Allocation-free; `at` and `inverse` cost one bisection over at most kMost points.
template <int kMost>
class MonotoneTableOf {
  static_assert(kMost >= 2 && kMost <= 32);

 public:
  [[nodiscard]] static constexpr int capacity() { return kMost; }

  using Fill = TableFill;

  /// Replaces the contents. On any result but kOk the table is empty.
  [[nodiscard]] Fill fill(const double* x, const double* y, int count) {
    const Fill result = check_points(x, y, count, kMost);
    if (result != Fill::kOk) {
      count_ = 0;
      return result;
    }
    count_ = count;
    for (int i = 0; i < count; ++i) {
      x_[static_cast<unsigned>(i)] = x[i];
      y_[static_cast<unsigned>(i)] = y[i];
    }
    return result;
  }

  [[nodiscard]] int size() const { return count_; }
  [[nodiscard]] double x(int index) const { return x_[static_cast<unsigned>(index)]; }
  [[nodiscard]] double y(int index) const { return y_[static_cast<unsigned>(index)]; }
  [[nodiscard]] double x_first() const { return x(0); }
  [[nodiscard]] double y_first() const { return y(0); }
  [[nodiscard]] double x_last() const { return x(count_ - 1); }
  [[nodiscard]] double y_last() const { return y(count_ - 1); }

  /// y at x. The table must not be empty.
  [[nodiscard]] double at(double x_value) const {
    return interpolated(x_.data(), y_.data(), count_, x_value);
  }
  /// x at y. The table must not be empty.
  [[nodiscard]] double inverse(double y_value) const {
    return interpolated(y_.data(), x_.data(), count_, y_value);
  }
  /// Least end of the segment that holds this y.
  [[nodiscard]] int segment_of_y(double y_value) const {
    return segment_of(y_.data(), count_, y_value);
  }

 private:
  std::array<double, kMost> x_{};
  std::array<double, kMost> y_{};
  int count_ = 0;
};

using MonotoneTable = MonotoneTableOf<32>;

}  // namespace graben
