#include "firmware/mcv/pump_pressure.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/hydraulics/regeneration.hpp"

namespace graben {
namespace {

constexpr int kNewtonSteps = 24;
/// Residual that rounding of the balance's terms alone explains, as a share of their sum.
constexpr double kRoundingShare = 32.0 * 2.220446049250313e-16;

struct Residual {
  double left_m3ps = 0.0;
  double slope = 0.0;
};

/// g and dg/ds. At an opening itself the slope from the left counts: Newton runs down from there.
Residual residual(const FlowBalance& balance, double lambda, double s) {
  const double leak = s * (balance.leak_linear + balance.leak_quadratic * s * s);
  Residual result;
  result.left_m3ps =
      balance.flow_m3ps - lambda * balance.in_flow_m3ps - s * (balance.bypass + leak);
  result.slope = -2.0 * leak - 2.0 * balance.leak_quadratic * s * s * s - balance.bypass;
  for (int i = 0; i < balance.regeneration_count; ++i) {
    const RegenerationDemand& demand = balance.regeneration[static_cast<unsigned>(i)];
    const double opening = lambda * demand.opening;
    const GalleryPressure gallery = gallery_pressure(lambda * demand.q_out_m3ps, s, demand.c_drain,
                                                     demand.c_check, s <= opening && opening > 0.0);
    result.left_m3ps -= demand.c_drain * gallery.sqrt_pressure;
    result.slope -= demand.c_drain * gallery.slope;
  }
  return result;
}

double total_flow(const FlowBalance& balance, double lambda) {
  double total = std::abs(balance.in_flow_m3ps);
  for (int i = 0; i < balance.regeneration_count; ++i) {
    total += balance.regeneration[static_cast<unsigned>(i)].q_out_m3ps;
  }
  return balance.flow_m3ps + lambda * total;
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

double flow_left(const FlowBalance& balance, double lambda, double sqrt_pressure) {
  return residual(balance, lambda, sqrt_pressure).left_m3ps;
}

PumpPressure solve_pump_pressure(const FlowBalance& balance, double lambda) {
  PumpPressure result;
  result.flow_left_m3ps = flow_left(balance, lambda, 0.0);
  if (!(result.flow_left_m3ps >= 0.0)) {
    return result;
  }
  result.fed = true;
  if (!(balance.bypass > 0.0)) {
    result.converged = true;
    return result;
  }
  double start = upper_bound(balance, result.flow_left_m3ps);
  if (balance.has_relief && balance.sqrt_relief < start) {
    if (flow_left(balance, lambda, balance.sqrt_relief) >= 0.0) {
      result.converged = true;
      result.sqrt_pressure = balance.sqrt_relief;
      return result;
    }
    start = balance.sqrt_relief;
  }
  for (int i = 0; i < balance.regeneration_count; ++i) {
    const double opening = lambda * balance.regeneration[static_cast<unsigned>(i)].opening;
    if (opening < start && flow_left(balance, lambda, opening) <= 0.0) {
      start = opening;
    }
  }
  const double rounding = kRoundingShare * total_flow(balance, lambda);
  double s = start;
  for (int step = 0; step < kNewtonSteps && !result.converged; ++step) {
    const Residual at = residual(balance, lambda, s);
    // From the right the balance rises to zero and never passes it but by rounding. The step that
    // finds that still counts: it takes off what the residual allows for.
    result.converged = at.left_m3ps >= -rounding;
    s = std::max(0.0, s - at.left_m3ps / at.slope);
    ++result.iterations;
  }
  result.converged = result.converged && std::isfinite(s * s);
  result.sqrt_pressure = s;
  return result;
}

}  // namespace graben
