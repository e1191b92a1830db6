// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Lines whose pump sets its own swash (PumpRegulator): which pressure they have, and how far that
/// lets their spools open. Kim et al. have pumps that give what they are told.
///
/// Load sensing. The regulator holds the line a margin above the heaviest load, felt behind the
/// metering edge: at the heaviest drive that edge has the margin m, whatever its opening. Both
/// edges of a spool open alike, so a fixed share w of the drive force F_s - F_L of (42) is lost at
/// the draining one, and the margin at the metering one stands for
///   M = A_in m / (1 - w).
/// So the line has the least pressure at which every drive that moves has its M, at least m, and no
/// more than the pump can hold at full swash or its cut-off, the relief's pressure. A compensator
/// leaves each drive its M and no more.
///
/// Negative flow. The pressure before the bypass' last orifice c_N is p_N = P (c_by / c_N)^2, and
/// the swash falls evenly from full at p_full to least at p_least: between the two the flow falls
/// as with a linear leakage. The line has the most of what the least flow holds, and the lesser of
/// what full flow and the falling one hold.
///
/// Its bypass closes with the spools' openings, and those fall as the pressure rises. At a lambda
/// there is one pressure where both agree, since all that then leaves the line grows with it. What
/// a lambda needs at most is a spool fully open, and then the bypass is closed: whether a lambda is
/// feasible, the closed bypass says.
///
/// Where a load draws more oil than the line presses in, the fed side runs dry: it has tank's
/// pressure, and the draining edge alone brakes.

#include "firmware/mcv/evaluation.hpp"

namespace graben {

/// Pressure of a line, whatever sets its pump, at lambda in (0, 1]. `guess` as of
/// solve_pump_pressure.
[[nodiscard]] PumpPressure line_pressure(const McvCircuit& circuit, unsigned pump, double lambda,
                                         double guess = kInfinity);

/// The most that a pump can hold in its line, were a load heavy enough to ask for it; lambda 0 too.
[[nodiscard]] PumpPressure most_pressure(const FlowBalance& line, double lambda);

/// Pressures and drive forces of a feasible point with the bypasses as its spools leave them; those
/// of other lines stay. And how each drive of such a line then gives way to its load: with
/// Y = -dQ/dP of pump and bypass, and c = v / (2 F) of its edges, Q = A v makes of v = C sqrt(F),
/// F = A P - F_L
///   -dv / dF_L = c Y / (Y + A^2 c),
/// the other drives of the line as they are.
void settle_bypasses(const McvCircuit& circuit, McvPoint& point);

/// As needed_coefficient, also where the fed side runs dry.
[[nodiscard]] double regulated_coefficient(const CircuitAxis& axis, double lambda,
                                           const DriveForce& drive);

}  // namespace graben
