#include "firmware/excavator/tasks/fence.hpp"

#include <cmath>

namespace graben {

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
  const double along_x = std::cos(drive[kSwing]);
  const double along_y = std::sin(drive[kSwing]);
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
    const double across_mps = at_m.x() * velocity[kSwing];
    motion.point[static_cast<unsigned>(kEnd[i])] = {
        {at_m.x() * along_x, at_m.x() * along_y, at_m.y()},
        {moves_mps.x() * along_x - across_mps * along_y,
         moves_mps.x() * along_y + across_mps * along_x, moves_mps.y()}};
  }
  return motion;
}

}  // namespace graben
