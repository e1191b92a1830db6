#pragma once
/// What the gates let through of one setpoint: in range, and no faster than its rate.

#include "firmware/numeric/monotone_table.hpp"

namespace graben {

/// `wanted` after `last`, rising in magnitude by at most `change_max`. Only the way from zero is
/// limited: towards zero, and through it on a reversal, it may always go at once.
[[nodiscard]] double limited(double wanted, double last, double change_max);

/// Signed duty, -1 .. 1, of an opening, -1 .. 1: after `opening_to_duty`, which has magnitudes, and
/// neutral below `threshold`.
[[nodiscard]] double spool_duty(const MonotoneTable& opening_to_duty, double threshold,
                                double opening);

}  // namespace graben
