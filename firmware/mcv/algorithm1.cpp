#include "firmware/mcv/policies.hpp"

namespace graben {

PolicyResult choose_algorithm1(const McvCircuit& circuit, double lambda_max) {
  PolicyResult result;
  McvPoint point = evaluate(circuit, lambda_max);
  result.bounded = point.converged;
  if (point.feasible) {
    result.point = point;
    return result;
  }
  result.limit = point.limit;
  double lambda = lambda_max;
  double step = lambda_max;
  for (; result.iterations < kAlgorithm1Iterations; ++result.iterations) {
    step *= 0.5;
    lambda += point.feasible ? step : -step;
    point = evaluate(circuit, lambda);
    result.bounded = result.bounded && point.converged;
    if (point.feasible) {
      result.point = point;
    } else {
      result.limit = point.limit;
    }
  }
  // The last infeasible point lies one last step above the last feasible one (Theorem 4), so
  // `limit` is what fails just above, and `point` what the paper's final lines return.
  return result;
}

}  // namespace graben
