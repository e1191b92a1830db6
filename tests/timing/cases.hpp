// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The reference cases of the optimiser, as both measuring programs read them.

#include <string>
#include <vector>

#include "firmware/mcv/optimiser.hpp"

namespace graben::timing {

struct TimedCase {
  unsigned line = 0;  ///< In its file, from 1.
  McvMachine machine;
  McvInput input;
};

/// Every `stride`-th case of a file of JSON lines, the first one included. Throws
/// std::runtime_error.
[[nodiscard]] std::vector<TimedCase> read_cases(const std::string& path, unsigned stride);

}  // namespace graben::timing
