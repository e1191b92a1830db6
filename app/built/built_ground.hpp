// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ground as a machine's edge has left it, by itself and against a design.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "app/built/cell_grid.hpp"
#include "app/design/surface.hpp"

namespace graben::built {

/// A cell that the edge has made.
struct BuiltPoint {
  CellPlace cell;
  Eigen::Vector3d at_m = Eigen::Vector3d::Zero();  ///< Centre, and the height that counts.
  double time_s = 0.0;                             ///< When the edge was there, as the log has it.
  double lowest_m = 0.0;
  double newest_m = 0.0;
  std::uint32_t passes = 0;
  /// Of that height over the design; not a number where that does not reach.
  double off_m = std::numeric_limits<double>::quiet_NaN();
};

struct BuiltGround {
  double grid_m = 0.0;
  std::vector<BuiltPoint> point;  ///< In the order of y, then x.
  /// Triangles between the centres of cells that are neighbours, by their places in `point`, from
  /// above against the clock.
  std::vector<std::array<std::uint32_t, 3>> face;

  [[nodiscard]] double area_m2() const {
    return grid_m * grid_m * static_cast<double>(point.size());
  }
};

/// Which of a cell's heights counts.
enum class BuiltHeight { kLowest, kNewest };

[[nodiscard]] BuiltGround built_ground(const CellGrid& grid, BuiltHeight height);

/// Cells whose newest pass is kFallen_m and more over the lowest.
[[nodiscard]] std::size_t fallen_in(const BuiltGround& ground);

/// Ground against its design, of the cells that lie on it.
struct DesignFigures {
  std::size_t cells = 0;
  double area_m2 = 0.0;
  double outside_m2 = 0.0;  ///< Of the ground, where there is no design.
  double rms_m = 0.0;
  double p95_m = 0.0;  ///< 95 % are no farther off, up or down.
  double highest_m = 0.0;
  double lowest_m = 0.0;  ///< Below 0 where ground is under the design.
  double within_ratio = 0.0;
  double cut_m3 = 0.0;   ///< Over the design: still to be cut.
  double fill_m3 = 0.0;  ///< Under it: to be filled.
};

/// Sets each point's `off_m`. Throws std::runtime_error where the design has two heights over one
/// of them, with the place, or lies under none.
void lay_over(const design::Surface& design, BuiltGround& ground);
[[nodiscard]] DesignFigures design_figures(const BuiltGround& ground, double tolerance_m);

}  // namespace graben::built
