// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A design surface that is no plane: heights on an even grid over a plan, in the memory of whoever
/// read them. The grid may lie turned against the machine, as a site's does. Heights are known
/// between four known cells and nowhere else: what lies beyond the border has none.

#include <Eigen/Core>
#include <cstdint>

#include "firmware/excavator/fences/machine_points.hpp"
#include "firmware/excavator/fences/tuning.hpp"

namespace graben {

/// Height and slope of a surface at one place, in the ground frame of swing_kinematics.hpp.
struct SurfacePlace {
  bool known = false;  ///< Else there is no design here, and the rest says nothing.
  double height_m = 0.0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< dz/dx and dz/dy.

  /// Of length 1, out of the ground.
  [[nodiscard]] Eigen::Vector3d up() const {
    return Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
  }
};

/// Where the surface is met: after `time_s` on, against its normal `up`.
struct SurfaceContact {
  bool met = false;
  double time_s = 0.0;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

struct DesignSurface {
  /// Of one count of a height. [m; size: +-16 m about `base_m`, which an arm does not reach, to
  /// half a millimetre]
  static constexpr double kUnit_m = 0.5e-3;
  /// A cell without a height. [-; standard: layout of the heights]
  static constexpr std::int16_t kNone = INT16_MIN;
  /// Columns, and rows, at most. [-; size: so that a cell's number is an int's with room to spare]
  static constexpr int kMostSide = 8192;

  const std::int16_t* height = nullptr;  ///< Row after row, `columns` in each; the owner's.
  int columns = 0;
  int rows = 0;
  double step_m = 0.0;
  double base_m = 0.0;  ///< Height in the ground frame where a cell's is 0.
  /// The machine's place in the grid, from its first cell along columns and rows, and the direction
  /// of the machine's x axis there.
  Eigen::Vector2d machine_m = Eigen::Vector2d::Zero();
  double cosine = 1.0;
  double sine = 0.0;

  /// Height alone at a place of the ground frame; false: there is none, and it stays as it was.
  [[nodiscard]] bool height_at(double x_m, double y_m, double& height_m) const;

  /// At a place of the ground frame: between its cell's four corners, bilinear.
  [[nodiscard]] SurfacePlace at(const Eigen::Vector2d& place_m) const;

  /// Of a point that goes on as it moves, until kSurfaceAhead_s; heights are seen `zero_m` too
  /// high. A point that is deeper than that already meets it where it would get deeper.
  [[nodiscard]] SurfaceContact ahead(const PointMotion& point, double zero_m) const;

  /// Its numbers can be those of a surface.
  [[nodiscard]] bool usable() const;

 private:
  /// Four heights round a place, in counts, and where it is between them.
  struct Cell {
    int near;
    int near_next;
    int far;
    int far_next;
    double u;
    double v;

    [[nodiscard]] double height() const {
      const double on_near = near + u * (near_next - near);
      return on_near + v * (far + u * (far_next - far) - on_near);
    }
  };
  [[nodiscard]] bool cell_at(double x_m, double y_m, Cell& cell) const;
};

}  // namespace graben
