// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The shipped dozer for tests of the core.

#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "firmware/dozer/travel/ground_map.hpp"

namespace graben::test {

/// Read once; a profile that can't be loaded ends the test program with its errors.
inline const machines::SimulatedDozer& dozer() {
  static const machines::SimulatedDozer machine =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  return machine;
}

/// A design of a single level.
inline GradeDesign level(double height_m) {
  GradeDesign design;
  design.point[0] = {-100.0, height_m};
  design.point[1] = {100.0, height_m};
  design.count = 2;
  return design;
}

/// Level 0, from x = 10 on a slope.
inline GradeDesign bend(double slope, double rounding_m) {
  GradeDesign design;
  design.point[0] = {0.0, 0.0};
  design.point[1] = {10.0, 0.0};
  design.point[2] = {60.0, 50.0 * slope};
  design.count = 3;
  design.rounding_m = rounding_m;
  return design;
}

/// Level 0, from x = 10 on a slope, and level again 0.22 m lower, which the blade reaches well.
inline GradeDesign ledge(double slope, double rounding_m) {
  GradeDesign design = bend(slope, rounding_m);
  design.point[2] = {10.0 - 0.22 / slope, -0.22};
  design.point[3] = {60.0, -0.22};
  design.count = 4;
  return design;
}

/// Cut to this design, the edge being 2.3 m before a machine at `x_m`.
inline GroundMap cut_to(const GradeProfile& design, double x_m) {
  GroundMap ground;
  for (double edge_m = -2.0; edge_m < x_m + 2.3; edge_m += 0.02) {
    ground.pass(edge_m, design.at(edge_m).height_m, design, -4.3, 0.0, 0.0);
  }
  return ground;
}

}  // namespace graben::test
