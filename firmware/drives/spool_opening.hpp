#pragma once
/// From a spool's travel to its opening and back, by the table of its side.

#include "firmware/machine/spool_answer.hpp"

namespace graben {

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
