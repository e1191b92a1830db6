// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Pressure of one pump's line: the circuit's flow balance (27), (28), solved for s = sqrt(P).

#include <array>
#include <limits>

#include "firmware/mcv/mcv_machine.hpp"
#include "firmware/mcv/work.hpp"

namespace graben {

/// A regeneration circuit that is in play: its side is the one the spool moves to.
struct RegenerationDemand {
  double q_out_m3ps = 0.0;  ///< Q_out^d, at lambda = 1.
  double c_drain = 0.0;
  double c_check = 0.0;
  /// Q_out^d / c_d in sqrt(Pa): the check valve is open while sqrt(P) / lambda is below it.
  double opening = 0.0;
};

/// Everything in the balance of one pump's line, flows as they are at lambda = 1:
///   g(s) = flow - k1 s^2 - k2 s^4 - c_by s - lambda in_flow - sum(c_d f(lambda Q_out, s)) = 0.
struct FlowBalance {
  double flow_m3ps = 0.0;  ///< Q_p at zero pressure.
  /// The same, but 0 where it is too little to tell lambda from r.
  double ratio_flow_m3ps = 0.0;
  double leak_linear = 0.0;      ///< k1
  double leak_quadratic = 0.0;   ///< k2
  double bypass = 0.0;           ///< c_by of (21), (22); 0 stands for no resistance at all: P = 0.
  double in_flow_m3ps = 0.0;     ///< Sum of Q_in, less Q_out where regeneration is in play.
  double least_flow_m3ps = 0.0;  ///< What (29), (30) ask for: demand at zero pressure.
  bool has_relief = false;
  double sqrt_relief = 0.0;  ///< sqrt(P_pr) of Remark 2.
  int regeneration_count = 0;
  std::array<RegenerationDemand, kMaxActuators> regeneration{};
  /// The pump, where its regulator sets its swash: what stands above is then the most that it
  /// gives. Null: what it is told.
  const McvPump* regulated = nullptr;
  /// Where a search on the line takes its steps from; null: none may be made.
  Work* work = nullptr;
};

/// Remainder of the balance at s; strictly decreasing in s.
[[nodiscard]] double flow_left(const FlowBalance& balance, double lambda, double sqrt_pressure);

/// Margin of the pump flow constraint (29), (30).
[[nodiscard]] inline double feed_margin_m3ps(const FlowBalance& balance, double lambda) {
  return balance.flow_m3ps - lambda * balance.least_flow_m3ps;
}

/// Relative length below which a Newton step is the last one. [-; derived: 1.5 times its square is
/// less than a double tells apart]
inline constexpr double kNewtonLastStep = 1e-8;

struct PumpPressure {
  bool fed = false;        ///< False: (29), (30) is violated; nothing else is set.
  bool converged = false;  ///< False only if the fixed iteration count was not enough.
  double sqrt_pressure = 0.0;
  int iterations = 0;
};

/// Root of the balance, held at the relief valve's pressure where it would be higher (Remark 2).
///
/// Between two openings of regeneration valves g is concave: every f with its valve open is convex
/// in s, with its valve closed constant, and the leakage and bypass terms are concave. So Newton
/// from the right falls monotonically onto a root of its stretch; a step that would leave the
/// stretch shows that the root lies left of it, and goes on from its end. Near the root a step of
/// relative length d leaves an error of at most 1.5 d^2 (|g'' s / 2 g'| is at most 1.5, term by
/// term): the step under 1e-8 is the last. At most 24 steps; a test over wide random circuits sees
/// two thirds. `guess`, an s near the root, saves the first of them: right of the root it is where
/// Newton starts, left of it its tangent leads there; infinite if there is none.
[[nodiscard]] PumpPressure solve_pump_pressure(
    const FlowBalance& balance, double lambda,
    double guess = std::numeric_limits<double>::infinity());

}  // namespace graben
