// SPDX-License-Identifier: Apache-2.0
#include "firmware/mcv/pump_pressure.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/tuning.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

/// Newton steps to a pressure. [-; size: a unit test holds random circuits to 20]
constexpr int kPressureSteps = 24;
/// Flow that rounding alone leaves over, as a share of all flows: where a pump only just feeds its
/// line, no step gets shorter than kNewtonLastStep. [-; derived: about two units in a double's last
/// place]
constexpr double kFlowRoundingShare = 4.4e-16;

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

double rounding_of(const FlowBalance& balance, double lambda) {
  double moved_m3ps = std::abs(balance.in_flow_m3ps);
  for (int i = 0; i < balance.regeneration_count; ++i) {
    moved_m3ps += balance.regeneration[static_cast<unsigned>(i)].q_out_m3ps;
  }
  return kFlowRoundingShare * (balance.flow_m3ps + lambda * moved_m3ps);
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

/// Where the tangent of a guess left of the root ends: right of the root, unless a check valve
/// switches in between; then it says nothing.
double right_of_root(const FlowBalance& balance, double lambda, double guess, double tangent_end) {
  for (int i = 0; i < balance.regeneration_count; ++i) {
    const double opening = lambda * balance.regeneration[static_cast<unsigned>(i)].opening;
    if (opening >= guess && opening <= tangent_end) {
      return kInfinity;
    }
  }
  return tangent_end;
}

/// Left end of the stretch that ends at s or holds it.
double stretch_start(const FlowBalance& balance, double lambda, double s) {
  double start = 0.0;
  for (int i = 0; i < balance.regeneration_count; ++i) {
    const double opening = lambda * balance.regeneration[static_cast<unsigned>(i)].opening;
    if (opening < s) {
      start = std::max(start, opening);
    }
  }
  return start;
}

}  // namespace

double flow_left(const FlowBalance& balance, double lambda, double sqrt_pressure) {
  return residual(balance, lambda, sqrt_pressure).left_m3ps;
}

PumpPressure solve_pump_pressure(const FlowBalance& balance, double lambda, double guess) {
  PumpPressure result;
  const double left_at_zero = feed_margin_m3ps(balance, lambda);
  if (!(left_at_zero >= 0.0)) {
    return result;
  }
  result.fed = true;
  if (!(balance.bypass > 0.0)) {
    result.converged = true;
    return result;
  }
  const double rounding_m3ps = rounding_of(balance, lambda);
  const double relief = balance.has_relief ? balance.sqrt_relief : kInfinity;
  double s = std::min(guess < kInfinity ? guess : upper_bound(balance, left_at_zero), relief);
  for (int step = 0; step < kPressureSteps && !result.converged; ++step) {
    if (!may_step(balance.work)) {
      return result;
    }
    const Residual at = residual(balance, lambda, s);
    const double fall = at.left_m3ps / at.slope;
    result.converged =
        std::abs(fall) <= kNewtonLastStep * s || std::abs(at.left_m3ps) <= rounding_m3ps;
    const bool relieves = s >= relief && at.left_m3ps >= 0.0;
    // Only rounding puts s left of the root again.
    const bool rounded = step > 0 && !(fall >= 0.0);
    if (relieves || rounded) {
      result.converged = true;
    } else if (fall >= 0.0) {
      const bool far = step == 0 && fall > kPressureGuessFar * s;
      s = std::max(stretch_start(balance, lambda, s), s - fall);
      s = far ? std::min(s, upper_bound(balance, left_at_zero)) : s;
    } else {
      const double right = right_of_root(balance, lambda, s, s - fall);
      result.converged = result.converged && right < kInfinity;
      s = std::min(right < kInfinity ? right : upper_bound(balance, left_at_zero), relief);
    }
    ++result.iterations;
  }
  result.converged = result.converged && std::isfinite(s * s);
  result.sqrt_pressure = s;
  return result;
}

}  // namespace graben
