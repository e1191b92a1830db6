// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a profile by itself makes unlikely, of the class that its geometry says it is.

#include "app/reports/check/warnings.hpp"

namespace graben::reports {

/// What is usual, in the unit of what it is of.
struct Band {
  double least;
  double most;
};

/// Masses, forces, pressures, speeds, volumes, stiffness and flows against geometry and class.
void expect_likely(Warnings& warnings, const ExcavatorProfile& profile);
void expect_likely(Warnings& warnings, const DozerProfile& profile);
/// An excavator's oil, valve and pumps by themselves; expect_likely() has them too.
void expect_likely_hydraulics(Warnings& warnings, const ExcavatorProfile& profile);
/// Where the simulation's file names another machine: that it has this one's geometry.
void expect_same_machine(Warnings& warnings, const machines::SimulatedExcavator& machine);

}  // namespace graben::reports
