#pragma once
/// Algorithm 1 of Kim et al.: divide and conquer for lambda, (37).

#include "firmware/mcv/evaluation.hpp"

namespace graben {

/// What the optimiser returns: command, what it achieves, why not more, how it ended.
struct McvSolution {
  SolveStatus status = SolveStatus::kBadInput;
  McvPoint point;  ///< The circuit at the lambda returned; at lambda 0 every spool is closed.
  Limit limit;     ///< The constraint that fails just above; none at lambda = 1.
  int iterations = 0;
  McvCheck defect;  ///< Set with kBadInput.
};

/// Halvings of Algorithm 1: the step after the last is 2^-24 = 6.0e-8, under the paper's
/// epsilon of 1e-7.
inline constexpr int kAlgorithm1Iterations = 24;

/// Local maximum of (37), the global one unless regeneration splits the feasible set (Theorem 4).
/// Constant cost: at most kAlgorithm1Iterations + 1 evaluations. Bad input, no feasible lambda and
/// an iteration that did not end each give lambda 0 with closed spools and their status.
[[nodiscard]] McvSolution solve_algorithm1(const McvMachine& machine, const McvInput& input);

}  // namespace graben
