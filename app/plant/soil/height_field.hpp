// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The ground as a height field: undisturbed soil, and loose soil on it.

#include <vector>

#include "app/plant/soil/soil_kind.hpp"

namespace graben::plant {

/// Height at which a wall of undisturbed soil falls, m: 2 c / (rho g) sqrt(K_p), half of what
/// Rankine's theory gives for a dry one (tension cracks), and 0 without cohesion.
[[nodiscard]] double standing_height_m(const SoilKind& soil, double gravity_mps2);

/// What was taken out of the ground, m^3 as it lay there.
struct TakenSoil {
  double firm_m3 = 0.0;
  double loose_m3 = 0.0;
};

/// A square of cells about the swing axis, level at height 0 in the beginning; beyond it the ground
/// is level and hard. Heights in m over that level, x forward, y left.
class HeightField {
 public:
  static constexpr double kCell_m = 0.05;

  HeightField(const SoilKind& soil, double half_side_m, double gravity_mps2);

  /// Of the surface, between cells as between their centres.
  [[nodiscard]] double height_m(double x_m, double y_m) const;
  /// Of the undisturbed soil, in the cell there.
  [[nodiscard]] double firm_m(double x_m, double y_m) const;
  [[nodiscard]] double loose_m(double x_m, double y_m) const;

  /// Takes what is above this height out of the cell there.
  TakenSoil cut(double x_m, double y_m, double to_m);
  /// Presses the cell's surface down to this height: loose soil first, no volume leaves.
  void press(double x_m, double y_m, double to_m);
  /// Puts loose soil on the cell there; beyond the square it is lost.
  void heap(double x_m, double y_m, double loose_m3);

  /// Lets loose soil slide where it is steeper than its angle of repose, and walls of undisturbed
  /// soil fall that are higher than it stands, one sweep over the cells within `reach_m` of a
  /// place. Several sweeps bring it to rest.
  void settle(double x_m, double y_m, double reach_m);

  /// Whole volume over (above 0) and below the level ground, m^3 of loose and of firm soil.
  [[nodiscard]] double loose_m3() const;
  [[nodiscard]] double firm_change_m3() const;

 private:
  struct Cell {
    float firm_m = 0.0F;
    float loose_m = 0.0F;
    [[nodiscard]] double top_m() const {
      return static_cast<double>(firm_m) + static_cast<double>(loose_m);
    }
  };
  [[nodiscard]] int index(double along_m) const;
  [[nodiscard]] bool is_inside(int i, int j) const {
    return i >= 0 && j >= 0 && i < side_ && j < side_;
  }
  [[nodiscard]] Cell& at(int i, int j) {
    return cell_[static_cast<std::size_t>(j) * static_cast<std::size_t>(side_) +
                 static_cast<std::size_t>(i)];
  }
  [[nodiscard]] const Cell& at(int i, int j) const {
    return const_cast<HeightField*>(this)->at(i, j);
  }
  [[nodiscard]] double top_m(int i, int j) const {
    return is_inside(i, j) ? at(i, j).top_m() : 0.0;
  }
  void slide(Cell& from, Cell& to) const;
  void fall(Cell& from, const Cell& below, double away_m) const;

  SoilKind soil_;
  int side_;  ///< Cells.
  double repose_step_m_;
  double stands_m_;
  double wall_slope_;  ///< tan(phi): what a wall may be higher for standing farther away.
  std::vector<Cell> cell_;
};

}  // namespace graben::plant
