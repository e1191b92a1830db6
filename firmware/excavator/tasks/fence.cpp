#include "firmware/excavator/tasks/fence.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

DriveVector inside_stops(DriveRows drives, DriveVector travel_m) {
  for (int i = 0; i < drives.count(); ++i) {
    if (drives[i].control.has_end_stops) {
      travel_m[i] = std::clamp(travel_m[i], drives[i].least_travel_m, drives[i].most_travel_m);
    }
  }
  return travel_m;
}

}  // namespace

MachineMotion machine_motion(const SwingKinematics& kinematics, const DriveVector& drive,
                             const DriveVector& velocity) {
  MachineMotion motion;
  const KinematicState state = kinematics.planar().state(drive.head<3>());
  motion.status = state.status;
  if (state.status != ReachStatus::kOk) {
    return motion;
  }
  const ExcavatorGeometry& geometry = kinematics.geometry();
  const std::array<double, kAxisCount> length_m = {geometry.boom_length_m, geometry.arm_length_m,
                                                   geometry.bucket_length_m};
  constexpr std::array<MachinePoint, kAxisCount> kEnd = {
      MachinePoint::kArmPin, MachinePoint::kBucketPin, MachinePoint::kTeeth};
  const double along_x = std::cos(swing_of(drive));
  const double along_y = std::sin(swing_of(drive));
  // In the plane of the links: from the swing axis, and above the ground.
  Eigen::Vector2d at_m = geometry.boom_foot_m;
  Eigen::Vector2d moves_mps = Eigen::Vector2d::Zero();
  double direction_rad = 0.0;
  double turning_radps = 0.0;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    direction_rad += state.joints_rad[i];
    // The attitude is the sum of the joints: its row of the Jacobian holds each joint's own rate.
    turning_radps += state.jacobian(2, i) * velocity[i];
    const Eigen::Vector2d link_m(length_m[i] * std::cos(direction_rad),
                                 length_m[i] * std::sin(direction_rad));
    at_m += link_m;
    moves_mps += turning_radps * Eigen::Vector2d(-link_m.y(), link_m.x());
    const double across_mps = at_m.x() * swing_of(velocity);
    motion.point[static_cast<unsigned>(kEnd[i])] = {
        {at_m.x() * along_x, at_m.x() * along_y, at_m.y()},
        {moves_mps.x() * along_x - across_mps * along_y,
         moves_mps.x() * along_y + across_mps * along_x, moves_mps.y()}};
  }
  return motion;
}

VelocityCap motion_cap(const ExcavatorProfile& profile, DriveRows drives,
                       const SwingKinematics& kinematics, const FenceSet& fences,
                       const DriveVector& then_m, const DriveVector& velocity_mps) {
  if (!then_m.allFinite() || !velocity_mps.allFinite()) {
    return {0.0, {}};
  }
  VelocityCap cap;
  approach_ends(drives, span_of(then_m), span_of(velocity_mps), cap);
  if (fences.count == 0) {
    return cap;
  }
  const MachineMotion motion =
      machine_motion(kinematics, drives_of(profile, inside_stops(drives, then_m)),
                     drives_of(profile, velocity_mps));
  if (motion.status != ReachStatus::kOk) {
    return {0.0, {}};
  }
  for (int i = 0; i < fences.count; ++i) {
    const Fence& fence = fences.fence[static_cast<unsigned>(i)];
    const Limit limit{LimitKind::kFence, static_cast<std::uint8_t>(i)};
    for (int p = 0; p < fence.guarded(); ++p) {
      const FenceGap gap = fence_gap(fence, motion.point[static_cast<unsigned>(p)]);
      approach(profile.control.stroke_end_gain_ps, profile.line.acceleration_mps2,
               gap.distance_m + kFenceSlack_m, gap.closing_mps, limit, cap);
    }
  }
  return cap;
}

}  // namespace graben
