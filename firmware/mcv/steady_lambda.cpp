#include "firmware/mcv/steady_lambda.hpp"

#include <algorithm>

namespace graben {
namespace {

/// What the first cycle from rest may reach, whatever its period.
constexpr double kLeastBound = 1e-3;

}  // namespace

McvInput mcv_input(Span<const double> velocity_mps, Span<const LoadState> load,
                   Span<const double> pump_flow_m3ps) {
  McvInput input;
  for (int i = 0; i < load.count(); ++i) {
    const auto k = static_cast<unsigned>(i);
    input.velocity_mps[k] = velocity_mps[i];
    input.cap_pressure_pa[k] = load[i].cap_pa;
    input.rod_pressure_pa[k] = load[i].rod_pa;
  }
  std::copy(pump_flow_m3ps.begin(), pump_flow_m3ps.end(), input.pump_flow_m3ps.begin());
  return input;
}

McvSolution steady_lambda(const McvMachine& machine, const McvInput& input, McvPolicy policy,
                          const LambdaRise& rise, double last_lambda, double period_s) {
  const double bound = std::clamp(last_lambda + rise.rate_ps * period_s, kLeastBound, 1.0);
  const double hold = last_lambda > 0.0 ? std::clamp(last_lambda, kLeastBound, 1.0) : 0.0;
  return solve_mcv(machine, input, policy,
                   {std::max(bound, hold), rise.reserve_n, hold, rise.hold_share});
}

}  // namespace graben
