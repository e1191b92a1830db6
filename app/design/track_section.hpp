// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A surface along a dozer's track: what its blade is to make of it.

#include <optional>
#include <vector>

#include "app/design/surface.hpp"
#include "app/machines/design_file.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::design {

/// Way of the cutting edge's middle in plan.
struct Track {
  Eigen::Vector2d from_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_m = Eigen::Vector2d::Zero();

  [[nodiscard]] double length_m() const { return (to_m - from_m).norm(); }
};

/// Of corners in plan, x and y by turns. Throws std::runtime_error for fewer than two, for a track
/// out of length, and for a bend, which takes a radius.
[[nodiscard]] Track straight_track(const std::vector<double>& corners_m);
/// Throws std::runtime_error unless they are two and more.
void demand_corners(const std::vector<double>& corners_m);
/// Throws std::runtime_error for a track out of length.
void demand_track_length(double length_m);
/// Along x through the middle of what the surface covers.
[[nodiscard]] Track middle_track(const Surface& surface);

/// What a blade and its task allow.
struct BladeAcross {
  double width_m = 0.0;
  double tolerance_m = 0.0;  ///< Of the edge's ends, up or down, against a straight edge.
  bool tilts = false;        ///< Else that edge is level.
};

/// Corners of the surface along the track, from x = 0 on, `datum_m` lower: every edge of a triangle
/// that it crosses. A blade that tilts has the slope between its ends there too. Throws
/// std::runtime_error with the place where the surface has a hole under the track or an end of the
/// blade, more than one height, a slope across it that is more than the ends of a blade that does
/// not tilt are allowed, or a crown or hollow that is more than those of one that does.
[[nodiscard]] machines::DesignLine along_track(const Surface& surface, const Track& track,
                                               double datum_m, const BladeAcross& blade);

}  // namespace graben::design
