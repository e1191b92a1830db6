// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A script from its first cycle to its last.

#include <vector>

#include "tests/timing/counts/script.hpp"

namespace graben::timing {

struct Played {
  TraceStart start;
  std::vector<TraceCycle> cycles;
};

/// Throws std::runtime_error.
[[nodiscard]] Played play(const Script& script);
/// One with a row of tests/faults.
[[nodiscard]] Played play_row(const Script& script);

}  // namespace graben::timing
