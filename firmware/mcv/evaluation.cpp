#include "firmware/mcv/evaluation.hpp"

#include <cmath>

#include "firmware/hydraulics/orifice.hpp"
#include "firmware/hydraulics/regeneration.hpp"
#include "firmware/mcv/pump_pressure.hpp"

namespace graben {
namespace {

/// Flows of one actuator at lambda, (33), (34) and (38), and what its direction selects.
struct Stroke {
  bool moves = false;
  double q_in_m3ps = 0.0;
  double q_out_m3ps = 0.0;
  double inlet_area_m2 = 0.0;
  double outlet_area_m2 = 0.0;
  double load_force_n = 0.0;  ///< F_L sgn(x) of (36).
  bool regeneration = false;  ///< The circuit is on the side that the spool moves to.
};

Stroke stroke_of(const McvActuator& actuator, double velocity_mps, double cap_pa, double rod_pa,
                 double lambda) {
  Stroke stroke;
  if (velocity_mps == 0.0) {
    return stroke;
  }
  const bool extends = velocity_mps > 0.0;
  const double speed_mps = lambda * std::abs(velocity_mps);
  const double load_n = actuator.area_cap_m2 * cap_pa - actuator.area_rod_m2 * rod_pa;
  stroke.moves = true;
  stroke.inlet_area_m2 = extends ? actuator.area_cap_m2 : actuator.area_rod_m2;
  stroke.outlet_area_m2 = extends ? actuator.area_rod_m2 : actuator.area_cap_m2;
  stroke.q_in_m3ps = stroke.inlet_area_m2 * speed_mps;
  stroke.q_out_m3ps = stroke.outlet_area_m2 * speed_mps;
  stroke.load_force_n = extends ? load_n : -load_n;
  stroke.regeneration =
      actuator.regeneration == (extends ? RegenerationSide::kExtend : RegenerationSide::kRetract);
  return stroke;
}

FlowBalance balance_of(const McvMachine& machine, const PerActuator<Stroke>& strokes, int pump,
                       double pump_flow_m3ps) {
  const McvPump& line = machine.pump[static_cast<unsigned>(pump)];
  FlowBalance balance;
  balance.flow_m3ps = pump_flow_m3ps;
  balance.leak_linear = line.leak_linear;
  balance.leak_quadratic = line.leak_quadratic;
  double bypass_resistance = line.series_resistance;
  for (int i = 0; i < machine.actuator_count; ++i) {
    const auto k = static_cast<unsigned>(i);
    const McvActuator& actuator = machine.actuator[k];
    if (actuator.pump != pump) {
      continue;
    }
    const Stroke& stroke = strokes[k];
    bypass_resistance +=
        orifice_resistance(stroke.moves ? actuator.bypass_closed : actuator.bypass_open);
    balance.in_flow_m3ps += stroke.q_in_m3ps;
    if (stroke.regeneration) {
      balance.in_flow_m3ps -= stroke.q_out_m3ps;
      balance.regeneration[static_cast<unsigned>(balance.regeneration_count++)] = {
          stroke.q_out_m3ps, actuator.c_drain, actuator.c_check};
    }
  }
  // A line with nothing in its bypass holds no pressure; only a pump without spools can be one.
  balance.bypass = bypass_resistance > 0.0 ? 1.0 / std::sqrt(bypass_resistance) : 0.0;
  return balance;
}

void fail(McvPoint& point, LimitKind kind, int index) {
  point.feasible = false;
  point.limit = {kind, static_cast<std::uint8_t>(index)};
}

/// (39): false where a pump can't feed its line.
bool solve_pumps(const McvMachine& machine, const McvInput& input,
                 const PerActuator<Stroke>& strokes, PerPump<double>& sqrt_pressure,
                 McvPoint& point) {
  for (int j = 0; j < machine.pump_count; ++j) {
    const auto k = static_cast<unsigned>(j);
    const McvPump& line = machine.pump[k];
    const PumpPressure solved = solve_pump_pressure(
        balance_of(machine, strokes, j, input.pump_flow_m3ps[k]), line.has_relief, line.relief_pa);
    point.newton_steps += solved.iterations;
    if (!solved.fed || !solved.converged) {
      point.converged = point.converged && !solved.fed;
      fail(point, LimitKind::kPumpFlow, j);
      return false;
    }
    sqrt_pressure[k] = solved.sqrt_pressure;
    point.pump_pressure_pa[k] = solved.sqrt_pressure * solved.sqrt_pressure;
  }
  return true;
}

/// (40), (41): false where a load would push back.
bool drive_forces(const McvMachine& machine, const PerActuator<Stroke>& strokes,
                  const PerPump<double>& sqrt_pressure, McvPoint& point) {
  for (int i = 0; i < machine.actuator_count; ++i) {
    const auto k = static_cast<unsigned>(i);
    const McvActuator& actuator = machine.actuator[k];
    const Stroke& stroke = strokes[k];
    if (!stroke.moves) {
      continue;
    }
    const auto pump = static_cast<unsigned>(actuator.pump);
    if (stroke.regeneration) {
      const ReturnGallery gallery = return_gallery(stroke.q_out_m3ps, sqrt_pressure[pump],
                                                   actuator.c_drain, actuator.c_check);
      point.out_pressure_pa[k] = gallery.sqrt_pressure * gallery.sqrt_pressure;
      point.regenerating[k] = gallery.regenerating;
    }
    point.drive_force_n[k] = stroke.inlet_area_m2 * point.pump_pressure_pa[pump] -
                             stroke.outlet_area_m2 * point.out_pressure_pa[k] - stroke.load_force_n;
    if (!(point.drive_force_n[k] >= actuator.force_offset_n)) {
      fail(point, LimitKind::kBackFlow, i);
      return false;
    }
  }
  return true;
}

/// (42), (13): false where a spool would have to open farther than it can.
bool spools(const McvMachine& machine, const McvInput& input, double lambda, McvPoint& point) {
  for (int i = 0; i < machine.actuator_count; ++i) {
    const auto k = static_cast<unsigned>(i);
    const double velocity = input.velocity_mps[k];
    if (velocity == 0.0) {
      continue;
    }
    const McvActuator& actuator = machine.actuator[k];
    const MonotoneTable& table = velocity > 0.0 ? actuator.extend : actuator.retract;
    const double coefficient = lambda * std::abs(velocity) / std::sqrt(point.drive_force_n[k]);
    if (!(coefficient <= table.y_last())) {
      fail(point, LimitKind::kSpoolTravel, i);
      return false;
    }
    point.spool_m[k] = std::copysign(table.inverse(coefficient), velocity);
  }
  return true;
}

}  // namespace

McvPoint evaluate(const McvMachine& machine, const McvInput& input, double lambda) {
  McvPoint point;
  point.lambda = lambda;
  point.feasible = true;
  PerActuator<Stroke> strokes;
  for (unsigned k = 0; k < static_cast<unsigned>(machine.actuator_count); ++k) {
    strokes[k] = stroke_of(machine.actuator[k], input.velocity_mps[k], input.cap_pressure_pa[k],
                           input.rod_pressure_pa[k], lambda);
  }
  PerPump<double> sqrt_pressure{};
  if (solve_pumps(machine, input, strokes, sqrt_pressure, point) &&
      drive_forces(machine, strokes, sqrt_pressure, point)) {
    // The last check; its failure is in the point.
    static_cast<void>(spools(machine, input, lambda, point));
  }
  return point;
}

}  // namespace graben
