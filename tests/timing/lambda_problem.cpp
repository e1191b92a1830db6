// SPDX-License-Identifier: Apache-2.0
#include "tests/timing/lambda_problem.hpp"
#include "tests/fuzz/endless_work.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/pressure_ratio.hpp"

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

Gallery gallery_of(const CircuitAxis& axis, double lambda, double s) {
  return axis.regeneration ? gallery_at(lambda, axis.q_out_m3ps, axis.c_drain, axis.c_check, s)
                           : Gallery{};
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

/// What drives an axis and what resists it, by lambda and s (not u):
///   |(sqrt(A_in) s, sqrt(-L))| and |(sqrt(A_out) phi, sqrt(L), lambda sqrt(full))|
struct Lengths {
  Slope drive;
  Slope resist;
};

Lengths lengths(const CircuitAxis& axis, const Gallery& gallery, double lambda, double s,
                double load_n, double full_n) {
  const double area_s = axis.inlet_area_m2 * s;
  const double area_phi = axis.outlet_area_m2 * gallery.phi;
  const double drive = std::sqrt(area_s * s + std::max(-load_n, 0.0));
  const double resist =
      std::sqrt(area_phi * gallery.phi + std::max(load_n, 0.0) + lambda * lambda * full_n);
  const double per_resist = resist > 0.0 ? 1.0 / resist : 0.0;
  return {{drive, 0.0, drive > 0.0 ? area_s / drive : std::sqrt(axis.inlet_area_m2)},
          {resist, (area_phi * gallery.by_lambda + lambda * full_n) * per_resist,
           area_phi * gallery.by_s * per_resist}};
}

/// Adds weight * (second derivatives of drive - resist): of a length r, r r'' = (r^2)'' / 2 - r'^2.
void add_lengths(Curvature& sum, const CircuitAxis& axis, const Gallery& gallery, const Lengths& at,
                 double lambda, double s, double full_n, double weight) {
  if (at.drive.value > 0.0) {
    sum.by_u_u += weight * (axis.inlet_area_m2 - at.drive.by_u * at.drive.by_u) / at.drive.value;
  }
  if (at.resist.value > 0.0) {
    const double share = -weight / at.resist.value;
    const double area = axis.outlet_area_m2;
    sum.by_lambda_lambda += share * (area * gallery.by_lambda * gallery.by_lambda + full_n -
                                     at.resist.by_lambda * at.resist.by_lambda);
    sum.by_lambda_u +=
        share * (area * gallery.by_lambda * gallery.by_s - at.resist.by_lambda * at.resist.by_u);
    sum.by_u_u += share * (area * gallery.by_s * gallery.by_s - at.resist.by_u * at.resist.by_u);
    add_phi(sum, gallery, lambda, s, share * area * gallery.phi);
  }
}

}  // namespace

LambdaProblem::LambdaProblem(const McvMachine& machine, const McvInput& input)
    : circuit_(make_circuit(machine, input, test::endless_work())) {
  PerPump<unsigned> column{};
  PerPump<bool> used{};
  for (unsigned i = 0; i < circuit_.axis_count; ++i) {
    const CircuitAxis& axis = circuit_.axis[i];
    if (!axis.moves) {
      continue;
    }
    if (!used[axis.pump]) {
      const FlowBalance& line = circuit_.line[axis.pump];
      highest_lambda_ = std::min(highest_lambda_, fed_lambda(line));
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
    length_scale_[axis_count_] = 1.0 / std::sqrt(axis.inlet_area_m2 * s * s +
                                                 std::abs(axis.load_force_n) + axis.force_offset_n);
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
  const CircuitAxis& of = axis_of(axis);
  const double s_per_u = s_standstill_[axis_line_[axis]];
  const double s = u * s_per_u;
  const Gallery gallery = gallery_of(of, lambda, s);
  const auto margin = [&](const Lengths& at) {
    const double scale = length_scale_[axis];
    return Slope{scale * (at.drive.value - at.resist.value), -scale * at.resist.by_lambda,
                 scale * s_per_u * (at.drive.by_u - at.resist.by_u)};
  };
  return {margin(lengths(of, gallery, lambda, s, of.load_force_n + of.force_offset_n, 0.0)),
          margin(lengths(of, gallery, lambda, s, of.load_force_n, of.full_opening_force_n))};
}

Curvature LambdaProblem::margins_curvature(unsigned axis, double lambda, double u, double w_force,
                                           double w_travel) const {
  const CircuitAxis& of = axis_of(axis);
  const double s_per_u = s_standstill_[axis_line_[axis]];
  const double s = u * s_per_u;
  const Gallery gallery = gallery_of(of, lambda, s);
  Curvature sum;
  const auto add = [&](double load_n, double full_n, double weight) {
    add_lengths(sum, of, gallery, lengths(of, gallery, lambda, s, load_n, full_n), lambda, s,
                full_n, weight);
  };
  add(of.load_force_n + of.force_offset_n, 0.0, w_force);
  add(of.load_force_n, of.full_opening_force_n, w_travel);
  return scaled(sum, s_per_u, length_scale_[axis]);
}

double LambdaProblem::smallest_margin_at(double lambda, const PerPump<double>& s,
                                         MarginForm form) const {
  double smallest = std::numeric_limits<double>::infinity();
  for (unsigned i = 0; i < axis_count_; ++i) {
    const CircuitAxis& of = axis_of(i);
    const double drives_n = of.inlet_area_m2 * s[axis_line_[i]] * s[axis_line_[i]];
    double resists_n = 0.0;
    if (of.regeneration) {
      const double phi =
          return_gallery(lambda * of.q_out_m3ps, s[axis_line_[i]], of.c_drain, of.c_check)
              .sqrt_pressure;
      resists_n = of.outlet_area_m2 * phi * phi;
    }
    const auto margin = [&](double load_n, double full_n) {
      if (form == MarginForm::kForce) {
        return length_scale_[i] * length_scale_[i] * (drives_n - resists_n - load_n - full_n);
      }
      return length_scale_[i] * (std::sqrt(drives_n + std::max(-load_n, 0.0)) -
                                 std::sqrt(resists_n + std::max(load_n, 0.0) + full_n));
    };
    smallest = std::min({smallest, margin(of.load_force_n + of.force_offset_n, 0.0),
                         margin(of.load_force_n, lambda * lambda * of.full_opening_force_n)});
  }
  return smallest;
}

double LambdaProblem::smallest_margin(double lambda, Near& near, MarginForm form) const {
  for (unsigned j = 0; j < line_count_; ++j) {
    // s / lambda changes less than s.
    const double guess = near.lambda > 0.0 && lambda > 0.0
                             ? lambda / near.lambda * near.sqrt_pressure[j]
                             : std::numeric_limits<double>::infinity();
    near.sqrt_pressure[j] = solve_pump_pressure(balance_of(j), lambda, guess).sqrt_pressure;
  }
  near.lambda = lambda;
  return smallest_margin_at(lambda, near.sqrt_pressure, form);
}

bool LambdaProblem::can_start() const {
  return highest_lambda_ > 0.0 && smallest_margin_at(0.0, s_standstill_, MarginForm::kLength) > 0.0;
}

}  // namespace graben::timing
