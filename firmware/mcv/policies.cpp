// SPDX-License-Identifier: Apache-2.0
#include "firmware/mcv/policies.hpp"

#include <algorithm>

#include "firmware/mcv/descent.hpp"
#include "firmware/mcv/regulated.hpp"

namespace graben {

PolicyResult choose_algorithm1(const Asked& asked) {
  PolicyResult result;
  allow_kept(asked.circuit.work);
  const McvCircuit* circuit = &asked.at(asked.most);
  McvPoint low;
  McvPoint high = evaluate(*circuit, asked.most);
  result.bounded = high.converged;
  if (high.feasible) {
    result.point = high;
    return result;
  }
  if (asked.hold > 0.0 && asked.hold < asked.most) {
    const McvPoint held = evaluate(asked.holding(), asked.hold, &high);
    ++result.iterations;
    result.bounded = result.bounded && held.converged;
    circuit = held.feasible ? &asked.rising() : &asked.holding();
    (held.feasible ? low : high) = held;
  }
  // The last infeasible point lies one last step above the last feasible one (Theorem 4), so
  // `limit` is what fails just above, and `point` what the paper's final lines return.
  const Halved found = halved(*circuit, low, high, kAlgorithm1Width * asked.most);
  result.point = found.point;
  result.limit = found.limit;
  result.iterations += found.evaluations;
  result.bounded = result.bounded && found.bounded;
  return result;
}

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
    const double sqrt_pressure = line_pressure(circuit, axis.pump, lambda_max).sqrt_pressure;
    const DriveForce drive = drive_force(axis, lambda_max, sqrt_pressure);
    result.point.sqrt_pressure[axis.pump] = sqrt_pressure;
    result.point.pump_pressure_pa[axis.pump] = sqrt_pressure * sqrt_pressure;
    result.point.out_pressure_pa[i] = drive.out_pressure_pa;
    result.point.drive_force_n[i] = std::min(drive.force_n, axis.most_force_n);
  }
  return result;
}

}  // namespace graben
