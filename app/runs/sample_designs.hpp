// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Designs that a dozer is measured on, beside the one of its profile.

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/dozer/dozer_profile.hpp"

namespace graben::runs {

/// Corners along the track, level at 0 at its start, and how far each is rounded.
struct SampleDesign {
  std::string name;
  std::vector<GradePoint> corners;
  double rounding_m = 0.0;
};

/// The paper's trench with walls of 1, 1.5, 2 and 3 m, sine ground of 0.1 m with waves of 3, 4, 6
/// and 16 m, steps of 0.1 m, two ditches with slopes alone, and level ground.
[[nodiscard]] std::vector<SampleDesign> sample_designs();

/// Drawn from the seed: pieces of 0.65 to 4 m, level or with slopes up to 0.58, down to 0.35 m.
[[nodiscard]] SampleDesign random_design(std::uint64_t seed);

}  // namespace graben::runs
