#include "firmware/mcv/steady_lambda.hpp"

#include <algorithm>

namespace graben {
namespace {

/// What the first cycle from rest may reach, whatever its period.
constexpr double kLeastBound = 1e-3;

}  // namespace

McvSolution steady_lambda(const McvMachine& machine, const McvInput& input, McvPolicy policy,
                          const LambdaRise& rise, double last_lambda, double period_s) {
  const double bound = std::clamp(last_lambda + rise.rate_ps * period_s, kLeastBound, 1.0);
  const McvSolution risen = solve_mcv(machine, input, policy, {bound, rise.reserve_n});
  if (risen.status == SolveStatus::kBadInput || risen.point.lambda >= last_lambda) {
    return risen;
  }
  McvSolution held =
      solve_mcv(machine, input, policy,
                {std::clamp(last_lambda, kLeastBound, 1.0), rise.reserve_n, rise.hold_share});
  if (held.status == SolveStatus::kOk && held.limit.kind == LimitKind::kNone) {
    held.limit = risen.limit;
    held.shortfall = risen.shortfall;
  }
  return held;
}

}  // namespace graben
