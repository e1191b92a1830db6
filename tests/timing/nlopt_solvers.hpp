// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the two NLopt peers share: ownership of NLopt's C object. The C interface, for it neither
/// copies vectors nor catches exceptions between solver and problem.

#include <nlopt.h>

#include <memory>
#include <stdexcept>

namespace graben::timing {

/// How far a scaled constraint may be violated for a point to count. With NLopt's default, 0, the
/// last iterates of SLSQP count only where rounding happens to be on their side, and what is
/// returned is an earlier one.
inline constexpr double kNloptMarginTolerance = 1e-8;
inline constexpr int kNloptMostEvaluations = 200;

struct DestroyNlopt {
  void operator()(nlopt_opt optimiser) const { nlopt_destroy(optimiser); }
};
using NloptOptimiser = std::unique_ptr<nlopt_opt_s, DestroyNlopt>;

/// Throws std::runtime_error: a setting that is refused would silently measure something else.
inline void nlopt_must(nlopt_result result) {
  if (result < 0) {
    throw std::runtime_error(nlopt_result_to_string(result));
  }
}

/// By NLopt's manual an end by rounding "typically still returns a useful result".
[[nodiscard]] inline bool nlopt_found(nlopt_result result) {
  return result > 0 || result == NLOPT_ROUNDOFF_LIMITED;
}

}  // namespace graben::timing
