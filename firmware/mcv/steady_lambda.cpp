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
  if (risen.point.lambda > 0.0 && risen.point.lambda >= last_lambda) {
    return risen;
  }
  // Where no lambda has the reserve, it must not forbid what is feasible.
  const bool without = risen.point.lambda == 0.0;
  const double most = without ? bound : std::max(last_lambda, kLeastBound);
  McvSolution held = solve_mcv(machine, input, policy, {most, 0.0});
  if (!without && held.status == SolveStatus::kOk && held.limit.kind == LimitKind::kNone) {
    held.limit = risen.limit;
    held.shortfall = risen.shortfall;
  }
  return held;
}

}  // namespace graben
