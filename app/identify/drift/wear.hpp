// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What wears in a cylinder and no profile has: how it creeps while its valve is closed, and its
/// friction.

#include <cstddef>
#include <vector>

#include "app/identify/machine/estimate.hpp"
#include "app/identify/machine/machine_log.hpp"
#include "app/identify/machine/steady_points.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::identify {

/// m/(s Pa): so fast the piston goes to the chamber of less pressure while its duty is 0, by what
/// is left when the oil's own give under changing pressures is taken away. Not `known` where it did
/// not stand for 20 s in all, without 1 MPa of difference, or where it goes the other way.
[[nodiscard]] Estimate find_creep(const MachineLog& log, std::size_t axis);

/// N: half of what steady motion one way takes more than the other at the same pose. Not `known`
/// where it was not driven both ways.
[[nodiscard]] Estimate find_friction(const std::vector<SteadyPoint>& points,
                                     const ExcavatorGeometry& geometry, std::size_t axis);

}  // namespace graben::identify
