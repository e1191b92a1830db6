// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The last gate before the bus: what it lets through is finite, in range, rate-limited and
/// enabled, whatever computed it.

#include "firmware/core/guarded.hpp"
#include "firmware/machine/drive_bank.hpp"

namespace graben {

/// `wanted` after `last`, rising in magnitude by at most `change_max`. Only the way from zero is
/// limited: towards zero, and through it on a reversal, it may always go at once.
[[nodiscard]] double slew_limited(double wanted, double last, double change_max);

/// Of the whole bank.
struct GateResult {
  bool enable = false;
  Fault fault = Fault::kNone;  ///< kCommandNotFinite or kMemoryCorrupt when it had to refuse.
};

/// Spool positions -> signed duties, -1 .. 1, of each row; `opening` keeps x / x_m that was let
/// through from cycle to cycle. Not active, or any position not finite, or a stored opening that
/// differs from its complement: neutral in this cycle, enable withdrawn. Otherwise x / x_m is
/// clamped to +-1, opens by at most spool_rate_ps (closing is never delayed), and is kept at
/// neutral below spool_threshold; the duty then follows the spool_to_duty of its side. `period_s`
/// is the time since the last cycle. What lies in `opening` and `duty_ratio` beyond the rows is set
/// to neutral too.
[[nodiscard]] GateResult gate_drives(DriveRows drives, bool active, Span<const double> spool_m,
                                     double period_s, Span<Guarded<double>> opening,
                                     Span<double> duty_ratio);

/// Largest rise of a duty that is tried, of its whole range per second: full within 40 ms, a step
/// to whoever looks at a drive's answer.
inline constexpr double kTriedDutyRate_ps = 25.0;

/// The same of duties that are tried as they are, on valves of which nothing is known: `sent` keeps
/// what was let through.
[[nodiscard]] GateResult gate_duties(DriveRows drives, bool active, Span<const double> wanted_ratio,
                                     double period_s, Span<Guarded<double>> sent,
                                     Span<double> duty_ratio);

}  // namespace graben
