// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The last gate before the bus: what it lets through is finite, in range, rate-limited and
/// enabled, whatever computed it. Nothing writes a duty after it. And the spools' opening before
/// it, which is limited in its own rate.

#include "firmware/machine/drive_bank.hpp"

namespace graben {

/// `wanted` after `last`, rising in magnitude by at most `change_max`. Only the way from zero is
/// limited: towards zero, and through it on a reversal, it may always go at once.
[[nodiscard]] double slew_limited(double wanted, double last, double change_max);

/// Spool positions -> signed duties, -1 .. 1, of each row; `opening` keeps x / x_m from cycle to
/// cycle. x / x_m is clamped to +-1, opens by at most spool_rate_ps (closing is never delayed), and
/// is kept at neutral below spool_threshold; the duty then follows the spool_to_duty of its side.
/// `period_s` is the time since the last cycle. A position that is not finite makes a duty that is
/// not, which the gate refuses.
void open_spools(DriveRows drives, Span<const double> spool_m, double period_s,
                 Span<double> opening, Span<double> duty_ratio);

/// Duties that are tried as they are, on valves of which nothing is known, after those that were
/// `sent`.
void step_duties(DriveRows drives, Span<const double> tried_ratio, double period_s,
                 Span<const double> sent, Span<double> duty_ratio);

/// Of the whole bank.
struct GateResult {
  bool enable = false;
  Fault fault = Fault::kNone;  ///< kCommandNotFinite when it had to refuse.
};

/// Duties as they are wanted on the wire -> as they may go there; `sent` keeps those. Not active,
/// or any duty not finite: neutral in this cycle, enable withdrawn. Otherwise each is clamped to
/// +-1 and rises in magnitude by at most duty_rate_ps; towards zero, and through it, it may go at
/// once. `period_s` is the time since the last cycle. What lies in `sent` and `duty_ratio` beyond
/// the rows is set to neutral where all is.
[[nodiscard]] GateResult gate_duties(DriveRows drives, bool active, Span<const double> wanted_ratio,
                                     double period_s, Span<double> sent, Span<double> duty_ratio);

}  // namespace graben
