#include "firmware/mcv/descent.hpp"

namespace graben {
namespace {

PolicyResult search(const McvCircuit& circuit, double lambda_max) {
  PolicyResult result;
  Inset inset;
  Start start = fed_start(circuit, lambda_max, inset);
  double lambda = start.lambda;
  McvPoint last;  // With what is known of r at the next lambda.
  result.limit = start.limit;
  for (int jump = 0; jump < kGlobalJumps && result.bounded; ++jump) {
    if (!(lambda >= kStandstillLambda)) {
      return result;
    }
    const McvPoint point = evaluate(circuit, lambda, jump == 0 ? nullptr : &last);
    ++result.iterations;
    if (point.feasible) {
      result.point = point;
      return result;
    }
    result.limit = point.limit;
    result.bounded = point.converged;
    last = point;
    double next = lambda;
    // A pump flow limit here is rounding: the search starts where every pump feeds its line.
    if (point.limit.kind != LimitKind::kPumpFlow) {
      const LambdaChange change = holds_again(circuit, point, result.limit);
      result.iterations += change.steps;
      result.bounded = result.bounded && change.bounded;
      next = inset(change.lambda);
      if (change.ratio > 0.0) {
        last.sqrt_pressure[circuit.axis[result.limit.index].pump] = change.ratio * last.lambda;
      }
    }
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

}  // namespace

PolicyResult choose_global(const McvCircuit& circuit, double lambda_max) {
  const PolicyResult found = search(circuit, lambda_max);
  if (found.bounded && !is_any_starved(circuit)) {
    return found;
  }
  PolicyResult other = choose_algorithm1(circuit, lambda_max);
  other.iterations += found.iterations;
  const bool better = found.bounded && found.point.lambda >= other.point.lambda;
  return better || !other.bounded ? found : other;
}

}  // namespace graben
