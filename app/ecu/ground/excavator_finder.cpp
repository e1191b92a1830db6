// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "app/ecu/ground/edge_finder.hpp"
#include "firmware/excavator/fences/machine_points.hpp"
#include "firmware/excavator/inputs/measured_joints.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben::ground {

std::optional<EdgePlace> ExcavatorFinder::look(const ExcavatorInputs& inputs, TimeUs now_us) {
  const ExcavatorProfile& profile = setup_.profile;
  const DriveRows drives = setup_.bank.rows();
  // As at rest: what moves the machine by hand is believed too.
  constexpr bool kMoving = false;
  const ExcavatorValid valid =
      by_angles() ? validate(profile, drives, inputs, kMoving, now_us, accepted_, strokes(inputs))
                  : validate(profile, drives, inputs, kMoving, now_us, accepted_);
  const auto known = [](const ValidDrive& drive) { return drive.stroke_known; };
  if (!std::all_of(valid.drive.begin(), valid.drive.begin() + drives.count(), known)) {
    return std::nullopt;
  }
  const MachineMotion motion =
      machine_motion(setup_.kinematics, drives_of(profile, valid.strokes_m()), DriveVector::Zero());
  if (motion.status != ReachStatus::kOk) {
    return std::nullopt;
  }
  EdgePlace place;
  place.left_m = motion.at(MachinePoint::kEdgeLeft).position_m;
  place.right_m = motion.at(MachinePoint::kEdgeRight).position_m;
  place.outwards_m = motion.at(MachinePoint::kTeeth).position_m.head<2>().norm();
  return place;
}

/// By whatever the machine measures: IMUs, or angles of its joints.
const std::array<Signal<double>, kAxisCount>& ExcavatorFinder::strokes(
    const ExcavatorInputs& inputs) {
  const ExcavatorKinematics& kinematics = setup_.kinematics.planar();
  if (setup_.profile.imu.known()) {
    constexpr double kPeriod_s = 1e-6 * static_cast<double>(kPeriod_us);
    strokes_m_ =
        next_imu_strokes(kinematics, setup_.profile.imu, inputs, is_still(inputs), kPeriod_s, imus_)
            .stroke_m;
  } else {
    strokes_m_ = strokes_of_joints(kinematics, inputs.joint_rad);
  }
  return strokes_m_;
}

/// All spools are measured, and closed.
bool ExcavatorFinder::is_still(const ExcavatorInputs& inputs) const {
  const double most = setup_.profile.safety.spool_tolerance;
  return std::all_of(inputs.axis.begin(), inputs.axis.end(), [most](const AxisInputs& axis) {
    return axis.spool_ratio.validity == Validity::kValid &&
           std::abs(axis.spool_ratio.value) <= most;
  });
}

}  // namespace graben::ground
