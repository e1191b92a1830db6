// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A design of heights on a grid that follows a function.

#include <cmath>
#include <vector>

#include "firmware/excavator/fences/fence.hpp"

namespace graben::test {

/// A square of 24 m about the machine, turned against it.
struct GridGround {
  static constexpr int kSide = 481;
  static constexpr double kStep_m = 0.05;
  std::vector<std::int16_t> height;
  DesignSurface surface;

  /// `height_m(x, y)` in the machine's ground frame; not a number: no design.
  template <class Height>
  explicit GridGround(Height height_m, double turn_rad = 0.4) : height(kSide * kSide) {
    surface.height = height.data();
    surface.columns = surface.rows = kSide;
    surface.step_m = kStep_m;
    surface.base_m = -0.25;
    surface.machine_m.setConstant(0.5 * kStep_m * (kSide - 1));
    surface.cosine = std::cos(turn_rad);
    surface.sine = std::sin(turn_rad);
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        const Eigen::Vector2d off_m = kStep_m * Eigen::Vector2d(column, row) - surface.machine_m;
        const double z_m = height_m(surface.cosine * off_m.x() + surface.sine * off_m.y(),
                                    surface.cosine * off_m.y() - surface.sine * off_m.x());
        height[static_cast<std::size_t>(row * kSide + column)] =
            std::isnan(z_m) ? DesignSurface::kNone
                            : static_cast<std::int16_t>(
                                  std::lround((z_m - surface.base_m) / DesignSurface::kUnit_m));
      }
    }
  }
  GridGround(const GridGround&) = delete;
  GridGround& operator=(const GridGround&) = delete;

  [[nodiscard]] FenceSet fences() const {
    FenceSet set;
    set.count = 1;
    set.fence[0] = surface_fence(surface);
    return set;
  }
};

}  // namespace graben::test
