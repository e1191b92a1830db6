// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/fences/design_surface.hpp"

#include <algorithm>
#include <cmath>

namespace graben {

SurfacePlace DesignSurface::at(const Eigen::Vector2d& place_m) const {
  const double per_m = 1.0 / step_m;
  const double along = per_m * (machine_m.x() + cosine * place_m.x() - sine * place_m.y());
  const double across = per_m * (machine_m.y() + sine * place_m.x() + cosine * place_m.y());
  SurfacePlace result;
  // Written so that what is not a number is beyond the border.
  if (!(along >= 0.0 && across >= 0.0 && along < columns - 1 && across < rows - 1)) {
    return result;
  }
  const int column = static_cast<int>(along);
  const int row = static_cast<int>(across);
  const std::int16_t* const near = height + row * columns + column;
  const std::int16_t* const far = near + columns;
  if (near[0] == kNone || near[1] == kNone || far[0] == kNone || far[1] == kNone) {
    return result;
  }
  const double u = along - column;
  const double v = across - row;
  const double rise_near = near[1] - near[0];
  const double rise_far = far[1] - far[0];
  const double on_near = near[0] + u * rise_near;
  const double on_far = far[0] + u * rise_far;
  const double slope_along = kUnit_m * per_m * (rise_near + v * (rise_far - rise_near));
  const double slope_across = kUnit_m * per_m * (on_far - on_near);
  result.known = true;
  result.height_m = base_m + kUnit_m * (on_near + v * (on_far - on_near));
  result.slope = {cosine * slope_along + sine * slope_across,
                  cosine * slope_across - sine * slope_along};
  return result;
}

SurfaceContact DesignSurface::ahead(const PointMotion& point, double zero_m) const {
  SurfaceContact contact;
  double before_m = 0.0;
  double free_m = 0.0;
  for (int i = 0; i <= kSurfaceAheadSteps; ++i) {
    const double time_s = kSurfaceAhead_s * i / kSurfaceAheadSteps;
    const Eigen::Vector3d then_m = point.position_m + time_s * point.velocity_mps;
    const SurfacePlace place = at(then_m.head<2>());
    if (!place.known) {
      return contact;
    }
    const double over_m = then_m.z() - zero_m - place.height_m;
    if (i == 0) {
      free_m = std::min(0.0, over_m) - kSurfaceDeeper_m;
    } else if (over_m < free_m) {
      const double share = (before_m - free_m) / (before_m - over_m);
      contact = {true, time_s - (1.0 - share) * kSurfaceAhead_s / kSurfaceAheadSteps, place.up()};
      return contact;
    }
    before_m = over_m;
  }
  return contact;
}

bool DesignSurface::usable() const {
  return height != nullptr && columns > 1 && rows > 1 && columns <= kMostSide &&
         rows <= kMostSide && std::isfinite(base_m) && machine_m.allFinite() && step_m > 0.0 &&
         std::isfinite(step_m) && std::abs(std::hypot(cosine, sine) - 1.0) < kSurfaceTurnOff;
}

}  // namespace graben
