// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The middle of many values.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace graben::identify {

/// Of an even number the upper one; of none it is not defined.
[[nodiscard]] inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace graben::identify
