// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One constraint on lambda as a difference of two convex functions of r, and the search for the
/// first r at which it changes.
///
/// Back flow (36) and spool travel (13) both ask that, with s = lambda r and P_out = lambda^2
/// phi^2,
///   lambda^2 (A_in r^2 - A_out phi(r)^2 - G^2) >= L,
/// G^2 = 0 and L = F_L sgn(x) + F_offset for back flow; for spool travel L = F_L sgn(x) and G^2 the
/// force that full opening needs at lambda = 1. With y = 1 / lambda and both sides as lengths:
///   L > 0:   |sqrt(A_in) r|                   >= |(sqrt(A_out) phi, G, sqrt(L) y)|
///   L <= 0:  |(sqrt(A_in) r, sqrt(-L) y)|     >= |(sqrt(A_out) phi, G)|
/// On a stretch r, phi(r) and y(r) are convex and not negative, and the length of a vector of such
/// functions is convex. So what drives (left) and what resists (right) are both convex in r.

#include "firmware/mcv/circuit.hpp"
#include "firmware/mcv/pressure_ratio.hpp"

namespace graben {

struct Requirement {
  double drive_area_m2 = 0.0;       ///< A_in
  double resist_area_m2 = 0.0;      ///< A_out where regeneration is in play, else 0.
  double load_n = 0.0;              ///< L
  double full_opening_n = 0.0;      ///< G^2
  RegenerationDemand regeneration;  ///< The axis' own circuit.
};

/// Lambda below which the machine stands still: 2^-24 = 6.0e-8. [-; paper: Kim et al., Section 5
/// and Theorem 4 (1): epsilon of 1e-7, which Algorithm 1 halves down to in 24 steps]
inline constexpr double kStandstillLambda = 1.0 / 16777216.0;

[[nodiscard]] Requirement no_back_flow(const CircuitAxis& axis);
[[nodiscard]] Requirement spool_travel(const CircuitAxis& axis);

enum class Towards { kSlower, kFaster };  ///< To the right (lambda falls), to the left.

struct Change {
  bool found = false;
  double ratio = 0.0;  ///< r of the change; never beyond it but by rounding.
  int steps = 0;
  bool bounded = true;  ///< False: the fixed number of steps did not get there.
};

/// kSlower: from an r where the requirement fails to the first one to the right where it holds;
/// lambda below kStandstillLambda is not looked at.
/// kFaster: from an r where it holds to the first one to the left where it fails. Not beyond `end`.
///
/// Nothing is skipped. Within a stretch the difference "convex P that must rise over convex Q" is
/// at most chord of P less tangent of Q at the left point: a straight line, below 0 where it
/// starts. Up to its root, or to the chord's end, there can be no change; the search goes there and
/// draws the next line. The chord's length is where Newton would put the change, so that the steps
/// shrink as Newton's do; where P is straight (L > 0, kSlower) this is Newton on a concave
/// function.
[[nodiscard]] Change first_change(const Requirement& requirement, const FlowBalance& line,
                                  Towards towards, double from, double end);

/// Lambda up to which a requirement that holds at standstill, or fails at some lambda, holds where
/// r is the same for every lambda (a stagnant line); infinite if it always holds.
[[nodiscard]] double lambda_at_fixed_ratio(const Requirement& requirement, double ratio);

}  // namespace graben
