#pragma once
/// Figures of many values.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace graben::runs {

/// The upper one of two in the middle; 0 of nothing.
[[nodiscard]] inline double median(std::vector<double> values) {
  if (values.empty()) {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Maximum and root mean square of what is fed in.
class Spread {
 public:
  void add(double value) {
    max_ = std::max(max_, value);
    squares_ += value * value;
    ++count_;
  }
  [[nodiscard]] double max() const { return max_; }
  [[nodiscard]] double rms() const {
    return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : 0.0;
  }

 private:
  double max_ = 0.0;
  double squares_ = 0.0;
  long count_ = 0;
};

}  // namespace graben::runs
