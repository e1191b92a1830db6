// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Parts that the policies share that search over r.

#include "firmware/mcv/policies.hpp"
#include "firmware/mcv/requirement.hpp"

namespace graben {

/// How far inside its interval a result is put, so that rounding does not decide; grows wherever
/// that was not enough.
class Inset {
 public:
  /// A little less than lambda.
  [[nodiscard]] double operator()(double lambda) const { return lambda * (1.0 - share_); }
  void widen() { share_ = share_ < 0.03 ? 16.0 * share_ : 0.5; }

 private:
  double share_ = 1.0 / 1073741824.0;  // 2^-30
};

/// `most`, or the smallest lambda at which a pump can just feed its line, and that limit.
struct Start {
  double lambda = 0.0;
  Limit limit;
};
[[nodiscard]] Start fed_start(const McvCircuit& circuit, double most, const Inset& inset);

/// Where a constraint changes, as a lambda.
struct LambdaChange {
  double lambda = 0.0;
  int steps = 0;
  bool bounded = true;
  double ratio = 0.0;  ///< r of the axis' line there; 0 where it is not known.
};

/// Largest lambda under that of `failing` at which both constraints of the axis that lacks most
/// there hold; below `least`, which is not looked at, 0 or any. `limit` becomes the one that fails
/// just above it.
[[nodiscard]] LambdaChange holds_again(const McvCircuit& circuit, const McvPoint& failing,
                                       double least, Limit& limit);

/// Smallest lambda over that of `slow` at which a constraint that holds there fails; infinite if
/// there is none up to `fastest`. Not for starved lines. Only the pressures of the two points
/// count.
[[nodiscard]] LambdaChange fails_first(const McvCircuit& circuit, const Limit& limit,
                                       const McvPoint& slow, const McvPoint& fastest);

/// True where a line has no pump flow to speak of and still feeds motion by regeneration: there
/// rounding shows in lambda over r, and what a search over r finds is only a guess.
[[nodiscard]] bool is_any_starved(const McvCircuit& circuit);

/// The end of an interval by halving, down to `width` of lambda, at most 31 evaluations. `low` is
/// feasible or lambda 0, `high` infeasible. While the axis or the pump that failed last still
/// fails, nothing else is asked.
struct Halved {
  McvPoint point;
  Limit limit;  ///< What fails just above; where the steps ended first, what failed last.
  int evaluations = 0;
  bool bounded = true;
};
[[nodiscard]] Halved halved(const McvCircuit& circuit, const McvPoint& low, const McvPoint& high,
                            double width);

}  // namespace graben
