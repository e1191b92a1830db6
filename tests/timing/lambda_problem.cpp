#include "tests/timing/lambda_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/hydraulics/regeneration.hpp"

namespace graben::timing {
namespace {

/// phi of (18), sqrt(P_out), over lambda and s = sqrt(P). It is homogeneous of degree 1, so that
/// Euler's theorem gives every derivative by lambda from those by s.
struct Gallery {
  double phi = 0.0;
  double by_s = 0.0;
  double by_lambda = 0.0;
  double by_s_s = 0.0;
};

Gallery gallery_at(double lambda, double q_out_m3ps, double c_drain, double c_check, double s) {
  const double q = lambda * q_out_m3ps;
  if (!(s < q / c_drain)) {
    return {q / c_drain, 0.0, q_out_m3ps / c_drain, 0.0};
  }
  const GalleryPressure at = gallery_pressure(q, s, c_drain, c_check, true);
  const double root = std::sqrt(q * q + (c_check - c_drain) * (c_check + c_drain) * s * s);
  return {at.sqrt_pressure, at.slope, (at.sqrt_pressure - s * at.slope) / lambda,
          c_check * q * q / (root * root * root)};
}

/// Adds factor * (second derivatives of phi); those by lambda follow from Euler as well.
void add_phi(Curvature& sum, const Gallery& gallery, double lambda, double s, double factor) {
  const double ratio = lambda > 0.0 ? s / lambda : 0.0;
  sum.by_u_u += factor * gallery.by_s_s;
  sum.by_lambda_u -= factor * ratio * gallery.by_s_s;
  sum.by_lambda_lambda += factor * ratio * ratio * gallery.by_s_s;
}

/// By s so far: to u, and to the constraint's scale.
Curvature scaled(const Curvature& by_s, double s_per_u, double scale) {
  return {scale * by_s.by_lambda_lambda, scale * s_per_u * by_s.by_lambda_u,
          scale * s_per_u * s_per_u * by_s.by_u_u};
}

}  // namespace

LambdaProblem::LambdaProblem(const McvMachine& machine, const McvInput& input)
    : circuit_(make_circuit(machine, input)) {
  PerPump<unsigned> column{};
  PerPump<bool> used{};
  for (unsigned i = 0; i < circuit_.axis_count; ++i) {
    const CircuitAxis& axis = circuit_.axis[i];
    if (!axis.moves) {
      continue;
    }
    if (!used[axis.pump]) {
      const FlowBalance& line = circuit_.line[axis.pump];
      const double asked_m3ps = line.flow_m3ps - flow_left(line, 1.0, 0.0);
      if (asked_m3ps > line.flow_m3ps) {
        highest_lambda_ = std::min(highest_lambda_, line.flow_m3ps / asked_m3ps);
      }
      const double s = solve_pump_pressure(line, 0.0).sqrt_pressure;
      used[axis.pump] = true;
      column[axis.pump] = line_count_;
      line_[line_count_] = axis.pump;
      s_standstill_[line_count_] = s > 0.0 ? s : 1.0;
      flow_scale_[line_count_] = line.flow_m3ps > 0.0 ? 1.0 / line.flow_m3ps : 1.0;
      ++line_count_;
    }
    const double s = s_standstill_[column[axis.pump]];
    axis_[axis_count_] = i;
    axis_line_[axis_count_] = column[axis.pump];
    force_scale_[axis_count_] =
        1.0 / (axis.inlet_area_m2 * s * s + std::abs(axis.load_force_n) + axis.force_offset_n);
    ++axis_count_;
  }
}

double LambdaProblem::solved_u(unsigned line, double lambda) const {
  return solve_pump_pressure(balance_of(line), lambda).sqrt_pressure / s_standstill_[line];
}

Slope LambdaProblem::balance(unsigned line, double lambda, double u) const {
  const FlowBalance& at = balance_of(line);
  const double s = u * s_standstill_[line];
  const double leak = s * (at.leak_linear + at.leak_quadratic * s * s);
  double left = at.flow_m3ps - lambda * at.in_flow_m3ps - s * (at.bypass + leak);
  double by_s = -2.0 * leak - 2.0 * at.leak_quadratic * s * s * s - at.bypass;
  double by_lambda = -at.in_flow_m3ps;
  for (unsigned i = 0; i < static_cast<unsigned>(at.regeneration_count); ++i) {
    const RegenerationDemand& demand = at.regeneration[i];
    const Gallery gallery =
        gallery_at(lambda, demand.q_out_m3ps, demand.c_drain, demand.c_check, s);
    left -= demand.c_drain * gallery.phi;
    by_s -= demand.c_drain * gallery.by_s;
    by_lambda -= demand.c_drain * gallery.by_lambda;
  }
  const double scale = flow_scale_[line];
  const Slope flow{scale * left, scale * by_lambda, scale * by_s * s_standstill_[line]};
  if (at.has_relief) {
    const double below_relief = at.sqrt_relief / s_standstill_[line] - u;
    if (below_relief < flow.value) {
      return {below_relief, 0.0, -1.0};
    }
  }
  return flow;
}

Curvature LambdaProblem::balance_curvature(unsigned line, double lambda, double u) const {
  const FlowBalance& at = balance_of(line);
  const double s = u * s_standstill_[line];
  if (at.has_relief &&
      at.sqrt_relief / s_standstill_[line] - u < flow_scale_[line] * flow_left(at, lambda, s)) {
    return {};
  }
  Curvature by_s;
  by_s.by_u_u = -2.0 * at.leak_linear - 12.0 * at.leak_quadratic * s * s;
  for (unsigned i = 0; i < static_cast<unsigned>(at.regeneration_count); ++i) {
    const RegenerationDemand& demand = at.regeneration[i];
    const Gallery gallery =
        gallery_at(lambda, demand.q_out_m3ps, demand.c_drain, demand.c_check, s);
    add_phi(by_s, gallery, lambda, s, -demand.c_drain);
  }
  return scaled(by_s, s_standstill_[line], flow_scale_[line]);
}

AxisMargins LambdaProblem::margins(unsigned axis, double lambda, double u) const {
  const CircuitAxis& at = axis_of(axis);
  const double s_per_u = s_standstill_[axis_line_[axis]];
  const double s = u * s_per_u;
  double force_n = at.inlet_area_m2 * s * s - at.load_force_n;
  double by_s = 2.0 * at.inlet_area_m2 * s;
  double by_lambda = 0.0;
  if (at.regeneration) {
    const Gallery gallery = gallery_at(lambda, at.q_out_m3ps, at.c_drain, at.c_check, s);
    const double per_phi = 2.0 * at.outlet_area_m2 * gallery.phi;
    force_n -= 0.5 * per_phi * gallery.phi;
    by_s -= per_phi * gallery.by_s;
    by_lambda -= per_phi * gallery.by_lambda;
  }
  const double scale = force_scale_[axis];
  const double full_n = lambda * at.full_opening_force_n;
  const double by_u = scale * by_s * s_per_u;
  return {{scale * (force_n - at.force_offset_n), scale * by_lambda, by_u},
          {scale * (force_n - lambda * full_n), scale * (by_lambda - 2.0 * full_n), by_u}};
}

Curvature LambdaProblem::margins_curvature(unsigned axis, double lambda, double u, double w_force,
                                           double w_travel) const {
  const CircuitAxis& at = axis_of(axis);
  const double s_per_u = s_standstill_[axis_line_[axis]];
  const double s = u * s_per_u;
  const double both = w_force + w_travel;
  Curvature by_s;
  by_s.by_u_u = both * 2.0 * at.inlet_area_m2;
  if (at.regeneration) {
    const Gallery gallery = gallery_at(lambda, at.q_out_m3ps, at.c_drain, at.c_check, s);
    const double factor = -2.0 * both * at.outlet_area_m2;
    by_s.by_lambda_lambda += factor * gallery.by_lambda * gallery.by_lambda;
    by_s.by_lambda_u += factor * gallery.by_lambda * gallery.by_s;
    by_s.by_u_u += factor * gallery.by_s * gallery.by_s;
    add_phi(by_s, gallery, lambda, s, factor * gallery.phi);
  }
  by_s.by_lambda_lambda -= 2.0 * w_travel * at.full_opening_force_n;
  return scaled(by_s, s_per_u, force_scale_[axis]);
}

void LambdaProblem::solved_margins(double lambda, double* margins) const {
  PerPump<double> s{};
  for (unsigned j = 0; j < line_count_; ++j) {
    s[j] = solve_pump_pressure(balance_of(j), lambda).sqrt_pressure;
  }
  for (unsigned i = 0; i < axis_count_; ++i) {
    const CircuitAxis& at = axis_of(i);
    const double force_n = drive_force(at, lambda, s[axis_line_[i]]).force_n;
    margins[2 * i] = force_scale_[i] * (force_n - at.force_offset_n);
    margins[2 * i + 1] = force_scale_[i] * (force_n - lambda * lambda * at.full_opening_force_n);
  }
}

double LambdaProblem::smallest_margin(double lambda) const {
  std::array<double, 2 * kMaxActuators> margins{};
  solved_margins(lambda, margins.data());
  double smallest = std::numeric_limits<double>::infinity();
  for (unsigned i = 0; i < 2 * axis_count_; ++i) {
    smallest = std::min(smallest, margins[i]);
  }
  return smallest;
}

}  // namespace graben::timing
