#pragma once
/// Piecewise-linear, strictly increasing table with fixed capacity, readable both ways.

#include <array>

namespace graben {

/// y over x, both strictly increasing and finite; between the points linear, outside held at the
/// ends. Allocation-free; `at` and `inverse` cost one bisection over at most kCapacity points.
class MonotoneTable {
 public:
  static constexpr int kCapacity = 32;

  enum class Fill { kOk, kTooFew, kTooMany, kNotFinite, kNotIncreasing };

  /// Replaces the contents. On any result but kOk the table is empty.
  [[nodiscard]] Fill fill(const double* x, const double* y, int count);

  [[nodiscard]] int size() const { return count_; }
  [[nodiscard]] double x(int index) const { return x_[static_cast<unsigned>(index)]; }
  [[nodiscard]] double y(int index) const { return y_[static_cast<unsigned>(index)]; }
  [[nodiscard]] double x_first() const { return x(0); }
  [[nodiscard]] double y_first() const { return y(0); }
  [[nodiscard]] double x_last() const { return x(count_ - 1); }
  [[nodiscard]] double y_last() const { return y(count_ - 1); }

  /// y at x. The table must not be empty.
  [[nodiscard]] double at(double x_value) const;
  /// x at y. The table must not be empty.
  [[nodiscard]] double inverse(double y_value) const;

 private:
  std::array<double, kCapacity> x_{};
  std::array<double, kCapacity> y_{};
  int count_ = 0;
};

}  // namespace graben
