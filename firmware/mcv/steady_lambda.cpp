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
  McvSolution solution = solve_mcv(machine, input, policy, {bound, rise.reserve_n});
  if (solution.status == SolveStatus::kBadInput || solution.point.lambda >= last_lambda) {
    return solution;
  }
  const Limit risen_limit = solution.limit;
  const double risen_shortfall = solution.shortfall;
  solution =
      solve_mcv(machine, input, policy,
                {std::clamp(last_lambda, kLeastBound, 1.0), rise.reserve_n, rise.hold_share});
  if (solution.status == SolveStatus::kOk && solution.limit.kind == LimitKind::kNone) {
    solution.limit = risen_limit;
    solution.shortfall = risen_shortfall;
  }
  return solution;
}

}  // namespace graben
