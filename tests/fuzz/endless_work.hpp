// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "firmware/mcv/work.hpp"

namespace graben::test {

/// As many steps as a number can say, for a circuit that is looked at by itself.
[[nodiscard]] inline Work* endless_work() {
#ifdef __linux__
  thread_local Work work;
#else
  static Work work;  // Bare metal has one thread, and no library that keeps more apart.
#endif
  work.left = std::numeric_limits<int>::max();
  return &work;
}

}  // namespace graben::test
