// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Map of the ground around the machine: as it was before, cut where the blade has been, and the
/// design where it has still to go.

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/dozer/grade_profile.hpp"
#include "firmware/dozer/travel/tuning.hpp"

namespace graben {

/// The last line of a grid of `step_m`, the first at `first_m`, that is not beyond x. Not finite is
/// no place: that of x = 0.
[[nodiscard]] inline int grid_index(double x_m, double step_m, double first_m) {
  const double x = std::isfinite(x_m) ? std::clamp(x_m, -kFurthest_m, kFurthest_m) : 0.0;
  const double lines = (x - first_m) / step_m;
  const int below_or_above = static_cast<int>(lines);  // towards 0; std::floor may be a call
  return below_or_above - (lines < below_or_above ? 1 : 0);
}

/// Heights on a grid along x. It remembers kLength_m behind the furthest place that the cutting
/// edge has reached; nothing of it is allocated, nothing is searched.
class GroundMap {
 public:
  /// Cells of the map. [-; size: room for kLength_m of ground]
  static constexpr int kCells = 640;
  /// Ground that the map remembers. [m; derived: kCells of kGroundCell_m]
  static constexpr double kLength_m = kCells * kGroundCell_m;

  /// The machine stands with its origin at `stand_x_m`, its tracks on a line of this height there
  /// and of this slope, and the cutting edge has come to (x, z). Every cell that the edge has
  /// passed since is now at most as high as its way; a step back changes nothing. Where the edge is
  /// `held_clear` of the ground, or clearly above the design, it cuts nothing: what lies below is
  /// then what it was, and where the edge has never been, the line that the tracks stand on. The
  /// first time, and after a jump of more than the map's length, all is that line.
  void pass(double edge_x_m, double edge_z_m, const GradeProfile& design, double stand_x_m,
            double stand_z_m, double slope, bool held_clear = false);

  /// The edge stands here, and what lies before it is to be cut again: the design from there on.
  /// What lies behind it stays as it was left.
  void turn_back(double edge_x_m);

  /// Ground at x: remembered behind the edge, `design` before it. Further back than it remembers,
  /// the last that it does.
  [[nodiscard]] double height_m(double x_m, const GradeProfile& design) const;

 private:
  /// Heights of a straight line over all cells up to the edge.
  void start(double edge_x_m, double stand_x_m, double stand_z_m, double slope);
  /// The last one whose middle is not beyond x.
  [[nodiscard]] static int cell_of(double x_m) {
    return grid_index(x_m, kGroundCell_m, 0.5 * kGroundCell_m);
  }
  /// Offset that makes an index of a cell positive. [-; size: whole turns of the ring, further than
  /// kFurthest_m, as the assertion below says]
  static constexpr int kTurns = 50'000 * kCells;
  static_assert(kTurns * kGroundCell_m > kFurthest_m + kLength_m);
  [[nodiscard]] static unsigned slot(int index) {
    return static_cast<unsigned>(index + kTurns) % kCells;
  }
  [[nodiscard]] double cell(int index) const { return height_m_[slot(index)]; }
  void set(int index, double height_m) { height_m_[slot(index)] = height_m; }

  std::array<double, kCells> height_m_{};
  int oldest_ = 0;  ///< First cell that is remembered.
  int front_ = 0;   ///< Last cell whose middle the edge has passed, in this pass.
  int known_ = 0;   ///< The same in any.
  double edge_x_m_ = 0.0;
  double edge_z_m_ = 0.0;
  bool started_ = false;
};

}  // namespace graben
