// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/load/assumed_load.hpp"

#include <algorithm>

#include "firmware/excavator/estimation/load/link_moments.hpp"

namespace graben {

std::array<LoadState, kDriveCount> links_alone(const ExcavatorProfile& profile,
                                               const KinematicState& now) {
  std::array<LoadState, kDriveCount> load{};
  if (!profile.oil.known() || now.status != ReachStatus::kOk) {
    return load;
  }
  const LinkPlaces at = link_places(profile.oil, profile.geometry, now.joints_rad);
  const Eigen::Vector3d moment_nm = holding_moments(profile.oil, at).of_link.rowwise().sum();
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    // The attitude turns with each joint: its row of the Jacobian is the joints' turn per stroke.
    const double push_n = moment_nm[axis] * now.jacobian(2, axis);
    const CylinderGeometry& cylinder = profile.geometry.cylinder[axis];
    load[axis] = {std::max(0.0, push_n) / cylinder.cap_area_m2(),
                  std::max(0.0, -push_n) / cylinder.rod_area_m2()};
  }
  return load;
}

std::array<LoadState, kDriveCount> worst_loads(const ExcavatorProfile& profile, DriveRows drives,
                                               const std::array<LoadState, kDriveCount>& likely,
                                               const DriveVector& wanted_mps) {
  std::array<LoadState, kDriveCount> load = likely;
  for (int i = 0; i < drives.count(); ++i) {
    LoadState& drive = load[static_cast<unsigned>(i)];
    const double worst_pa = profile.bus.worst_load_ratio * drives[i].watch.relief_pa;
    if (wanted_mps[i] > 0.0) {
      drive = {std::max(drive.cap_pa, worst_pa), 0.0};
    } else if (wanted_mps[i] < 0.0) {
      drive = {0.0, std::max(drive.rod_pa, worst_pa)};
    }
  }
  return load;
}

}  // namespace graben
