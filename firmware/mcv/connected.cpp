// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "firmware/mcv/descent.hpp"

namespace graben {
namespace {

/// Width to halve an interval down to, as a share of its upper end: 2^-30. [-; derived: what all
/// halvings of halved() leave of [0, 1]]
constexpr double kWidth = 1.0 / 1073741824.0;

/// Lowers `start` to where the constraint first fails on the way up from `slow`.
void hold(const McvCircuit& circuit, const McvPoint& slow, const McvPoint& fastest,
          const Limit& limit, Start& start, PolicyResult& result) {
  const LambdaChange change = fails_first(circuit, limit, slow, fastest);
  result.iterations += change.steps;
  result.bounded = result.bounded && change.bounded;
  if (change.lambda < start.lambda) {
    start = {change.lambda, limit};
  }
}

/// The end of the feasible interval that contains `slow`, a feasible point, up to `most`.
PolicyResult climb(const McvCircuit& circuit, const McvPoint& slow, double most) {
  PolicyResult result;
  Inset inset;
  Start start = fed_start(circuit, most, inset);
  result.point = slow;
  if (start.lambda <= slow.lambda) {
    result.limit = start.limit;
    return result;
  }
  const McvPoint fastest = evaluate(circuit, start.lambda);
  result.iterations = 1;
  result.bounded = fastest.converged;
  const Start fed = start;
  for (unsigned i = 0; i < circuit.axis_count && result.bounded; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    if (axis.moves && !is_starved(circuit.line[axis.pump])) {
      const auto index = static_cast<std::uint8_t>(i);
      hold(circuit, slow, fastest, {LimitKind::kBackFlow, index}, start, result);
      hold(circuit, slow, fastest, {LimitKind::kSpoolTravel, index}, start, result);
    }
  }
  const double inside = start.limit.kind == LimitKind::kNone ? start.lambda : inset(start.lambda);
  if (result.bounded && !is_any_starved(circuit)) {
    const McvPoint point = evaluate(circuit, inside);
    ++result.iterations;
    if (point.feasible) {
      result.point = point;
      result.limit = start.limit;
      return result;
    }
  }
  // Rounding decides where the interval ends, or the search has used up its steps.
  allow_kept(circuit.work);
  const Start& end = result.bounded ? start : fed;
  const McvPoint high = evaluate(circuit, end.lambda);
  ++result.iterations;
  result.limit = end.limit;
  result.bounded = high.converged;
  if (high.feasible) {
    result.point = high;
    return result;
  }
  const Halved found = halved(circuit, slow, high, kWidth * high.lambda);
  result.point = found.point;
  result.limit = found.limit;
  result.iterations += found.evaluations;
  result.bounded = result.bounded && found.bounded;
  return result;
}

PolicyResult climb_from_standstill(const McvCircuit& circuit, double most) {
  if (most < kStandstillLambda) {
    return {};
  }
  const McvPoint standstill = evaluate(circuit, kStandstillLambda);
  if (standstill.feasible) {
    return climb(circuit, standstill, most);
  }
  PolicyResult result;
  result.limit = standstill.limit;
  result.iterations = 1;
  result.bounded = standstill.converged;
  return result;
}

}  // namespace

PolicyResult choose_connected(const Asked& asked) {
  const bool holds = asked.hold >= kStandstillLambda;
  PolicyResult result =
      holds ? climb_from_standstill(asked.holding(), std::min(asked.hold, asked.most))
            : climb_from_standstill(asked.rising(), asked.most);
  if (!holds || result.limit.kind != LimitKind::kNone || asked.hold >= asked.most) {
    return result;
  }
  const McvPoint slow = evaluate(asked.rising(), result.point.lambda, &result.point);
  ++result.iterations;
  if (!slow.feasible) {
    result.limit = slow.limit;
    result.bounded = slow.converged;
    return result;
  }
  const int iterations = result.iterations;
  result = climb(asked.rising(), slow, asked.most);
  result.iterations += iterations;
  return result;
}

}  // namespace graben
