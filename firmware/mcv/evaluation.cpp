#include "firmware/mcv/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/hydraulics/regeneration.hpp"

namespace graben {
namespace {

void fail(McvPoint& point, LimitKind kind, unsigned index) {
  point.feasible = false;
  point.limit = {kind, static_cast<std::uint8_t>(index)};
}

/// (39): false where a pump can't feed its line.
bool solve_pumps(const McvCircuit& circuit, const McvPoint* near, McvPoint& point) {
  for (unsigned j = 0; j < circuit.pump_count; ++j) {
    // s / lambda changes less than s.
    const PumpPressure solved =
        near == nullptr ? solve_pump_pressure(circuit.line[j], point.lambda)
                        : solve_pump_pressure(circuit.line[j], point.lambda,
                                              point.lambda / near->lambda * near->sqrt_pressure[j]);
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

/// (40), (41): false where a load would push back.
bool drive_forces(const McvCircuit& circuit, McvPoint& point) {
  double most_lacking = 0.0;
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    if (!axis.moves) {
      continue;
    }
    const DriveForce drive = drive_force(axis, point.lambda, point.sqrt_pressure[axis.pump]);
    point.out_pressure_pa[i] = drive.out_pressure_pa;
    point.regenerating[i] = drive.regenerating;
    point.drive_force_n[i] = drive.force_n;
    const double full_n = point.lambda * point.lambda * axis.full_opening_force_n;
    const double lacks_n = std::max(full_n, axis.force_offset_n) - drive.force_n;
    const double lacking = lacks_n / (axis.inlet_area_m2 * point.pump_pressure_pa[axis.pump]);
    if (lacking > most_lacking) {
      most_lacking = lacking;
      point.hardest_axis = static_cast<int>(i);
    }
    if (point.feasible && !(drive.force_n >= axis.force_offset_n)) {
      fail(point, LimitKind::kBackFlow, i);
    }
  }
  return point.feasible;
}

/// (42), (13): false where a spool would have to open farther than it can.
bool spools(const McvCircuit& circuit, McvPoint& point) {
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    if (!axis.moves) {
      continue;
    }
    const double coefficient = needed_coefficient(axis, point.lambda, point.drive_force_n[i]);
    if (!(coefficient <= axis.spool->y_last())) {
      fail(point, LimitKind::kSpoolTravel, i);
      return false;
    }
    const double travel_m = axis.spool->inverse(coefficient);
    point.spool_m[i] = axis.extends ? travel_m : -travel_m;
  }
  return true;
}

}  // namespace

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
  if (solve_pumps(circuit, near, point) && drive_forces(circuit, point)) {
    // The last check; its failure is in the point.
    static_cast<void>(spools(circuit, point));
  }
  const bool axis_fails = !point.feasible && point.limit.kind != LimitKind::kPumpFlow;
  if (axis_fails && point.hardest_axis < 0) {
    point.hardest_axis = point.limit.index;
  }
  return point;
}

}  // namespace graben
