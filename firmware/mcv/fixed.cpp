#include "firmware/mcv/policies.hpp"

namespace graben {

PolicyResult choose_fixed(const McvCircuit& circuit, double lambda_max) {
  PolicyResult result;
  result.point = evaluate(circuit, lambda_max);
  result.limit = result.point.limit;
  result.iterations = 1;
  if (result.point.feasible) {
    return result;
  }
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    if (!axis.moves) {
      continue;
    }
    // What a line that can't be fed has left is nothing.
    const double sqrt_pressure =
        solve_pump_pressure(circuit.line[axis.pump], lambda_max).sqrt_pressure;
    const DriveForce drive = drive_force(axis, lambda_max, sqrt_pressure);
    result.point.sqrt_pressure[axis.pump] = sqrt_pressure;
    result.point.pump_pressure_pa[axis.pump] = sqrt_pressure * sqrt_pressure;
    result.point.out_pressure_pa[i] = drive.out_pressure_pa;
    result.point.drive_force_n[i] = drive.force_n;
  }
  return result;
}

}  // namespace graben
