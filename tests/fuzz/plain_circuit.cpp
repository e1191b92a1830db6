// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/plain_circuit.hpp"

#include <algorithm>
#include <cmath>

namespace graben::test {
namespace {

/// One actuator's flows at lambda; Q_out of one that stands still is 0, like everything of it.
struct Flows {
  bool moves = false;
  bool regenerates = false;  ///< The circuit is on this side; its valve may still be closed.
  double in = 0.0;
  double out = 0.0;
  double area_in = 0.0;
  double area_out = 0.0;
};

Flows flows_of(const McvActuator& actuator, double velocity, double lambda) {
  const double cap = actuator.area_cap_m2;
  const double rod = actuator.area_rod_m2;
  Flows flows;
  if (velocity > 0.0) {
    flows = {true, actuator.regeneration == RegenerationSide::kExtend, 0.0, 0.0, cap, rod};
  } else if (velocity < 0.0) {
    flows = {true, actuator.regeneration == RegenerationSide::kRetract, 0.0, 0.0, rod, cap};
  }
  flows.in = flows.area_in * lambda * std::abs(velocity);
  flows.out = flows.area_out * lambda * std::abs(velocity);
  return flows;
}

/// P_out: the drain takes c_d sqrt(P_out); what it can't, the check valve takes into the line at
/// `pump_pa`. (17) as a quadratic in sqrt(P_out).
double out_pressure(const McvActuator& actuator, double q_out, double pump_pa) {
  const double drain = actuator.c_drain;
  const double check = actuator.c_check;
  const double drained_alone = q_out * q_out / (drain * drain);
  if (pump_pa >= drained_alone) {
    return drained_alone;
  }
  const double a = check * check - drain * drain;
  const double b = 2.0 * drain * q_out;
  const double c = -(q_out * q_out + check * check * pump_pa);
  const double root = 2.0 * -c / (b + std::sqrt(b * b - 4.0 * a * c));
  return root * root;
}

/// (27), (28) at a pump pressure: what the pump gives less what leaves its line.
struct Line {
  double left = 0.0;
  double size = 0.0;  ///< Sum of the terms' sizes.
  void add(double term) {
    left += term;
    size += std::abs(term);
  }
};

class Circuit {
 public:
  Circuit(const McvMachine& machine, const McvInput& input, double lambda)
      : machine_(machine), input_(input) {
    for (unsigned i = 0; i < count(); ++i) {
      flows_[i] = flows_of(machine.actuator[i], input.velocity_mps[i], lambda);
    }
  }

  [[nodiscard]] unsigned count() const { return static_cast<unsigned>(machine_.actuator_count); }
  [[nodiscard]] const Flows& flows(unsigned i) const { return flows_[i]; }

  [[nodiscard]] Line line(unsigned pump, double pa) const {
    const McvPump& from = machine_.pump[pump];
    Line line;
    double resistance = from.series_resistance;
    line.add(input_.pump_flow_m3ps[pump]);
    line.add(-from.leak_linear * pa);
    line.add(-from.leak_quadratic * pa * pa);
    for (unsigned i = 0; i < count(); ++i) {
      const McvActuator& actuator = machine_.actuator[i];
      if (static_cast<unsigned>(actuator.pump) != pump) {
        continue;
      }
      const double bypass = flows_[i].moves ? actuator.bypass_closed : actuator.bypass_open;
      resistance += 1.0 / (bypass * bypass);
      line.add(-flows_[i].in);
      if (flows_[i].regenerates) {
        line.add(flows_[i].out);
        line.add(-actuator.c_drain * std::sqrt(out_pressure(actuator, flows_[i].out, pa)));
      }
    }
    if (resistance > 0.0) {
      line.add(-std::sqrt(pa / resistance));
    } else if (pa > 0.0) {
      line.add(-1e9);  // Nothing holds a pressure in this line.
    }
    return line;
  }

  /// Root of `line`, or the relief valve's pressure; halved on sqrt(P) until nothing changes.
  [[nodiscard]] double pump_pressure(unsigned pump) const {
    const McvPump& from = machine_.pump[pump];
    if (from.has_relief && line(pump, from.relief_pa).left >= 0.0) {
      return from.relief_pa;
    }
    double high = from.has_relief ? std::sqrt(from.relief_pa) : 100.0;
    while (line(pump, high * high).left > 0.0) {
      high *= 4.0;
    }
    double low = 0.0;
    for (double middle = 0.5 * high; middle > low && middle < high; middle = 0.5 * (low + high)) {
      (line(pump, middle * middle).left > 0.0 ? low : high) = middle;
    }
    return low * low;
  }

 private:
  const McvMachine& machine_;
  const McvInput& input_;
  PerActuator<Flows> flows_;
};

/// Back flow (36) and spool travel (13) of one actuator.
void check_actuator(const McvMachine& machine, const McvInput& input, double lambda,
                    const Flows& flows, unsigned i, PlainPoint& point) {
  const McvActuator& actuator = machine.actuator[i];
  const double speed = lambda * std::abs(input.velocity_mps[i]);
  const double pump_pa = point.pump_pressure_pa[static_cast<unsigned>(actuator.pump)];
  if (flows.regenerates) {
    point.out_pressure_pa[i] = out_pressure(actuator, flows.out, pump_pa);
  }
  const double push = flows.area_in * pump_pa;
  const double back = flows.area_out * point.out_pressure_pa[i];
  const double cap = actuator.area_cap_m2 * input.cap_pressure_pa[i];
  const double rod = actuator.area_rod_m2 * input.rod_pressure_pa[i];
  const double load = input.velocity_mps[i] > 0.0 ? cap - rod : rod - cap;
  double force = push - back - load;
  const double size = push + back + cap + rod + actuator.force_offset_n + 1e-300;
  point.margin = std::min(point.margin, (force - actuator.force_offset_n) / size);
  if (actuator.c_inflow_check > 0.0) {
    force -= flows.area_in * std::pow(flows.in / actuator.c_inflow_check, 2.0);
  }
  const MonotoneTable& table = input.velocity_mps[i] > 0.0 ? actuator.extend : actuator.retract;
  const double full = speed / table.y(table.size() - 1);
  point.margin = std::min(point.margin, (force - full * full) / size);
  point.coefficient[i] = force > 0.0 ? speed / std::sqrt(force) : 0.0;
}

}  // namespace

PlainPoint plain_point(const McvMachine& machine, const McvInput& input, double lambda) {
  PlainPoint point;
  point.margin = 1.0;
  const Circuit circuit(machine, input, lambda);
  for (unsigned j = 0; j < static_cast<unsigned>(machine.pump_count); ++j) {
    const Line at_zero = circuit.line(j, 0.0);
    point.margin = std::min(point.margin, at_zero.left / (at_zero.size + 1e-300));
    if (at_zero.left < 0.0) {
      return point;
    }
    point.pump_pressure_pa[j] = circuit.pump_pressure(j);
  }
  for (unsigned i = 0; i < circuit.count(); ++i) {
    if (circuit.flows(i).moves) {
      check_actuator(machine, input, lambda, circuit.flows(i), i, point);
    }
  }
  return point;
}

double plain_coefficient(const MonotoneTable& table, double travel_m) {
  for (int i = 1; i < table.size(); ++i) {
    if (travel_m <= table.x(i)) {
      const double share = (travel_m - table.x(i - 1)) / (table.x(i) - table.x(i - 1));
      return table.y(i - 1) + share * (table.y(i) - table.y(i - 1));
    }
  }
  return table.y(table.size() - 1);
}

}  // namespace graben::test
