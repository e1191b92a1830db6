// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Cube root that is the same bit for bit on every target. C libraries round theirs differently by
/// a unit in the last place, and lambda has to be the same wherever it is computed.

#include <cmath>
#include <cstdint>
#include <cstring>

namespace graben {

/// Within a unit in the last place of the cube root of any number; what is not finite and both
/// zeros are returned as they are. Additions, multiplications and divisions only.
[[nodiscard]] inline double cube_root(double value) {
  if (value == 0.0 || !std::isfinite(value)) {
    return value;
  }
  double cube = std::abs(value);
  double scale = 1.0;
  // Where 2 root^3 + cube would overflow, or digits are missing.
  if (cube > 0x1p900) {
    cube *= 0x1p-300;
    scale = 0x1p100;
  } else if (cube < 0x1p-900) {
    cube *= 0x1p300;
    scale = 0x1p-100;
  }
  // A double's bits grow about as its logarithm does: a third of them, and two thirds of the
  // exponent's bias, are within 6 % of the root.
  std::uint64_t bits = 0;
  std::memcpy(&bits, &cube, sizeof(bits));
  bits = bits / 3U + (std::uint64_t{682} << 52U);
  double root = 0.0;
  std::memcpy(&root, &bits, sizeof(root));
  // Halley: an error of e leaves 2/3 e^3, so 2e-4, 3e-12 and then rounding alone.
  for (int step = 0; step < 3; ++step) {
    const double third = root * root * root;
    root += root * ((cube - third) / (2.0 * third + cube));
  }
  return std::copysign(root * scale, value);
}

}  // namespace graben
