// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "firmware/mcv/work.hpp"

namespace graben::test {

/// As many steps as a number can say, for a circuit that is looked at by itself.
[[nodiscard]] inline Work* endless_work() {
  thread_local Work work;
  work.left = std::numeric_limits<int>::max();
  return &work;
}

}  // namespace graben::test
