#include "firmware/mcv/algorithm1.hpp"

namespace graben {

McvSolution solve_algorithm1(const McvMachine& machine, const McvInput& input) {
  McvSolution solution;
  solution.defect = check_machine(machine);
  if (solution.defect.defect == McvDefect::kNone) {
    solution.defect = check_input(machine, input);
  }
  if (solution.defect.defect != McvDefect::kNone) {
    return solution;
  }

  McvPoint point = evaluate(machine, input, 1.0);
  bool converged = point.converged;
  if (point.feasible) {
    solution.status = SolveStatus::kOk;
    solution.point = point;
    return solution;
  }
  McvPoint best;
  best.feasible = true;
  Limit limit = point.limit;
  double lambda = 1.0;
  double step = 1.0;
  for (; solution.iterations < kAlgorithm1Iterations; ++solution.iterations) {
    step *= 0.5;
    lambda += point.feasible ? step : -step;
    point = evaluate(machine, input, lambda);
    converged = converged && point.converged;
    if (point.feasible) {
      best = point;
    } else {
      limit = point.limit;
    }
  }
  // The last infeasible point lies one last step above the last feasible one (Theorem 4), so
  // `limit` is what fails just above, and `best` what the paper's final lines return.
  solution.limit = limit;
  if (!converged) {
    solution.status = SolveStatus::kNotConverged;
    return solution;
  }
  solution.point = best;
  solution.status = best.lambda > 0.0 ? SolveStatus::kOk : SolveStatus::kInfeasible;
  return solution;
}

}  // namespace graben
