// SPDX-License-Identifier: Apache-2.0
#include "firmware/mcv/circuit.hpp"

#include <cmath>

#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/tuning.hpp"
#include "firmware/mcv/work.hpp"

namespace graben {
namespace {

CircuitAxis make_axis(const McvActuator& actuator, double velocity_mps, double cap_pa,
                      double rod_pa) {
  CircuitAxis axis;
  axis.pump = static_cast<unsigned>(actuator.pump);
  if (velocity_mps == 0.0) {
    return axis;
  }
  const double load_n = actuator.area_cap_m2 * cap_pa - actuator.area_rod_m2 * rod_pa;
  axis.moves = true;
  axis.extends = velocity_mps > 0.0;
  axis.speed_mps = std::abs(velocity_mps);
  axis.inlet_area_m2 = axis.extends ? actuator.area_cap_m2 : actuator.area_rod_m2;
  axis.outlet_area_m2 = axis.extends ? actuator.area_rod_m2 : actuator.area_cap_m2;
  axis.q_in_m3ps = axis.inlet_area_m2 * axis.speed_mps;
  axis.q_out_m3ps = axis.outlet_area_m2 * axis.speed_mps;
  axis.load_force_n = axis.extends ? load_n : -load_n;
  axis.force_offset_n = actuator.force_offset_n;
  axis.regeneration = actuator.regeneration ==
                      (axis.extends ? RegenerationSide::kExtend : RegenerationSide::kRetract);
  if (axis.regeneration) {
    axis.c_drain = actuator.c_drain;
    axis.c_check = actuator.c_check;
    axis.opening = axis.q_out_m3ps / actuator.c_drain;
  }
  axis.spool = axis.extends ? &actuator.extend : &actuator.retract;
  // (12) turned over: F = (V / c_L)^2. The check valve's loss A_in (Q_in / c)^2 comes on top of it.
  const double full = axis.speed_mps / axis.spool->y_last();
  if (actuator.c_inflow_check > 0.0) {
    const double loss = axis.q_in_m3ps / actuator.c_inflow_check;
    axis.inflow_check_force_n = axis.inlet_area_m2 * loss * loss;
  }
  axis.full_opening_force_n = full * full + axis.inflow_check_force_n;
  return axis;
}

/// What the regulator of the axis' pump makes of its edges.
void regulate_axis(const McvActuator& actuator, const PumpRegulator& by, CircuitAxis& axis) {
  axis.outlet_share = axis.extends ? actuator.extend_outlet_share : actuator.retract_outlet_share;
  if (by.kind == PumpKind::kLoadSensing) {
    axis.margin_force_n = axis.inlet_area_m2 * by.margin_pa / (1.0 - axis.outlet_share);
    axis.most_force_n = by.compensated ? axis.margin_force_n : kInfinity;
  }
}

FlowBalance make_line(const McvMachine& machine, const PerActuator<CircuitAxis>& axes,
                      unsigned pump, double pump_flow_m3ps) {
  const McvPump& from = machine.pump[pump];
  FlowBalance line;
  line.flow_m3ps = pump_flow_m3ps;
  line.leak_linear = from.leak_linear;
  line.leak_quadratic = from.leak_quadratic;
  line.has_relief = from.has_relief;
  line.sqrt_relief = from.has_relief ? std::sqrt(from.relief_pa) : 0.0;
  double moved_m3ps = 0.0;
  double bypass_resistance = from.series_resistance;
  for (unsigned i = 0; i < static_cast<unsigned>(machine.actuator_count); ++i) {
    const CircuitAxis& axis = axes[i];
    if (axis.pump != pump) {
      continue;
    }
    const McvActuator& actuator = machine.actuator[i];
    bypass_resistance +=
        orifice_resistance(axis.moves ? actuator.bypass_closed : actuator.bypass_open);
    line.in_flow_m3ps += axis.q_in_m3ps;
    moved_m3ps += axis.q_in_m3ps + axis.q_out_m3ps;
    line.least_flow_m3ps += axis.q_in_m3ps;
    if (axis.regeneration) {
      line.in_flow_m3ps -= axis.q_out_m3ps;
      line.least_flow_m3ps -= axis.q_out_m3ps * (axis.c_check / (axis.c_check + axis.c_drain));
      line.regeneration[static_cast<unsigned>(line.regeneration_count++)] = {
          axis.q_out_m3ps, axis.c_drain, axis.c_check, axis.opening};
    }
  }
  line.ratio_flow_m3ps = pump_flow_m3ps >= kStarvedFlowShare * moved_m3ps ? pump_flow_m3ps : 0.0;
  // A line with nothing in its bypass holds no pressure; only a pump without spools can be one.
  line.bypass = bypass_resistance > 0.0 ? 1.0 / std::sqrt(bypass_resistance) : 0.0;
  return line;
}

}  // namespace

// Never inlined, whatever a compiler sees of it: the bound's counts stand on its calls.
[[gnu::noinline]] void spend(Work& work) { --work.left; }

McvCircuit make_circuit(const McvMachine& machine, const McvInput& input, Work* work) {
  McvCircuit circuit;
  circuit.work = work;
  circuit.axis_count = static_cast<unsigned>(machine.actuator_count);
  circuit.pump_count = static_cast<unsigned>(machine.pump_count);
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    circuit.axis[i] = make_axis(machine.actuator[i], input.velocity_mps[i],
                                input.cap_pressure_pa[i], input.rod_pressure_pa[i]);
  }
  for (unsigned j = 0; j < circuit.pump_count; ++j) {
    circuit.line[j] = make_line(machine, circuit.axis, j, input.pump_flow_m3ps[j]);
    circuit.line[j].work = work;
    if (machine.pump[j].regulator.sets_swash()) {
      circuit.regulated = true;
      circuit.line[j].regulated = &machine.pump[j];
    }
  }
  if (circuit.regulated) {
    circuit.machine = &machine;
    for (unsigned i = 0; i < circuit.axis_count; ++i) {
      if (circuit.axis[i].moves) {
        regulate_axis(machine.actuator[i], machine.pump[circuit.axis[i].pump].regulator,
                      circuit.axis[i]);
      }
    }
  }
  return circuit;
}

}  // namespace graben
