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
  const double hold = last_lambda > 0.0 ? std::clamp(last_lambda, kLeastBound, 1.0) : 0.0;
  return solve_mcv(machine, input, policy,
                   {std::max(bound, hold), rise.reserve_n, hold, rise.hold_share});
}

}  // namespace graben
