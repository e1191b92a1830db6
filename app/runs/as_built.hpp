// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What became of the ground that a task was to bring to its design.

#include <array>
#include <vector>

#include "app/plant/soil/height_field.hpp"
#include "app/runs/figures.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::runs {

/// A place of the area, as it is.
struct BuiltPlace {
  std::array<double, 2> at_m{};  ///< Ground frame, seen from above.
  double off_m = 0.0;   ///< Surface, loose soil and all, over the design; along its normal.
  double firm_m = 0.0;  ///< The same of the ground that nobody has cut.
};

/// Not a number without an area, or without ground that is cut.
struct AsBuilt {
  double area_m2 = kAbsent;
  double within_ratio = kAbsent;  ///< Share of the area that is within kBuilt_m of the design.
  double high_m = kAbsent;        ///< 95 % of the area is no higher than this,
  double low_m = kAbsent;         ///< and no lower than this.
  double median_m = kAbsent;
  double left_m3 = kAbsent;      ///< Over the design.
  double over_cut_m3 = kAbsent;  ///< Under it.
  std::vector<BuiltPlace> map;   ///< Places of a grid along the cuts.
};

inline constexpr double kBuilt_m = 0.03;
/// From place to place, at most.
inline constexpr double kBuiltGrid_m = 0.05;

/// Of the area under the cuts of a program in layers: every strip as wide as the bucket, but for
/// its rims, where the walls fall in.
[[nodiscard]] AsBuilt as_built(const TaskProgram& program, const plant::HeightField& ground);

}  // namespace graben::runs
