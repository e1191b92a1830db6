// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/inputs/measured_joints.hpp"

#include <algorithm>

#include "firmware/excavator/inputs/tuning.hpp"

namespace graben {
namespace {

/// strokes_from_joints() gives what the joints have, also where that is beyond an end.
bool is_near_range(ReachStatus status) {
  return status == ReachStatus::kOk || status == ReachStatus::kBoomStroke ||
         status == ReachStatus::kArmStroke || status == ReachStatus::kBucketStroke;
}

}  // namespace

std::array<Signal<double>, kAxisCount> strokes_of_joints(
    const ExcavatorKinematics& kinematics,
    const std::array<Signal<double>, kAxisCount>& joints_rad) {
  Signal<double> worst = joints_rad[0];
  Eigen::Vector3d angles_rad = Eigen::Vector3d::Zero();
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    const Signal<double>& joint = joints_rad[axis];
    worst.validity = std::min(worst.validity, joint.validity);
    worst.stamp_us = std::min(worst.stamp_us, joint.stamp_us);
    angles_rad[axis] = joint.value;
  }
  StrokeResult strokes;
  if (worst.validity == Validity::kValid) {
    strokes = kinematics.strokes_from_joints(angles_rad);
    if (!is_near_range(strokes.status)) {
      worst.validity = Validity::kOutOfRange;
    }
  }
  std::array<Signal<double>, kAxisCount> shown;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    const double most_m = kinematics.geometry().cylinder[axis].stroke_m;
    const double kept_m = std::clamp(strokes.strokes_m[axis], 0.0, most_m);
    const double off_m = strokes.strokes_m[axis] - kept_m;
    if (!(off_m <= kBeyondEnd_m && off_m >= -kBeyondEnd_m)) {
      worst.validity = Validity::kOutOfRange;
    }
    shown[axis] = {kept_m, Validity::kValid, worst.stamp_us};
  }
  for (Signal<double>& stroke_m : shown) {
    stroke_m.validity = worst.validity;
  }
  return shown;
}

}  // namespace graben
