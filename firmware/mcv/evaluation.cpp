// SPDX-License-Identifier: Apache-2.0
#include "firmware/mcv/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/regulated.hpp"

namespace graben {
namespace {

void fail(McvPoint& point, LimitKind kind, unsigned index) {
  point.feasible = false;
  point.limit = {kind, static_cast<std::uint8_t>(index)};
}

PumpPressure solve_line(const McvCircuit& circuit, unsigned pump, double lambda,
                        const McvPoint* near) {
  // What a point has not solved for is 0 and says nothing.
  if (near == nullptr || !(near->sqrt_pressure[pump] > 0.0)) {
    return line_pressure(circuit, pump, lambda);
  }
  // s / lambda changes less than s.
  return line_pressure(circuit, pump, lambda, lambda / near->lambda * near->sqrt_pressure[pump]);
}

/// (39): false where a pump can't feed its line.
bool solve_pumps(const McvCircuit& circuit, const McvPoint* near, McvPoint& point) {
  for (unsigned j = 0; j < circuit.pump_count; ++j) {
    const PumpPressure solved = solve_line(circuit, j, point.lambda, near);
    point.newton_steps += solved.iterations;
    point.feed_margin_m3ps[j] = feed_margin_m3ps(circuit.line[j], point.lambda);
    if (!solved.fed || !solved.converged) {
      point.converged = point.converged && !solved.fed;
      fail(point, LimitKind::kPumpFlow, j);
      return false;
    }
    point.sqrt_pressure[j] = solved.sqrt_pressure;
    point.pump_pressure_pa[j] = solved.sqrt_pressure * solved.sqrt_pressure;
  }
  return true;
}

}  // namespace

double needed_force_n(const CircuitAxis& axis, double lambda) {
  return std::max(lambda * lambda * axis.full_opening_force_n, axis.force_offset_n);
}

DriveForce drive_force(const CircuitAxis& axis, double lambda, double sqrt_pressure) {
  DriveForce drive;
  drive.force_n = axis.inlet_area_m2 * (sqrt_pressure * sqrt_pressure);
  if (axis.regeneration) {
    const ReturnGallery gallery =
        return_gallery(lambda * axis.q_out_m3ps, sqrt_pressure, axis.c_drain, axis.c_check);
    drive.out_pressure_pa = gallery.sqrt_pressure * gallery.sqrt_pressure;
    drive.regenerating = gallery.regenerating;
    drive.force_n -= axis.outlet_area_m2 * drive.out_pressure_pa;
  }
  drive.force_n -= axis.load_force_n;
  return drive;
}

double needed_coefficient(const CircuitAxis& axis, double lambda, double force_n) {
  const double left_n = force_n - lambda * lambda * axis.inflow_check_force_n;
  return left_n > 0.0 ? lambda * axis.speed_mps / std::sqrt(left_n)
                      : std::numeric_limits<double>::infinity();
}

McvPoint evaluate(const McvCircuit& circuit, double lambda, const McvPoint* near) {
  McvPoint point;
  point.lambda = lambda;
  point.feasible = true;
  if (solve_pumps(circuit, near, point)) {
    reload(circuit, point);
  }
  return point;
}

void reload(const McvCircuit& circuit, McvPoint& point) {
  point.feasible = true;
  point.limit = {};
  point.hardest_axis = -1;
  double most_lacking = 0.0;
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    if (!axis.moves) {
      continue;
    }
    const DriveForce drive = drive_force(axis, point.lambda, point.sqrt_pressure[axis.pump]);
    point.out_pressure_pa[i] = drive.out_pressure_pa;
    point.regenerating[i] = drive.regenerating;
    point.drive_force_n[i] = std::min(drive.force_n, axis.most_force_n);
    const double lacks_n = needed_force_n(axis, point.lambda) - point.drive_force_n[i];
    if (lacks_n <= 0.0) {
      continue;
    }
    const double lacking = lacks_n / (axis.inlet_area_m2 * point.pump_pressure_pa[axis.pump]);
    if (lacking > most_lacking || point.feasible) {
      most_lacking = lacking;
      point.hardest_axis = static_cast<int>(i);
    }
    // Back flow of any axis comes before travel of any.
    const bool back_flow = !(point.drive_force_n[i] >= axis.force_offset_n);
    if (point.feasible || (back_flow && point.limit.kind == LimitKind::kSpoolTravel)) {
      fail(point, back_flow ? LimitKind::kBackFlow : LimitKind::kSpoolTravel, i);
    }
  }
}

void open_spools(const McvCircuit& circuit, McvPoint& point) {
  if (circuit.regulated) {
    settle_bypasses(circuit, point);
  }
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    if (axis.moves) {
      const double coefficient =
          circuit.regulated
              ? regulated_coefficient(axis, point.lambda,
                                      {point.drive_force_n[i], point.out_pressure_pa[i], false})
              : needed_coefficient(axis, point.lambda, point.drive_force_n[i]);
      const double travel_m = axis.spool->inverse(coefficient);
      point.spool_m[i] = axis.extends ? travel_m : -travel_m;
    }
  }
}

bool still_fails(const McvCircuit& circuit, const McvPoint& fails, double lambda, McvPoint& near) {
  if (fails.hardest_axis < 0) {
    return feed_margin_m3ps(circuit.line[fails.limit.index], lambda) < 0.0;
  }
  const CircuitAxis& axis = circuit.axis[static_cast<unsigned>(fails.hardest_axis)];
  const PumpPressure solved = solve_line(circuit, axis.pump, lambda, &near);
  if (!solved.fed || !solved.converged) {
    return !solved.fed;
  }
  near.sqrt_pressure[axis.pump] = solved.sqrt_pressure * (near.lambda / lambda);
  const double force_n = drive_force(axis, lambda, solved.sqrt_pressure).force_n;
  return std::min(force_n, axis.most_force_n) < needed_force_n(axis, lambda);
}

}  // namespace graben
