#pragma once
/// The optimisation of Kim et al. (37): how fast the wanted velocities may be followed, and why no
/// faster.

#include "firmware/mcv/policies.hpp"

namespace graben {

/// What is left of every constraint; below 0 it fails.
struct McvMargins {
  PerPump<double> flow_m3ps{};     ///< (29), (30): pump flow at zero pressure.
  PerActuator<double> force_n{};   ///< (36): drive force over F_offset; 0 for an actuator at rest.
  PerActuator<double> travel_m{};  ///< (13): x_m - |x|; 0 for an actuator at rest.
};

/// Whether motion can begin at all: condition (43) at lambda -> 0.
struct Standstill {
  bool can_start = true;
  std::uint8_t actuator = 0;  ///< The one that lacks most, where it can't.
  double short_n = 0.0;       ///< How much it lacks.
};

/// What the optimiser returns: command, what it achieves, why not more, how it ended.
struct McvSolution {
  SolveStatus status = SolveStatus::kBadInput;
  McvPoint point;  ///< The circuit at the lambda returned; at lambda 0 every spool is closed.
  /// The constraint that fails just above; none at range.most. At range.hold what the reserve for
  /// more is lacking for.
  Limit limit;
  /// How much the limit lacks at lambda = 1: m^3/s of pump flow, N of drive force, m of spool
  /// travel (as far as the table's last segment would have to go on, at most 15 x_m). Below 0 where
  /// the limit fails only in between, in a gap of the feasible set.
  double shortfall = 0.0;
  McvMargins margins;     ///< At the lambda returned; at lambda 0 those of (43).
  Standstill standstill;  ///< Looked at only where lambda is 0.
  int iterations = 0;
  McvCheck defect;  ///< Set with kBadInput.
};

/// What a caller asks of lambda beyond feasibility.
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
};

/// Largest lambda in [0, range.most] by `policy` (kFixed alone asks for no feasibility: comparisons
/// only). Bad input, no feasible lambda and an iteration that did not end each give lambda 0 with
/// closed spools and their status; nothing returned is ever NaN or infinite.
[[nodiscard]] McvSolution solve_mcv(const McvMachine& machine, const McvInput& input,
                                    McvPolicy policy, const LambdaRange& range = {});

}  // namespace graben
