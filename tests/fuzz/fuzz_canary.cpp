// SPDX-License-Identifier: Apache-2.0
/// A target with a defect: it does not bear one of its numbers being NaN.

#include <array>
#include <cmath>

#include "tests/fuzz/fuzz_target.hpp"

namespace graben::test {

using Numbers = std::array<double, 16>;

std::string check_bytes(const std::uint8_t* data, std::size_t size) {
  const auto numbers = raw_from_bytes<Numbers>(data, size);
  return std::isnan(numbers[3]) ? "the planted defect" : "";
}

bool inputs_are_numbers() { return true; }

std::vector<Bytes> seed_inputs() { return {bytes_from_raw(Numbers{})}; }

}  // namespace graben::test
