// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One pump's line over r = sqrt(P) / lambda instead of over lambda.
///
/// f of (18) is homogeneous: f(lambda Q, lambda r) = lambda phi(r). So with y = 1 / lambda the
/// balance (27), (28) reads
///   flow y = h(r) + k1 r^2 / y + k2 r^4 / y^3,   h(r) = in_flow + c_by r + sum(c_d phi(r)),
/// and with Remark 2 y is at least r / sqrt(P_pr). Two facts carry every search over lambda:
///   1. y grows strictly with r: lambda falls as r grows. Which check valves are open depends on r
///      alone (open where r < Q_out^d / c_d), so each of them switches once over all of lambda.
///   2. Between two such switches (a Stretch) y is convex in r. There h is convex (every phi is
///      convex while its valve is open, constant while closed); r^2 / y and r^4 / y^3 are convex in
///      (r, y); so {(r, y): right side <= flow y} is convex, and it is the epigraph of y, for the
///      right side falls with y. The maximum with r / sqrt(P_pr) is convex as well.

#include "firmware/mcv/pump_pressure.hpp"

namespace graben {

/// Part of the r axis on which no check valve switches; open are those with opening >= high.
struct Stretch {
  double low = 0.0;
  double high = 0.0;  ///< Infinite right of the last opening.
};

/// The stretch that begins at r, or the one that ends there.
[[nodiscard]] Stretch stretch_right_of(const FlowBalance& line, double ratio);
[[nodiscard]] Stretch stretch_left_of(const FlowBalance& line, double ratio);

/// A value and its slope over r; where a convex function has a kink, one of its tangents.
struct Tangent {
  double value = 0.0;
  double slope = 0.0;
};

/// y = 1 / lambda at r in a stretch; infinite where only lambda = 0 belongs to r, 0 where lambda is
/// not bounded. `least` is a y that is known not to be over it, as a tangent of the same stretch
/// has it, and saves steps; 0 if there is none.
[[nodiscard]] Tangent inverse_lambda(const FlowBalance& line, const Stretch& stretch, double ratio,
                                     double least = 0.0);

/// No pump flow to speak of, and still something to move: then lambda is so steep in r that
/// rounding shows in it.
[[nodiscard]] bool is_starved(const FlowBalance& line);

/// Neither flow nor leakage: then the balance fixes r, whatever lambda is, and 1. does not hold.
[[nodiscard]] bool is_stagnant(const FlowBalance& line);

/// lambda up to which the pump can feed its line, (29), (30); infinite where nothing bounds it.
[[nodiscard]] double fed_lambda(const FlowBalance& line);

}  // namespace graben
