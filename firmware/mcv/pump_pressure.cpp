#include "firmware/mcv/pump_pressure.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/hydraulics/regeneration.hpp"

namespace graben {
namespace {

constexpr int kNewtonSteps = 24;
/// Residual that rounding of the balance's terms alone explains, as a share of their sum.
constexpr double kRoundingShare = 32.0 * 2.220446049250313e-16;

double flow_left_slope(const FlowBalance& balance, double s) {
  double slope =
      -2.0 * balance.leak_linear * s - 4.0 * balance.leak_quadratic * s * s * s - balance.bypass;
  for (int i = 0; i < balance.regeneration_count; ++i) {
    const RegenerationDemand& demand = balance.regeneration[static_cast<unsigned>(i)];
    // At the opening itself the slope from the left counts: Newton runs down from there.
    if (s <= demand.q_out_m3ps / demand.c_drain) {
      slope -= demand.c_drain *
               return_gallery_slope(demand.q_out_m3ps, s, demand.c_drain, demand.c_check);
    }
  }
  return slope;
}

double total_flow(const FlowBalance& balance) {
  double total = balance.flow_m3ps + std::abs(balance.in_flow_m3ps);
  for (int i = 0; i < balance.regeneration_count; ++i) {
    total += balance.regeneration[static_cast<unsigned>(i)].q_out_m3ps;
  }
  return total;
}

/// An s at which each of the falling terms alone would use up the flow is right of the root.
double upper_bound(const FlowBalance& balance, double left_at_zero) {
  double bound = left_at_zero / balance.bypass;
  if (balance.leak_linear > 0.0) {
    bound = std::min(bound, std::sqrt(left_at_zero / balance.leak_linear));
  }
  if (balance.leak_quadratic > 0.0) {
    bound = std::min(bound, std::sqrt(std::sqrt(left_at_zero / balance.leak_quadratic)));
  }
  return bound;
}

}  // namespace

double flow_left(const FlowBalance& balance, double sqrt_pressure) {
  const double s = sqrt_pressure;
  double left = balance.flow_m3ps - balance.in_flow_m3ps -
                s * (balance.bypass + s * (balance.leak_linear + balance.leak_quadratic * s * s));
  for (int i = 0; i < balance.regeneration_count; ++i) {
    const RegenerationDemand& demand = balance.regeneration[static_cast<unsigned>(i)];
    left -= demand.c_drain *
            return_gallery(demand.q_out_m3ps, s, demand.c_drain, demand.c_check).sqrt_pressure;
  }
  return left;
}

PumpPressure solve_pump_pressure(const FlowBalance& balance, bool has_relief, double relief_pa) {
  PumpPressure result;
  const double left_at_zero = flow_left(balance, 0.0);
  if (!(left_at_zero >= 0.0)) {
    return result;
  }
  result.fed = true;
  if (!(balance.bypass > 0.0)) {
    result.converged = true;
    return result;
  }
  double start = upper_bound(balance, left_at_zero);
  if (has_relief) {
    const double sqrt_relief = std::sqrt(relief_pa);
    if (sqrt_relief < start) {
      if (flow_left(balance, sqrt_relief) >= 0.0) {
        result.converged = true;
        result.sqrt_pressure = sqrt_relief;
        return result;
      }
      start = sqrt_relief;
    }
  }
  for (int i = 0; i < balance.regeneration_count; ++i) {
    const RegenerationDemand& demand = balance.regeneration[static_cast<unsigned>(i)];
    const double opening = demand.q_out_m3ps / demand.c_drain;
    if (opening < start && flow_left(balance, opening) <= 0.0) {
      start = opening;
    }
  }
  const double rounding = kRoundingShare * total_flow(balance);
  double s = start;
  for (int step = 0; step < kNewtonSteps && !result.converged; ++step) {
    const double left = flow_left(balance, s);
    // From the right the balance rises to zero and never passes it but by rounding. The step that
    // finds that still counts: it takes off what the residual allows for.
    result.converged = left >= -rounding;
    s = std::max(0.0, s - left / flow_left_slope(balance, s));
    ++result.iterations;
  }
  result.converged = result.converged && std::isfinite(s * s);
  result.sqrt_pressure = s;
  return result;
}

}  // namespace graben
