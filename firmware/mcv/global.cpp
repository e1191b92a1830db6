// SPDX-License-Identifier: Apache-2.0
#include "firmware/mcv/descent.hpp"

namespace graben {
namespace {

/// `above`: the last infeasible point that was met; lambda 0 without one.
PolicyResult search(const Asked& asked, McvPoint& above) {
  PolicyResult result;
  Inset inset;
  Start start = fed_start(asked.rising(), asked.most, inset);
  double lambda = start.lambda;
  McvPoint last;  // With what is known of r at the next lambda.
  result.limit = start.limit;
  for (int jump = 0; jump < kGlobalJumps && result.bounded; ++jump) {
    if (!(lambda >= kStandstillLambda)) {
      return result;
    }
    if (!may_step(asked.circuit.work)) {
      break;
    }
    const McvCircuit& circuit = asked.at(lambda);
    const McvPoint point = evaluate(circuit, lambda, jump == 0 ? nullptr : &last);
    ++result.iterations;
    if (point.feasible) {
      result.point = point;
      return result;
    }
    result.limit = point.limit;
    result.bounded = point.converged;
    last = point;
    above = point;
    double next = lambda;
    // A pump flow limit here is rounding: the search starts where every pump feeds its line.
    if (point.limit.kind != LimitKind::kPumpFlow) {
      const double least = lambda > asked.hold ? asked.hold : 0.0;
      const LambdaChange change = holds_again(circuit, point, least, result.limit);
      result.iterations += change.steps;
      result.bounded = result.bounded && change.bounded;
      next = inset(change.lambda);
      if (change.ratio > 0.0) {
        last.sqrt_pressure[circuit.axis[result.limit.index].pump] = change.ratio * last.lambda;
      }
    }
    if (!(next < inset(lambda))) {
      next = inset(lambda);
      inset.widen();
    }
    // What is left out above says nothing of `hold` and below, where less reserve is asked for.
    lambda = lambda > asked.hold && next < asked.hold ? asked.hold : next;
  }
  result.bounded = false;
  return result;
}

}  // namespace

PolicyResult choose_global(const Asked& asked) {
  McvPoint above;
  PolicyResult found = search(asked, above);
  if (found.bounded && !is_any_starved(asked.rising())) {
    return found;
  }
  if (found.bounded && found.point.lambda > 0.0) {
    // The search came down to it by its own guess and by insets that grew.
    if (above.lambda > 0.0) {
      const Halved end =
          halved(asked.at(above.lambda), found.point, above, kAlgorithm1Width * asked.most);
      found.iterations += end.evaluations;
      // Without an end what was found stays, as it is feasible.
      if (end.bounded) {
        found.point = end.point;
        found.limit = end.limit;
      }
    }
    return found;
  }
  PolicyResult other = choose_algorithm1(asked);
  other.iterations += found.iterations;
  return other.bounded ? other : found;
}

}  // namespace graben
