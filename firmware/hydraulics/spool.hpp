#pragma once
/// Velocity coefficient of a spool and its cylinder, c_L of (9) and (11).

#include "firmware/machine/valve.hpp"
#include "firmware/numeric/monotone_table.hpp"

namespace graben {

/// c_L at full opening, m/(s sqrt(N)): `inlet_area_m2` is the piston area that the in-flow fills
/// (cap while extending, rod while retracting), `outlet_area_m2` the other one.
[[nodiscard]] double full_opening_velocity_coefficient(const SpoolMetering& metering,
                                                       double spool_in_m2, double spool_out_m2,
                                                       double inlet_area_m2, double outlet_area_m2);

/// c_L against |x|, from closed to x_m, for an area that grows as travel ^ opening_exponent.
/// Points are denser near closed, where the curve bends most.
[[nodiscard]] MonotoneTable velocity_coefficient_table(const SpoolMetering& metering,
                                                       double coefficient_full);

}  // namespace graben
