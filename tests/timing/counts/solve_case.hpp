// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A case of the optimiser as a file holds it: written on the host, solved on every target.
/// Numbers as little-endian IEEE 754 doubles, one after the other.

#include <cstdio>

#include "firmware/mcv/optimiser.hpp"

namespace graben::timing {

struct SolveCase {
  McvMachine machine;
  McvInput input;
  LambdaRise rise;
  double last_lambda = 0.0;
};

[[nodiscard]] bool write(std::FILE* file, const SolveCase& written);
/// False at the end of the file, or of what is right in it.
[[nodiscard]] bool read(std::FILE* file, SolveCase& found);

}  // namespace graben::timing
