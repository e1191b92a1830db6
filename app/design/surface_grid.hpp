// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Heights on an even grid of a surface of triangles, for a machine that has no room for those.

#include <optional>
#include <string>

#include "app/design/surface.hpp"
#include "app/machines/height_grid.hpp"

namespace graben::design {

/// What of a surface is wanted.
struct GridCut {
  double step_m = 0.05;
  /// The middle of a square in plan and half of its side; none: all of the surface.
  std::optional<Eigen::Vector2d> around_m;
  double half_m = 15.0;
};

/// Each height is the surface's at its place; where there is no face there is none. Throws
/// std::runtime_error where it would be more than machines::kMostCells, where none of the surface
/// is in the square, or where two faces have other heights at a place.
[[nodiscard]] machines::HeightGrid grid_of(const Surface& surface, const GridCut& cut);

/// Of a surface by its triangles, one after the other; not a number where it has none.
[[nodiscard]] double height_at(const Surface& surface, const Eigen::Vector2d& place_m);

/// As an ESRI ASCII grid.
[[nodiscard]] std::string ascii_grid_text(const machines::HeightGrid& grid);

}  // namespace graben::design
