// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/fences/design_surface.hpp"

#include <algorithm>
#include <cmath>

namespace graben {

bool DesignSurface::cell_at(double x_m, double y_m, Cell& cell) const {
  const double per_m = 1.0 / step_m;
  cell.u = per_m * (machine_m.x() + cosine * x_m - sine * y_m);
  cell.v = per_m * (machine_m.y() + sine * x_m + cosine * y_m);
  // Written so that what is not a number is beyond the border.
  if (!(cell.u >= 0.0 && cell.v >= 0.0 && cell.u < columns - 1 && cell.v < rows - 1)) {
    return false;
  }
  const int column = static_cast<int>(cell.u);
  const int row = static_cast<int>(cell.v);
  const std::int16_t* const near = height + row * columns + column;
  cell.near = near[0];
  cell.near_next = near[1];
  cell.far = near[columns];
  cell.far_next = near[columns + 1];
  cell.u -= column;
  cell.v -= row;
  return cell.near != kNone && cell.near_next != kNone && cell.far != kNone &&
         cell.far_next != kNone;
}

bool DesignSurface::height_at(double x_m, double y_m, double& height_m) const {
  Cell cell;  // NOLINT(cppcoreguidelines-pro-type-member-init): cell_at() fills it.
  if (!cell_at(x_m, y_m, cell)) {
    return false;
  }
  height_m = base_m + kUnit_m * cell.height();
  return true;
}

SurfacePlace DesignSurface::at(const Eigen::Vector2d& place_m) const {
  SurfacePlace result;
  Cell cell;  // NOLINT(cppcoreguidelines-pro-type-member-init): cell_at() fills it.
  result.known = cell_at(place_m.x(), place_m.y(), cell);
  if (result.known) {
    result.height_m = base_m + kUnit_m * cell.height();
    const int rise_near = cell.near_next - cell.near;
    const int rise_far = cell.far_next - cell.far;
    const int twist = rise_far - rise_near;
    const double along = kUnit_m / step_m * (rise_near + cell.v * twist);
    const double across = kUnit_m / step_m * (cell.far - cell.near + cell.u * twist);
    result.slope = {cosine * along + sine * across, cosine * across - sine * along};
  }
  return result;
}

SurfaceContact DesignSurface::ahead(const PointMotion& point, double zero_m) const {
  SurfaceContact contact;
  const double step_s = kSurfaceAhead_s / kSurfaceAheadSteps;
  const double x_m = point.position_m.x();
  const double y_m = point.position_m.y();
  const double z_m = point.position_m.z() - zero_m;
  double height_m = 0.0;
  if (!height_at(x_m, y_m, height_m)) {
    return contact;
  }
  double before_m = z_m - height_m;
  const double free_m = std::min(0.0, before_m) - kSurfaceDeeper_m;
  for (int i = 1; i <= kSurfaceAheadSteps; ++i) {
    const double time_s = step_s * i;
    const double then_x_m = x_m + time_s * point.velocity_mps.x();
    const double then_y_m = y_m + time_s * point.velocity_mps.y();
    if (!height_at(then_x_m, then_y_m, height_m)) {
      return contact;
    }
    const double over_m = z_m + time_s * point.velocity_mps.z() - height_m;
    if (over_m < free_m) {
      const double share = (before_m - free_m) / (before_m - over_m);
      contact = {true, time_s - (1.0 - share) * step_s, at({then_x_m, then_y_m}).up()};
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
