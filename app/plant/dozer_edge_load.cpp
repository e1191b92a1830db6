// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_edge_load.hpp"

#include <Eigen/Geometry>

namespace graben::plant {

std::array<double, kEdgeStrips> strip_shares(const EdgePlaces& places, double half_width_m) {
  std::array<double, kEdgeStrips> share{};
  double from_m = half_width_m;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].reached) {
      continue;
    }
    std::size_t next = i + 1;
    while (next < places.size() && !places[next].reached) {
      ++next;
    }
    const double to_m =
        next < places.size() ? 0.5 * (places[i].along_m + places[next].along_m) : -half_width_m;
    share[i] = (from_m - to_m) / (2.0 * half_width_m);
    from_m = to_m;
  }
  return share;
}

void add_strip(const EdgeStand& stand, const Eigen::Vector3d& at_m, const Eigen::Vector2d& force_n,
               EdgeLoad& load) {
  const Eigen::Vector3d force{force_n.x(), 0.0, force_n.y()};
  load.force_n += force_n;
  load.tilt_nm += (at_m - stand.edge_middle_m).cross(force).dot(stand.blade_axis);
  // Nose or blade up is a turn about the axis to the right.
  load.lift_nm -= (at_m - stand.pivot_m).cross(force).dot(stand.lift_axis);
  const Eigen::Vector3d about_centre = (at_m - stand.mass_centre_m).cross(force);
  load.pitch_nm -= about_centre.y();
  load.roll_nm += about_centre.dot(stand.body_axis);
  load.yaw_nm += about_centre.z();
}

}  // namespace graben::plant
