// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace graben::test {

/// How often a test repeats what it draws at random: `all`, or `few` where the processor is
/// emulated or the code instrumented (GRABEN_FEW_ROUNDS).
constexpr int rounds([[maybe_unused]] int all, [[maybe_unused]] int few) {
#ifdef GRABEN_FEW_ROUNDS
  return few;
#else
  return all;
#endif
}

}  // namespace graben::test
