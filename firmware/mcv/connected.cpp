#include <algorithm>

#include "firmware/mcv/descent.hpp"

namespace graben {
namespace {

/// Insets tried; the last is all the way back to standstill, which is feasible. More than one or
/// two only on starved lines, where rounding decides what r says of lambda.
constexpr int kRetreats = 12;

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
  for (unsigned i = 0; i < circuit.axis_count && result.bounded; ++i) {
    if (circuit.axis[i].moves) {
      const auto index = static_cast<std::uint8_t>(i);
      hold(circuit, standstill, fastest, {LimitKind::kBackFlow, index}, start, result);
      hold(circuit, standstill, fastest, {LimitKind::kSpoolTravel, index}, start, result);
    }
  }
  result.limit = start.limit;
  double lambda = start.limit.kind == LimitKind::kNone ? start.lambda : inset(start.lambda);
  for (int retreat = 0; retreat < kRetreats && result.bounded; ++retreat) {
    result.point = evaluate(circuit, std::max(lambda, kStandstillLambda));
    ++result.iterations;
    if (result.point.feasible) {
      if (start.limit.kind != LimitKind::kNone) {
        result.point = refined(circuit, result.point, start.lambda);
      }
      return result;
    }
    result.limit = result.point.limit;
    lambda = retreat == kRetreats - 2 ? kStandstillLambda : inset(lambda);
    inset.widen();
  }
  result.bounded = false;
  return result;
}

}  // namespace graben
