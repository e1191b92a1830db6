// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A valve and one cycle's input, put into the terms that every evaluation needs: prepared once for
/// each solve. Flows and speeds are those at lambda = 1.

#include "firmware/mcv/pump_pressure.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {

/// One actuator in the direction that it is asked to move, (33) - (35).
struct CircuitAxis {
  bool moves = false;  ///< False: nothing else is set, and the spool stays closed.
  bool extends = false;
  bool regeneration = false;  ///< The circuit is on the side that the spool moves to.
  unsigned pump = 0;
  double speed_mps = 0.0;   ///< |V_L^d|
  double q_in_m3ps = 0.0;   ///< Q_in^d
  double q_out_m3ps = 0.0;  ///< Q_out^d
  double inlet_area_m2 = 0.0;
  double outlet_area_m2 = 0.0;
  double load_force_n = 0.0;  ///< F_L sgn(x) of (36); below 0 the load helps.
  double force_offset_n = 0.0;
  double c_drain = 0.0;
  double c_check = 0.0;
  double opening = 0.0;  ///< sqrt(P) / lambda under which the check valve is open; else 0.
  /// Force lost in the in-flow line's check valve at lambda = 1 (Remark 3); grows with lambda^2.
  double inflow_check_force_n = 0.0;
  /// Force that full opening needs at lambda = 1, that of the in-flow check valve included.
  double full_opening_force_n = 0.0;
  /// Drive force at which its metering edge has the margin of a load-sensing pump; else 0.
  double margin_force_n = 0.0;
  double most_force_n = kInfinity;       ///< A compensator leaves its edges no more.
  double outlet_share = 0.0;             ///< Of the drive force, lost at the draining edge.
  const MonotoneTable* spool = nullptr;  ///< c_L of the direction; lives in the machine.
};

struct McvCircuit {
  unsigned axis_count = 0;
  unsigned pump_count = 0;
  bool regulated = false;  ///< A pump sets its own swash.
  const McvMachine* machine = nullptr;
  PerActuator<CircuitAxis> axis{};
  PerPump<FlowBalance> line{};
  Work* work = nullptr;  ///< That of its lines.
};

/// For a machine and an input that passed their checks. The circuit points into the machine.
/// Its searches take their steps from `work`; without one none may be made.
[[nodiscard]] McvCircuit make_circuit(const McvMachine& machine, const McvInput& input,
                                      Work* work = nullptr);

}  // namespace graben
