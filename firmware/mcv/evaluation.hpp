// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The whole circuit at one lambda: pressures, forces, spools, and which constraint fails first.

#include "firmware/core/codes.hpp"
#include "firmware/mcv/circuit.hpp"

namespace graben {

/// State of the circuit at one lambda (38) - (42).
struct McvPoint {
  double lambda = 0.0;
  bool feasible = false;
  bool converged = true;  ///< False: a bounded iteration did not end; then not feasible either.
  /// First constraint that fails, in the order pump flow, back flow, spool travel.
  Limit limit;
  /// Of the axes whose constraints fail the one that lacks most of its line's pressure, a guess at
  /// which holds again last; -1 where none does.
  int hardest_axis = -1;
  int newton_steps = 0;
  PerPump<double> pump_pressure_pa{};     ///< P_p
  PerPump<double> sqrt_pressure{};        ///< sqrt(P_p), as it was solved for.
  PerPump<double> feed_margin_m3ps{};     ///< Of (29), (30).
  PerActuator<double> out_pressure_pa{};  ///< P_out
  PerActuator<double> drive_force_n{};    ///< F_s - F_L sgn(x); 0 for an actuator at rest
  /// x, signed; 0 for an actuator at rest, and everywhere before `open_spools`.
  PerActuator<double> spool_m{};
  /// By how much a drive of a line under negative flow control gets slower at its opening for each
  /// newton that is added to its load, m/s over N; else 0, and everywhere before `open_spools`.
  PerActuator<double> yield_mpsn{};
  PerActuator<bool> regenerating{};  ///< Whether the check valve is open.
};

/// Evaluates (27) - (30), (36) with F_offset and (13) at `lambda` in (0, 1]. Where a constraint
/// fails, what depends on it stays 0. `near`, a point of the same circuit, saves Newton steps.
[[nodiscard]] McvPoint evaluate(const McvCircuit& circuit, double lambda,
                                const McvPoint* near = nullptr);

/// `point` under the loads of a circuit with the same lines: its pressures are what they were.
void reload(const McvCircuit& circuit, McvPoint& point);

/// Sets the spools of a point with drive forces, (42); fully open where that is not enough.
void open_spools(const McvCircuit& circuit, McvPoint& point);

/// Whether at `lambda` what failed in `fails` fails again, the pump or the axis that lacks most:
/// for the price of one line. False where that is not sure, too. `near` as for `evaluate`; it
/// learns the line's pressure.
[[nodiscard]] bool still_fails(const McvCircuit& circuit, const McvPoint& fails, double lambda,
                               McvPoint& near);

/// (40), (41) of one axis at a given pressure of its pump's line.
struct DriveForce {
  double force_n = 0.0;  ///< F_s - F_L sgn(x)
  double out_pressure_pa = 0.0;
  bool regenerating = false;
};
[[nodiscard]] DriveForce drive_force(const CircuitAxis& axis, double lambda, double sqrt_pressure);

/// Drive force that an axis needs: F_offset of (36), and what (42) asks for with its spool fully
/// open, (13).
[[nodiscard]] double needed_force_n(const CircuitAxis& axis, double lambda);

/// c_L that the spool needs at `lambda` for the force it has, (42); infinite where the check valve
/// of the in-flow line alone needs all of it.
[[nodiscard]] double needed_coefficient(const CircuitAxis& axis, double lambda, double force_n);

}  // namespace graben
