// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The ground beside the dozer's middle line, of a machine whose blade tilts.

#include <Eigen/Core>
#include <array>

#include "app/plant/dozer_ground.hpp"

namespace graben::plant {

/// A line of ground below each track's middle and each end of the blade. Each is cut by the point
/// of the edge above it, whose small way across with the tilt is left out.
struct CrossGround {
  /// y to the left, of the four lines.
  enum Line : std::size_t { kLeftEnd, kLeftTrack, kRightTrack, kRightEnd, kLines };

  CrossGround(const Terrain& level, double half_width_m, double half_gauge_m)
      : across_m{half_width_m, half_gauge_m, -half_gauge_m, -half_width_m},
        line{level, level, level, level} {}

  std::array<double, kLines> across_m;
  std::array<Terrain, kLines> line;

  [[nodiscard]] const Terrain& left_track() const { return line[kLeftTrack]; }
  [[nodiscard]] const Terrain& right_track() const { return line[kRightTrack]; }
};

}  // namespace graben::plant
