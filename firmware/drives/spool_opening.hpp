// SPDX-License-Identifier: Apache-2.0
#pragma once
/// From a spool's travel to its opening and back, by the table of its side.

#include "firmware/machine/spool_answer.hpp"

namespace graben {

/// Both sides alike and straight: open from a duty of `edge` (less than 1) to the whole of it.
[[nodiscard]] SpoolAnswers straight_answers(double edge, double dead_time_s, double lag_s);

/// Opening of a spool that is `travel_ratio` (0 .. 1) from its middle. Below 0 in the dead band, by
/// shares of the travel outside of it.
[[nodiscard]] double opening_at(const SpoolAnswer& answer, double travel_ratio);

/// Its inverse: the duty of an opening.
[[nodiscard]] double duty_at(const SpoolAnswer& answer, double opening);

/// Least way, as a share of the travel, that a spool goes for a whole opening, by the steepness of
/// its table anywhere from `least_ratio` to `most_ratio`.
[[nodiscard]] double least_travel_per_opening(const SpoolAnswer& answer, double least_ratio,
                                              double most_ratio);

}  // namespace graben
