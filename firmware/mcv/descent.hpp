#pragma once
/// What the policies that search over r share.

#include "firmware/mcv/policies.hpp"
#include "firmware/mcv/requirement.hpp"

namespace graben {

/// How far inside its interval a result is put, so that rounding does not decide; grows wherever
/// that was not enough.
class Inset {
 public:
  /// A little less than lambda.
  [[nodiscard]] double operator()(double lambda) const { return lambda * (1.0 - share_); }
  void widen() { share_ *= 16.0; }

 private:
  double share_ = 1.0 / 1073741824.0;  // 2^-30
};

/// lambda_max, or the smallest lambda at which a pump can just feed its line, and that limit.
struct Start {
  double lambda = 0.0;
  Limit limit;
};
[[nodiscard]] Start fed_start(const McvCircuit& circuit, double lambda_max, const Inset& inset);

/// lambda at r; 0 where there is none.
[[nodiscard]] double lambda_at(const FlowBalance& line, double ratio);

/// The requirement behind a limit of an axis.
[[nodiscard]] Requirement requirement_of(const McvCircuit& circuit, const Limit& limit);

}  // namespace graben
