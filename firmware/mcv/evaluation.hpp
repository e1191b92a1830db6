#pragma once
/// The whole circuit at one lambda: pressures, forces, spools, and which constraint fails first.

#include "firmware/core/codes.hpp"
#include "firmware/mcv/mcv_machine.hpp"

namespace graben {

/// State of the circuit at one lambda (38) - (42).
struct McvPoint {
  double lambda = 0.0;
  bool feasible = false;
  bool converged = true;  ///< False: a bounded iteration did not end; then not feasible either.
  /// First constraint that fails, in the order pump flow, back flow, spool travel.
  Limit limit;
  int newton_steps = 0;
  PerPump<double> pump_pressure_pa{};     ///< P_p
  PerActuator<double> out_pressure_pa{};  ///< P_out
  PerActuator<double> drive_force_n{};    ///< F_s - F_L sgn(x); 0 for an actuator at rest
  PerActuator<double> spool_m{};          ///< x, signed; 0 for an actuator at rest
  PerActuator<bool> regenerating{};       ///< Whether the check valve is open.
};

/// Evaluates (27) - (30), (36) with F_offset and (13) at `lambda` in (0, 1] for a machine and an
/// input that passed their checks. Where a constraint fails, what depends on it stays 0.
[[nodiscard]] McvPoint evaluate(const McvMachine& machine, const McvInput& input, double lambda);

}  // namespace graben
