#include <algorithm>

#include "firmware/mcv/descent.hpp"

namespace graben {
namespace {

/// Lowers `start` to where the constraint first fails on the way up from standstill.
void hold(const McvCircuit& circuit, const McvPoint& standstill, const McvPoint& fastest,
          const Limit& limit, Start& start, PolicyResult& result) {
  const LambdaChange change = fails_first(circuit, limit, standstill, fastest);
  result.iterations += change.steps;
  result.bounded = result.bounded && change.bounded;
  if (change.lambda < start.lambda) {
    start = {change.lambda, limit};
  }
}

}  // namespace

PolicyResult choose_connected(const McvCircuit& circuit, double lambda_max) {
  PolicyResult result;
  Inset inset;
  Start start = fed_start(circuit, lambda_max, inset);
  if (start.lambda < kStandstillLambda) {
    result.limit = start.limit;
    return result;
  }
  const McvPoint standstill = evaluate(circuit, kStandstillLambda);
  const McvPoint fastest = evaluate(circuit, start.lambda);
  result.iterations = 2;
  result.bounded = standstill.converged && fastest.converged;
  if (!standstill.feasible) {
    result.limit = standstill.limit;
    return result;
  }
  const Start fed = start;
  for (unsigned i = 0; i < circuit.axis_count && result.bounded; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    if (axis.moves && !is_starved(circuit.line[axis.pump])) {
      const auto index = static_cast<std::uint8_t>(i);
      hold(circuit, standstill, fastest, {LimitKind::kBackFlow, index}, start, result);
      hold(circuit, standstill, fastest, {LimitKind::kSpoolTravel, index}, start, result);
    }
  }
  const double inside = start.limit.kind == LimitKind::kNone ? start.lambda : inset(start.lambda);
  if (result.bounded && !is_any_starved(circuit)) {
    result.point = evaluate(circuit, inside);
    result.limit = start.limit;
    ++result.iterations;
    if (result.point.feasible) {
      return result;
    }
  }
  // Rounding decides where the interval ends.
  const Start& end = result.bounded ? start : fed;
  const Halved found = halved(circuit, standstill, end.lambda);
  result.point = found.point;
  result.limit = found.limit.kind == LimitKind::kNone ? end.limit : found.limit;
  result.iterations += found.evaluations;
  result.bounded = true;
  return result;
}

}  // namespace graben
