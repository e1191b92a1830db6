// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The optimisation of Kim et al. (37): how fast the wanted velocities may be followed, and why no
/// faster.

#include "firmware/drives/drive_servo.hpp"
#include "firmware/mcv/policies.hpp"

namespace graben {

/// Remainder of every constraint; below 0 it fails.
struct McvMargins {
  PerPump<double> flow_m3ps{};     ///< (29), (30): pump flow at zero pressure.
  PerActuator<double> force_n{};   ///< (36): drive force over F_offset; 0 for an actuator at rest.
  PerActuator<double> travel_m{};  ///< (13): x_m - |x|; 0 for an actuator at rest.
};

/// Result at standstill: whether motion can begin at all, condition (43) at lambda -> 0.
struct Standstill {
  bool can_start = true;
  std::uint8_t actuator = 0;  ///< The one that lacks most, where it can't.
  double short_n = 0.0;       ///< How much it lacks.
};

/// Result of the optimiser: command, what it achieves, why not more, how it ended.
struct McvSolution {
  SolveStatus status = SolveStatus::kBadInput;
  McvPoint point;  ///< The circuit at the lambda returned; at lambda 0 every spool is closed.
  /// The constraint that fails just above; none at range.most. At range.hold what the reserve for
  /// more is lacking for.
  Limit limit;
  /// Shortfall of the limit at lambda = 1: m^3/s of pump flow, N of drive force, m of spool
  /// travel (as far as the table's last segment would have to go on, at most 15 x_m). Below 0 where
  /// the limit fails only in between, in a gap of the feasible set.
  double shortfall = 0.0;
  McvMargins margins;     ///< At the lambda returned; at lambda 0 those of (43).
  Standstill standstill;  ///< Looked at only where lambda is 0.
  int iterations = 0;
  int steps = 0;    ///< Of SolveSteps.
  McvCheck defect;  ///< Set with kBadInput.
};

/// Request to lambda beyond feasibility.
struct LambdaRange {
  double most = 1.0;  ///< In (0, 1].
  /// Drive force that every moving axis must have beyond its need, N, but no more than half of what
  /// it has left over at standstill, (43). It shapes the choice of lambda; pressures, spools and
  /// margins are those without it.
  double reserve_n = 0.0;
  /// At this lambda and below a share of the reserve, as it then is, is enough: what was held
  /// before is held with less than it was reached with. 0 .. 1 each.
  double hold = 0.0;
  double hold_share = 1.0;
  int taken = 0;  ///< McvSolution::steps of earlier solves in this cycle; it has what they left.
};

/// How many steps the searches of a solve may take: `search` and, kept for halving, `halving`; and
/// `least`, whatever earlier solves of its cycle took. Where they end before a search does, halving
/// gives a lambda that may be smaller, and where that has no end either, kNotConverged says so.
struct SolveSteps {
  int search = 0;
  int halving = 0;
  int least = 0;

  [[nodiscard]] int all() const { return search + halving; }
};

/// By how much circuit there is, of a machine that passed its check.
[[nodiscard]] SolveSteps solve_steps(const McvMachine& machine, McvPolicy policy);

/// Largest lambda in [0, range.most] by `policy` (kFixed alone asks for no feasibility: comparisons
/// only). Bad input, no feasible lambda and an iteration that did not end each give lambda 0 with
/// closed spools and their status; nothing returned is ever NaN or infinite.
[[nodiscard]] McvSolution solve_mcv(const McvMachine& machine, const McvInput& input,
                                    McvPolicy policy, const LambdaRange& range = {});

/// Of a bank of drives: V_L^d, chamber pressures, and the pumps' flow at zero pressure.
[[nodiscard]] McvInput mcv_input(Span<const double> velocity_mps, Span<const LoadState> load,
                                 Span<const double> pump_flow_m3ps);

/// This cycle's solution after one that ended at `last_lambda` (0 from rest), `period_s` ago.
///
/// It rises to what is feasible with the reserve, no further than the rate allows; otherwise it
/// stays where it was, or falls to the next value below at which the share of the reserve that
/// holding asks for is there. That share is for the model: where hardly any force is left over, c_L
/// of (9) hangs on the last newtons, and a pressure read a little wrong is a speed much wrong. The
/// rest is for peace: the search goes down from the bound that the rate sets, so lambda climbs
/// through feasible values and never jumps up over a gap of the feasible set wider than one cycle's
/// rise. To come back above a gap that it fell across, it needs the gap gone for all of the climb,
/// with the rest of the reserve on top; pressure noise worth less than that can then neither open
/// the gap under it nor close it again. The price: below a stretch of lambda that is feasible, but
/// not with the reserve, it stays too. Where it stays, `limit` is what lacks
/// the reserve. A rise or a period that is no number, a reserve below 0, or a share outside 0 .. 1
/// is kBadInput.
[[nodiscard]] McvSolution steady_lambda(const McvMachine& machine, const McvInput& input,
                                        McvPolicy policy, const LambdaRise& rise,
                                        double last_lambda, double period_s);

/// kSolverFailed unless the optimiser ended with a lambda that may be followed, 0 included.
[[nodiscard]] inline Fault solver_fault(const McvSolution& solution) {
  const bool solved =
      solution.status == SolveStatus::kOk || solution.status == SolveStatus::kInfeasible;
  return solved ? Fault::kNone : Fault::kSolverFailed;
}

}  // namespace graben
