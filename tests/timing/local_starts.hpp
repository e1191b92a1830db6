// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the local methods start, and what they do where that leads nowhere.

#include <algorithm>

#include "tests/timing/lambda_problem.hpp"

namespace graben::timing {

/// Shares of highest_lambda(). Half: from the top a pump that can only just feed its line has
/// pressure 0 and forces without a slope there; from near standstill a split feasible set ends at
/// its first gap. The second is taken only where the first ended at a point that is not feasible,
/// at most 8 of the reference cases.
inline constexpr double kLocalStarts[] = {0.5, 0.01};

/// How far above a feasible lambda a solver's answer may lie: they stop at the boundary from either
/// side.
inline constexpr double kOvershoot = 1e-7;

/// The first answer of `from(start)` that is feasible; below 0 is a failure. 0 if there is none.
template <class From>
[[nodiscard]] double first_feasible(const LambdaProblem& problem, const From& from) {
  for (const double share : kLocalStarts) {
    const double lambda = from(share * problem.highest_lambda());
    LambdaProblem::Near near;
    if (lambda >= 0.0 && lambda <= problem.highest_lambda() &&
        problem.smallest_margin(std::max(0.0, lambda - kOvershoot), near) >= 0.0) {
      return lambda;
    }
  }
  return 0.0;
}

}  // namespace graben::timing
