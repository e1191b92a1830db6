// SPDX-License-Identifier: Apache-2.0
#include "firmware/mcv/regulated.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/hydraulics/flow.hpp"

namespace graben {
namespace {

/// Halvings of sqrt(P). [-; size: they leave less than a millionth of what it can be]
constexpr int kHalvings = 24;

/// Of a drive's margin, what rounding leaves of it at the pressure that it was solved for. [-;
/// derived: roots of sums of like size]
constexpr double kHeldShare = 1.0 - 1e-9;
/// Times that the drives of a line are asked in turn. [-; size: each has one gap, which another can
/// raise it into; the last pass but one finds no other]
constexpr int kGapPasses = 4;

double square(double value) { return value * value; }

/// p_N over the line's pressure.
double felt_share(const FlowBalance& line) {
  return square(line.bypass / line.regulated->tank_orifice);
}

double swash_of(const PumpRegulator& by, double felt_pa) {
  const double gone = (felt_pa - by.full_swash_pa) / (by.least_swash_pa - by.full_swash_pa);
  return 1.0 - (1.0 - by.least_swash_ratio) * std::clamp(gone, 0.0, 1.0);
}

/// Of the three flows the falling one first: where its pressure lies in its range, that is the
/// line's; under that the flow is full, and over it the least.
PumpPressure by_bypass(const FlowBalance& line, double lambda, double guess) {
  const PumpRegulator& by = line.regulated->regulator;
  if (!(feed_margin_m3ps(line, lambda) >= 0.0)) {
    return {};
  }
  const double felt = felt_share(line);
  const double fall_m3pspa =
      line.flow_m3ps * (1.0 - by.least_swash_ratio) / (by.least_swash_pa - by.full_swash_pa);
  FlowBalance other = line;
  other.flow_m3ps += fall_m3pspa * by.full_swash_pa;
  other.leak_linear += fall_m3pspa * felt;
  PumpPressure falling = solve_pump_pressure(other, lambda, guess);
  const double felt_pa = square(falling.sqrt_pressure) * felt;
  if (!falling.converged || (felt_pa >= by.full_swash_pa && felt_pa <= by.least_swash_pa)) {
    return falling;
  }
  other = line;
  if (felt_pa > by.least_swash_pa) {
    other.flow_m3ps *= by.least_swash_ratio;
  }
  const PumpPressure even = solve_pump_pressure(other, lambda, falling.sqrt_pressure);
  falling.iterations += even.iterations;
  falling.converged = even.converged || !even.fed;
  falling.sqrt_pressure = even.fed ? even.sqrt_pressure : falling.sqrt_pressure;
  return falling;
}

/// Where the axis has its margin's force while its check valve is open, the gallery gives way:
/// s^2 = (F + A_out g^2) / A_in in (q - c_d g)^2 = c_c^2 (g^2 - s^2), (18), at the smaller g.
double regenerating_sqrt_pressure(const CircuitAxis& axis, double lambda) {
  const double needed_n = axis.margin_force_n + axis.load_force_n;
  const double out_m3ps = lambda * axis.q_out_m3ps;
  const double check = square(axis.c_check);
  const double of_square =
      square(axis.c_drain) - check * (1.0 - axis.outlet_area_m2 / axis.inlet_area_m2);
  const double of_half = out_m3ps * axis.c_drain;
  const double without = square(out_m3ps) + check * needed_n / axis.inlet_area_m2;
  const double root = std::sqrt(std::max(0.0, square(of_half) - of_square * without));
  const double held_n = needed_n + axis.outlet_area_m2 * square(without / (of_half + root));
  return std::sqrt(std::max(0.0, held_n / axis.inlet_area_m2));
}

/// Least sqrt(P) from `from` up at which the axis has its margin's force. Where more oil comes out
/// than goes in, a higher line holds the gallery up, and the force has a gap below what shuts its
/// check valve.
double held_sqrt_pressure(const CircuitAxis& axis, double lambda, double from) {
  if (drive_force(axis, lambda, from).force_n >= axis.margin_force_n) {
    return from;
  }
  const double shut = axis.regeneration ? lambda * axis.opening : 0.0;
  if (from < shut) {
    const double open = regenerating_sqrt_pressure(axis, lambda);
    if (open > from && open < shut &&
        drive_force(axis, lambda, open).force_n >= kHeldShare * axis.margin_force_n) {
      return open;
    }
  }
  const double drained_n = axis.regeneration ? axis.outlet_area_m2 * square(shut) : 0.0;
  const double needed_n = axis.margin_force_n + axis.load_force_n + drained_n;
  return std::max({from, shut, std::sqrt(std::max(0.0, needed_n / axis.inlet_area_m2))});
}

/// `wanted` goes up to the least sqrt(P) at which all drives of the line have their margins: what
/// one asks for can be in another's gap. A step for each time that they are asked; false where they
/// have come to an end.
bool raise_to_margins(const McvCircuit& circuit, unsigned pump, double lambda, double& wanted) {
  for (int pass = 0; pass < kGapPasses; ++pass) {
    if (!may_step(circuit.line[pump].work)) {
      return false;
    }
    const double before = wanted;
    for (unsigned i = 0; i < circuit.axis_count; ++i) {
      const CircuitAxis& axis = circuit.axis[i];
      if (axis.moves && axis.pump == pump) {
        wanted = held_sqrt_pressure(axis, lambda, wanted);
      }
    }
    if (wanted <= before) {
      return true;
    }
  }
  return true;
}

PumpPressure by_load(const McvCircuit& circuit, unsigned pump, double lambda, double guess) {
  const FlowBalance& line = circuit.line[pump];
  if (!(feed_margin_m3ps(line, lambda) >= 0.0) || !(line.bypass > 0.0)) {
    return solve_pump_pressure(line, lambda);
  }
  PumpPressure found{true, true, std::sqrt(line.regulated->regulator.margin_pa), 0};
  double& wanted = found.sqrt_pressure;
  found.converged = raise_to_margins(circuit, pump, lambda, wanted);
  if (line.regeneration_count > 0 && found.converged) {
    // What comes back may be more than goes out: no pump takes it away.
    FlowBalance idle = line;
    idle.flow_m3ps = 0.0;
    if (feed_margin_m3ps(idle, lambda) >= 0.0 && flow_left(idle, lambda, wanted) > 0.0) {
      found = solve_pump_pressure(idle, lambda, guess);
      found.converged = found.converged && raise_to_margins(circuit, pump, lambda, wanted);
    }
  }
  wanted = line.has_relief ? std::min(wanted, line.sqrt_relief) : wanted;
  return !found.converged || flow_left(line, lambda, wanted) >= 0.0
             ? found
             : solve_pump_pressure(line, lambda, wanted);
}

/// c_v,by of (20) at an opening, where it closes over some of it.
double bypass_at(const McvActuator& actuator, bool extends, double opening) {
  if (!actuator.bypass_closes_at.is_gradual()) {
    return actuator.bypass_closed;
  }
  const double closed = std::min(1.0, opening / actuator.bypass_closes_at.side(extends));
  return actuator.bypass_open + closed * (actuator.bypass_closed - actuator.bypass_open);
}

/// Balance of a line at a pressure with the bypass and the swash that belong to it.
double left_with_bypass(const McvCircuit& circuit, unsigned pump, double lambda, double sqrt_pa,
                        FlowBalance& line) {
  const McvPump& from = *line.regulated;
  double resistance = from.series_resistance;
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    const McvActuator& actuator = circuit.machine->actuator[i];
    if (static_cast<unsigned>(actuator.pump) != pump) {
      continue;
    }
    const CircuitAxis& axis = circuit.axis[i];
    double bypass = actuator.bypass_open;
    if (axis.moves) {
      const double coefficient =
          regulated_coefficient(axis, lambda, drive_force(axis, lambda, sqrt_pa));
      bypass = bypass_at(actuator, axis.extends,
                         axis.spool->inverse(coefficient) / axis.spool->x_last());
    }
    resistance += orifice_resistance(bypass);
  }
  line.bypass = 1.0 / std::sqrt(resistance);
  line.flow_m3ps =
      circuit.line[pump].flow_m3ps * swash_of(from.regulator, square(sqrt_pa) * felt_share(line));
  return flow_left(line, lambda, sqrt_pa);
}

/// A drive that has not its force is no sign of a spool less open than full.
bool is_below(const McvCircuit& circuit, unsigned pump, double lambda, double sqrt_pa,
              FlowBalance& line) {
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    if (axis.moves && axis.pump == pump &&
        drive_force(axis, lambda, sqrt_pa).force_n < needed_force_n(axis, lambda)) {
      return true;
    }
  }
  return left_with_bypass(circuit, pump, lambda, sqrt_pa, line) >= 0.0;
}

/// `line` becomes what it is at that pressure.
double settled_sqrt_pressure(const McvCircuit& circuit, unsigned pump, double lambda, double closed,
                             FlowBalance& line) {
  line = circuit.line[pump];
  if (left_with_bypass(circuit, pump, lambda, closed, line) >= 0.0) {
    return closed;
  }
  double low = 0.0;
  double high = closed;
  for (int n = 0; n < kHalvings && may_step(line.work); ++n) {
    const double middle = 0.5 * (low + high);
    (is_below(circuit, pump, lambda, middle, line) ? low : high) = middle;
  }
  return high;
}

/// -dQ/dP of pump and bypass, m^3/(s Pa).
double line_yield(const FlowBalance& line, double sqrt_pa) {
  const PumpRegulator& by = line.regulated->regulator;
  const double pressure_pa = square(sqrt_pa);
  const double felt_pa = pressure_pa * felt_share(line);
  const bool falls = felt_pa > by.full_swash_pa && felt_pa < by.least_swash_pa;
  const double full_m3ps = line.flow_m3ps / swash_of(by, felt_pa);
  const double of_swash = falls ? full_m3ps * (1.0 - by.least_swash_ratio) /
                                      (by.least_swash_pa - by.full_swash_pa) * felt_share(line)
                                : 0.0;
  return of_swash + line.leak_linear + 2.0 * line.leak_quadratic * pressure_pa +
         0.5 * line.bypass / sqrt_pa;
}

/// Of a drive at its force, on a line with that.
double drive_yield_mpsn(const CircuitAxis& axis, double lambda, double force_n,
                        double line_m3pspa) {
  const double edges_mpsn = 0.5 * lambda * axis.speed_mps / std::max(force_n, axis.force_offset_n);
  return edges_mpsn * line_m3pspa / (line_m3pspa + square(axis.inlet_area_m2) * edges_mpsn);
}

}  // namespace

PumpPressure most_pressure(const FlowBalance& line, double lambda) {
  const bool falls =
      line.regulated != nullptr && line.regulated->regulator.kind == PumpKind::kNegativeFlow;
  return falls ? by_bypass(line, lambda, kInfinity) : solve_pump_pressure(line, lambda);
}

PumpPressure line_pressure(const McvCircuit& circuit, unsigned pump, double lambda, double guess) {
  const FlowBalance& line = circuit.line[pump];
  if (line.regulated == nullptr) {
    return solve_pump_pressure(line, lambda, guess);
  }
  return line.regulated->regulator.kind == PumpKind::kLoadSensing
             ? by_load(circuit, pump, lambda, guess)
             : by_bypass(line, lambda, guess);
}

double regulated_coefficient(const CircuitAxis& axis, double lambda, const DriveForce& drive) {
  const double fed = needed_coefficient(axis, lambda, std::min(drive.force_n, axis.most_force_n));
  const double drains_n = -axis.load_force_n - axis.outlet_area_m2 * drive.out_pressure_pa;
  return drains_n > 0.0
             ? std::min(fed, lambda * axis.speed_mps * std::sqrt(axis.outlet_share / drains_n))
             : fed;
}

void settle_bypasses(const McvCircuit& circuit, McvPoint& point) {
  PerPump<double> yield_m3pspa{};
  for (unsigned j = 0; j < circuit.pump_count; ++j) {
    const McvPump* pump = circuit.line[j].regulated;
    if (pump != nullptr && pump->regulator.kind == PumpKind::kNegativeFlow) {
      FlowBalance line;
      point.sqrt_pressure[j] =
          settled_sqrt_pressure(circuit, j, point.lambda, point.sqrt_pressure[j], line);
      point.pump_pressure_pa[j] = square(point.sqrt_pressure[j]);
      yield_m3pspa[j] = line_yield(line, point.sqrt_pressure[j]);
    }
  }
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    if (axis.moves) {
      const DriveForce drive = drive_force(axis, point.lambda, point.sqrt_pressure[axis.pump]);
      point.out_pressure_pa[i] = drive.out_pressure_pa;
      point.regenerating[i] = drive.regenerating;
      point.drive_force_n[i] = std::min(drive.force_n, axis.most_force_n);
      const double line_m3pspa = yield_m3pspa[axis.pump];
      if (line_m3pspa > 0.0) {
        point.yield_mpsn[i] =
            drive_yield_mpsn(axis, point.lambda, point.drive_force_n[i], line_m3pspa);
      }
    }
  }
}

}  // namespace graben
