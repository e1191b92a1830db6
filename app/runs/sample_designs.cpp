// SPDX-License-Identifier: Apache-2.0
#include "app/runs/sample_designs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/plant/random.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::runs {
namespace {

constexpr double kDeep_m = 0.35;
constexpr double kRounding_m = 0.3;

/// A way on from the last corner, to this height.
void go(SampleDesign& design, double way_m, double height_m) {
  design.corners.push_back({design.corners.back().x_m + way_m, height_m});
}

SampleDesign begun(const std::string& name) { return {name, {{0.0, 0.0}}, kRounding_m}; }

/// Every wall as steep as the one of this length that goes down to 0.35 m, but the last: the
/// machine leaves the trench over it.
SampleDesign trench(double wall_m) {
  constexpr double kLedge_m = 0.12;
  constexpr double kWayOut_m = 2.0;
  const double to_ledge_m = wall_m * (kDeep_m - kLedge_m) / kDeep_m;
  SampleDesign design = begun(fmt::format("trench, walls of {} m", wall_m));
  go(design, 4.0, 0.0);
  go(design, wall_m, -kDeep_m);
  go(design, 4.0, -kDeep_m);
  go(design, to_ledge_m, -kLedge_m);
  go(design, 3.2, -kLedge_m);
  go(design, to_ledge_m, -kDeep_m);
  go(design, 4.2, -kDeep_m);
  go(design, std::max(wall_m, kWayOut_m), 0.0);
  go(design, 6.0, 0.0);
  return design;
}

/// Whole waves over 12 m at least; its corners are too near to need rounding.
SampleDesign sine(double wave_m) {
  constexpr double kHigh_m = 0.05;
  constexpr double kStep_m = 0.05;
  constexpr double kAtLeast_m = 12.0;
  constexpr double kLevel_m = 4.0;
  SampleDesign design = begun(fmt::format("sine of {} m", wave_m));
  design.rounding_m = 0.0;
  go(design, kLevel_m, 0.0);
  const double way_m = wave_m * std::ceil(kAtLeast_m / wave_m);
  for (int i = 1; i * kStep_m < way_m; ++i) {
    go(design, kStep_m, -kHigh_m * (1.0 - std::cos(kTwoPi * i * kStep_m / wave_m)));
  }
  go(design, kStep_m, 0.0);
  go(design, kLevel_m, 0.0);
  return design;
}

SampleDesign steps() {
  constexpr int kSteps = 6;
  SampleDesign design = begun("steps of 0.1 m");
  double height_m = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    go(design, 2.8, height_m);
    height_m += i < kSteps / 2 ? -0.1 : 0.1;
    go(design, 0.7, height_m);
  }
  go(design, 4.0, 0.0);
  return design;
}

SampleDesign ditches() {
  SampleDesign design = begun("V, slopes of 0.09 and 0.15");
  go(design, 4.0, 0.0);
  go(design, 4.0, -kDeep_m);
  go(design, 4.0, 0.0);
  go(design, 3.0, 0.0);
  go(design, 2.0, -0.3);
  go(design, 2.0, 0.0);
  go(design, 5.0, 0.0);
  return design;
}

SampleDesign level() {
  SampleDesign design = begun("level");
  go(design, 12.0, 0.0);
  go(design, 13.0, 0.0);
  return design;
}

}  // namespace

std::vector<SampleDesign> sample_designs() {
  return {trench(1.0), trench(1.5), trench(2.0), trench(3.0), sine(3.0), sine(4.0),
          sine(6.0),   sine(16.0),  steps(),     ditches(),   level()};
}

SampleDesign random_design(std::uint64_t seed) {
  constexpr double kLength_m = 20.0;
  constexpr double kLevelShare = 0.2;
  plant::Random random(seed, plant::Draw::kDesign);
  const auto within = [&random](double least, double most) {
    return least + (most - least) * random.uniform();
  };
  SampleDesign design = begun(fmt::format("random {}", seed));
  // Half of them gentle, half as steep as a design may be.
  const double steepest = random.uniform() < 0.5 ? 0.40 : 0.58;
  const double shortest_m = steepest < 0.5 ? 0.8 : 0.65;
  go(design, within(2.0, 4.0), 0.0);
  while (design.corners.back().x_m < kLength_m) {
    const double way_m = within(shortest_m, 4.0);
    const double last_m = design.corners.back().z_m;
    const double height_m = within(std::max(-kDeep_m, last_m - steepest * way_m),
                                   std::min(0.0, last_m + steepest * way_m));
    go(design, way_m, random.uniform() < kLevelShare ? last_m : height_m);
  }
  go(design, 4.0, design.corners.back().z_m);
  return design;
}

}  // namespace graben::runs
