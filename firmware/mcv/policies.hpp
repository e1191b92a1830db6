// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The ways to choose lambda in (37). Each costs a bounded number of operations and returns a
/// point that `evaluate` found feasible, or lambda 0; `choose_fixed` alone does not ask.

#include "firmware/mcv/evaluation.hpp"
#include "firmware/mcv/requirement.hpp"

namespace graben {

struct PolicyResult {
  McvPoint point;  ///< lambda 0 with nothing set where no lambda was found.
  Limit limit;     ///< The constraint that fails just above; none where `most` was reached. Where
                   ///< lambda is `hold`, what the rise lacks the reserve for.
  int iterations = 0;
  bool bounded =
      true;  ///< False: a fixed number of steps was not enough; the point may not be used.
};

/// Request to lambda: over `hold` that the circuit be feasible with the whole reserve on its
/// loads, from `hold` down with the share that holding asks for, which is never more. Both circuits
/// have the same lines, and so the same pressures; they are one that takes on the loads of either,
/// and is that of whoever was asked for last: each would be a fifth of the stack that an ECU has.
struct Asked {
  McvCircuit& circuit;
  PerActuator<double> rising_n{};  ///< Loads with the whole reserve.
  PerActuator<double> holding_n{};
  double most = 1.0;
  double hold = 0.0;

  [[nodiscard]] const McvCircuit& rising() const { return with_loads(rising_n); }
  [[nodiscard]] const McvCircuit& holding() const { return with_loads(holding_n); }
  [[nodiscard]] const McvCircuit& at(double lambda) const {
    return lambda > hold ? rising() : holding();
  }
  const McvCircuit& with_loads(const PerActuator<double>& loads_n) const {
    for (unsigned i = 0; i < circuit.axis_count; ++i) {
      circuit.axis[i].load_force_n = loads_n[i];
    }
    return circuit;
  }
};

/// Last step of Algorithm 1 as a share of [0, most], after 24 halvings. [-; derived: the same
/// tolerance as kStandstillLambda]
inline constexpr double kAlgorithm1Width = kStandstillLambda;

/// Algorithm 1 of Kim et al.: divide and conquer. A local maximum of (37), the global one unless
/// regeneration splits the feasible set (Theorem 4). `hold` splits the first interval where
/// halving would otherwise do so. At most 27 evaluations.
[[nodiscard]] PolicyResult choose_algorithm1(const Asked& asked);

/// The end of the feasible interval that contains lambda = 0: `first_change` of every constraint
/// from standstill towards faster motion, the slowest of them. By halving where a search does not
/// end and on lines without pump flow.
[[nodiscard]] PolicyResult choose_connected(const Asked& asked);

/// Jumps of the global policy from one failing constraint to where it holds next. [-; size: each
/// leaves one infeasible interval behind, of which there are few; at the cap Algorithm 1's counts]
inline constexpr int kGlobalJumps = 64;

/// The largest feasible lambda on [0, most], to 1e-9 of itself but where rounding decides: a
/// load that ties with what the relief valve can hold, or a line without pump flow, fed by
/// regeneration alone. There its result is halved towards the last infeasible lambda that it met;
/// where it found none or did not end, Algorithm 1's counts.
///
/// Why the largest: the search starts at `most`, or at the pump flow limit if that is lower (in
/// closed form: r = 0). Where `evaluate` finds the point feasible, nothing larger is left. Where it
/// does not, some axis fails its constraints, and lambda falls to the next smaller value at which
/// that axis holds them again. `first_change` passes no such value, because between two openings of
/// check valves every constraint is a difference of two convex functions of r = sqrt(P) / lambda
/// and r falls strictly as lambda grows (pressure_ratio.hpp, requirement.hpp). So what is skipped
/// is infeasible, and the first feasible point that is met is the largest. The relief valve (Remark
/// 2) only lifts a convex function and changes nothing of this.
///
/// Why bounded: each jump leaves one infeasible interval of one constraint behind. Their number is
/// small (two a stretch where the load resists; one where it helps and the axis' own check valve is
/// closed), and both jumps and steps are capped besides. Feasible intervals shorter than 1e-9 of
/// lambda may be passed over: the result is put that far inside, so that rounding does not decide.
[[nodiscard]] PolicyResult choose_global(const Asked& asked);

/// What the optimisation is for, by leaving it out: lambda_max whatever it takes. Spools that can't
/// give their part open fully; the point may be infeasible.
[[nodiscard]] PolicyResult choose_fixed(const McvCircuit& circuit, double lambda_max);

}  // namespace graben
