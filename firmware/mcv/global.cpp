#include <limits>

#include "firmware/mcv/descent.hpp"

namespace graben {
namespace {

/// Largest lambda under point.lambda at which the constraint that fails there holds.
double next_lambda(const McvCircuit& circuit, const McvPoint& point, PolicyResult& result) {
  if (point.limit.kind == LimitKind::kPumpFlow) {
    return point.lambda;  // By rounding only: the search starts where every pump feeds its line.
  }
  const unsigned pump = circuit.axis[point.limit.index].pump;
  const FlowBalance& line = circuit.line[pump];
  const Change change = first_change(requirement_of(circuit, point.limit), line, Towards::kSlower,
                                     point.sqrt_pressure[pump] / point.lambda,
                                     std::numeric_limits<double>::infinity());
  result.iterations += change.steps;
  result.bounded = result.bounded && change.bounded;
  return change.found ? lambda_at(line, change.ratio) : 0.0;
}

}  // namespace

PolicyResult choose_global(const McvCircuit& circuit, double lambda_max) {
  PolicyResult result;
  Inset inset;
  Start start = fed_start(circuit, lambda_max, inset);
  double lambda = start.lambda;
  result.limit = start.limit;
  for (int jump = 0; jump < kGlobalJumps && result.bounded; ++jump) {
    if (!(lambda >= kStandstillLambda)) {
      return result;
    }
    const McvPoint point = evaluate(circuit, lambda);
    ++result.iterations;
    if (point.feasible) {
      result.point = point;
      return result;
    }
    result.limit = point.limit;
    result.bounded = point.converged;
    const double next = inset(next_lambda(circuit, point, result));
    if (next < inset(lambda)) {
      lambda = next;
    } else {
      lambda = inset(lambda);
      inset.widen();
    }
  }
  result.bounded = false;
  return result;
}

}  // namespace graben
