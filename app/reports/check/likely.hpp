// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a profile by itself makes unlikely, of the class that its geometry says it is.

#include "app/reports/check/warnings.hpp"

namespace graben::reports {

/// Masses, forces, pressures, speeds, volumes, stiffness and flows against geometry and class.
void expect_likely(Warnings& warnings, const ExcavatorProfile& profile);
/// Of these oil, valve and pumps.
void expect_likely_hydraulics(Warnings& warnings, const ExcavatorProfile& profile);
void expect_likely(Warnings& warnings, const DozerProfile& profile);
/// Where the simulation's file names another machine: that it has this one's geometry.
void expect_same_machine(Warnings& warnings, const machines::SimulatedExcavator& machine);

}  // namespace graben::reports
