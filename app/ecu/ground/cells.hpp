// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ground on a grid of cells seen from above, and what an edge that passes makes of one.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/ecu/ground/edge_place.hpp"

namespace graben::ground {

struct Cell {
  double lowest_m = 0.0;
  double lowest_s = 0.0;  ///< When; see EdgeStep.
  double newest_m = 0.0;  ///< Lowest of the last pass.
  double newest_s = 0.0;
  std::uint32_t passes = 0;  ///< 0: nobody has made it.
};

/// A cell by its number along x and y; its centre is half a cell on.
struct CellPlace {
  std::int32_t i = 0;
  std::int32_t j = 0;
};

/// Passes over a cell are two where no less lies between them, s.
inline constexpr double kPass_s = 1.0;

/// Whether the edge that passes at this height makes ground of the cell: where it was at work, or
/// where it went below ground that is known there, as it can only have cut that.
[[nodiscard]] inline bool makes_ground(const Cell& cell, double height_m, bool at_work) {
  return at_work || (cell.passes > 0 && height_m < cell.lowest_m);
}

/// It does, at this time.
inline void pass_over(Cell& cell, double height_m, double time_s) {
  const bool is_first = cell.passes == 0;
  // A clock that was set back begins a pass too.
  const bool is_new = is_first || time_s - cell.newest_s > kPass_s || time_s < cell.newest_s;
  cell.newest_m = is_new ? height_m : std::min(cell.newest_m, height_m);
  cell.newest_s = time_s;
  cell.passes += is_new ? 1 : 0;
  if (is_first || height_m < cell.lowest_m) {
    cell.lowest_m = height_m;
    cell.lowest_s = time_s;
  }
}

/// Of two records of a cell: the lowest of both, the newest of both.
[[nodiscard]] inline Cell joined(const Cell& one, const Cell& other) {
  if (one.passes == 0 || other.passes == 0) {
    return one.passes == 0 ? other : one;
  }
  Cell both = other.newest_s > one.newest_s ? other : one;
  const Cell& low = other.lowest_m < one.lowest_m ? other : one;
  both.lowest_m = low.lowest_m;
  both.lowest_s = low.lowest_s;
  both.passes = std::max(one.passes, other.passes);
  return both;
}

/// Twice the area of a triangle that is none, seen from above, m^2.
inline constexpr double kNoArea_m2 = 1e-12;
/// So much of a triangle's height outside of it a centre is on its side, which the next one shares.
inline constexpr double kOnSide = 1e-9;

/// Calls `take` with each cell whose centre is in the triangle, seen from above, and the height of
/// the triangle there. A triangle that stands upright has none. Allocates nothing.
template <class Take>
void over_cells(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                double grid_m, const Take& take) {
  const auto cross = [](const Eigen::Vector3d& from, const Eigen::Vector3d& to, double x_m,
                        double y_m) {
    return (to.x() - from.x()) * (y_m - from.y()) - (to.y() - from.y()) * (x_m - from.x());
  };
  const double area_m2 = cross(a, b, c.x(), c.y());
  if (!(std::abs(area_m2) > kNoArea_m2)) {
    return;
  }
  const auto first = [grid_m](double least_m) {
    return static_cast<std::int32_t>(std::ceil(least_m / grid_m - 0.5));
  };
  const auto last = [grid_m](double most_m) {
    return static_cast<std::int32_t>(std::floor(most_m / grid_m - 0.5));
  };
  const std::int32_t i0 = first(std::min({a.x(), b.x(), c.x()}));
  const std::int32_t i1 = last(std::max({a.x(), b.x(), c.x()}));
  const std::int32_t j0 = first(std::min({a.y(), b.y(), c.y()}));
  const std::int32_t j1 = last(std::max({a.y(), b.y(), c.y()}));
  for (std::int32_t j = j0; j <= j1; ++j) {
    const double y_m = grid_m * (j + 0.5);
    for (std::int32_t i = i0; i <= i1; ++i) {
      const double x_m = grid_m * (i + 0.5);
      const double of_a = cross(b, c, x_m, y_m) / area_m2;
      const double of_b = cross(c, a, x_m, y_m) / area_m2;
      const double of_c = cross(a, b, x_m, y_m) / area_m2;
      if (std::min({of_a, of_b, of_c}) >= -kOnSide) {
        take(CellPlace{i, j}, of_a * a.z() + of_b * b.z() + of_c * c.z());
      }
    }
  }
}

/// The same of the ground that a step goes over.
template <class Take>
void over_cells(const EdgeStep& step, double grid_m, const Take& take) {
  over_cells(step.from.left_m, step.from.right_m, step.to.right_m, grid_m, take);
  over_cells(step.from.left_m, step.to.right_m, step.to.left_m, grid_m, take);
}

}  // namespace graben::ground
