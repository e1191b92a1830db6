// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/fences/machine_points.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

Eigen::Vector2d direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

Eigen::Vector2d turned(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// A link's pin, in the plane of the links: x from the swing axis, y above the ground.
struct Pin {
  Eigen::Vector2d at_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d moves_mps = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< The link that hangs there, length 1.
  double turning_radps = 0.0;                        ///< Of that link.
  double unsure_rad = 0.0;                           ///< Of the joint there.
};

class Outline {
 public:
  Outline(const SwingKinematics& kinematics, const KinematicState& state, const DriveVector& drive,
          const DriveVector& velocity, const DriveVector& unsure)
      : ahead_(direction(swing_of(drive))),
        swing_radps_(swing_of(velocity)),
        swing_unsure_rad_(swing_of(unsure)) {
    const ExcavatorGeometry& geometry = kinematics.geometry();
    const std::array<double, kAxisCount> length_m = {geometry.boom_length_m, geometry.arm_length_m,
                                                     geometry.bucket_length_m};
    pin_[0].at_m = geometry.boom_foot_m;
    double angle_rad = 0.0;
    double turning_radps = 0.0;
    for (unsigned i = 0; i < kAxisCount; ++i) {
      angle_rad += state.joints_rad[i];
      // The attitude is the sum of the joints: its row of the Jacobian holds each joint's own rate.
      turning_radps += state.jacobian(2, i) * velocity[i];
      pin_[i].along = direction(angle_rad);
      pin_[i].turning_radps = turning_radps;
      pin_[i].unsure_rad = std::abs(state.jacobian(2, i)) * unsure[i];
      const Eigen::Vector2d link_m = length_m[i] * pin_[i].along;
      pin_[i + 1].at_m = pin_[i].at_m + link_m;
      pin_[i + 1].moves_mps = pin_[i].moves_mps + turning_radps * turned(link_m);
    }
  }

  /// A point of a link, in its frame, and to the left of the links' plane.
  [[nodiscard]] PointMotion on(unsigned link, const Eigen::Vector2d& in_link_m,
                               double left_m) const {
    const Pin& pin = pin_[link];
    const Eigen::Vector2d off_m = in_link_m.x() * pin.along + in_link_m.y() * turned(pin.along);
    const Eigen::Vector2d at_m = pin.at_m + off_m;
    double unsure_m = 0.0;
    for (unsigned i = 0; i <= link; ++i) {
      unsure_m += pin_[i].unsure_rad * (at_m - pin_[i].at_m).norm();
    }
    return in_ground(at_m, pin.moves_mps + pin.turning_radps * turned(off_m), left_m, unsure_m);
  }
  /// A point of the platform.
  [[nodiscard]] PointMotion on_platform(const Eigen::Vector2d& at_m, double left_m) const {
    return in_ground(at_m, Eigen::Vector2d::Zero(), left_m, 0.0);
  }
  [[nodiscard]] Eigen::Vector3d left() const { return {-ahead_.y(), ahead_.x(), 0.0}; }

 private:
  [[nodiscard]] PointMotion in_ground(const Eigen::Vector2d& at_m, const Eigen::Vector2d& moves_mps,
                                      double left_m, double unsure_m) const {
    const Eigen::Vector2d level_m = at_m.x() * ahead_ + left_m * turned(ahead_);
    const Eigen::Vector2d level_mps = moves_mps.x() * ahead_ + swing_radps_ * turned(level_m);
    return {{level_m.x(), level_m.y(), at_m.y()},
            {level_mps.x(), level_mps.y(), moves_mps.y()},
            unsure_m + swing_unsure_rad_ * level_m.norm()};
  }

  Eigen::Vector2d ahead_;
  double swing_radps_;
  double swing_unsure_rad_;
  std::array<Pin, kAxisCount + 1> pin_;
};

/// Of the counterweight: to the rear of the swing axis, and to the left of the machine's plane.
Eigen::Vector2d corner_m(const Counterweight& weight) {
  const double left_m = weight.half_width_m - weight.corner_m;
  const double from_axis_m = weight.radius_m - weight.corner_m;
  return {-std::sqrt(std::max(0.0, from_axis_m * from_axis_m - left_m * left_m)), left_m};
}

}  // namespace

MachineMotion machine_motion(const SwingKinematics& kinematics, const DriveVector& drive,
                             const DriveVector& velocity, const DriveVector& unsure) {
  MachineMotion motion;
  const KinematicState state = kinematics.planar().state(drive.head<3>());
  motion.status = state.status;
  if (state.status != ReachStatus::kOk) {
    return motion;
  }
  const Outline outline(kinematics, state, drive, velocity, unsure);
  const ExcavatorGeometry& geometry = kinematics.geometry();
  const ExcavatorBody& body = geometry.body;
  const auto set = [&motion](MachinePoint which, const PointMotion& point) {
    motion.point[static_cast<unsigned>(which)] = point;
  };
  motion.left = outline.left();
  set(MachinePoint::kBoomFoot, outline.on(kBoom, Eigen::Vector2d::Zero(), 0.0));
  set(MachinePoint::kBoomBend, outline.on(kBoom, body.boom_bend_m, 0.0));
  set(MachinePoint::kArmPin, outline.on(kArm, Eigen::Vector2d::Zero(), 0.0));
  set(MachinePoint::kBucketPin, outline.on(kBucket, Eigen::Vector2d::Zero(), 0.0));
  const Eigen::Vector2d teeth_m(geometry.bucket_length_m, 0.0);
  const Eigen::Vector2d heel_m =
      teeth_m + body.floor_m * Eigen::Vector2d(-std::cos(body.floor_rad), std::sin(body.floor_rad));
  const double half_m = 0.5 * body.bucket_width_m;
  set(MachinePoint::kTeeth, outline.on(kBucket, teeth_m, 0.0));
  set(MachinePoint::kEdgeLeft, outline.on(kBucket, teeth_m, half_m));
  set(MachinePoint::kEdgeRight, outline.on(kBucket, teeth_m, -half_m));
  set(MachinePoint::kPinLeft, outline.on(kBucket, Eigen::Vector2d::Zero(), half_m));
  set(MachinePoint::kPinRight, outline.on(kBucket, Eigen::Vector2d::Zero(), -half_m));
  set(MachinePoint::kHeelLeft, outline.on(kBucket, heel_m, half_m));
  set(MachinePoint::kHeelRight, outline.on(kBucket, heel_m, -half_m));
  const Eigen::Vector2d corner = corner_m(body.counterweight);
  const Eigen::Vector2d tail_m(corner.x(), body.counterweight.low_m);
  set(MachinePoint::kTailLeft, outline.on_platform(tail_m, corner.y()));
  set(MachinePoint::kTailRight, outline.on_platform(tail_m, -corner.y()));
  return motion;
}

}  // namespace graben
