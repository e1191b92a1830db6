// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Points of the machine's outline: where they are, how they move, and by how much they may be
/// elsewhere than where the sensors have them. In the ground frame of swing_kinematics.hpp.

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "firmware/excavator/kinematics/swing_kinematics.hpp"

namespace graben {

/// Points of the machine that fences guard. Left is where y is, at swing 0.
enum class MachinePoint : std::uint8_t {
  kTeeth = 0,  ///< The middle of the edge.
  kBucketPin = 1,
  kArmPin = 2,    ///< Boom's end, where the arm hangs.
  kEdgeLeft = 3,  ///< Corners of the bucket's edge,
  kEdgeRight = 4,
  kHeelLeft = 5,  ///< and of its heel, where the floor ends.
  kHeelRight = 6,
  kBoomBend = 7,
  kBoomFoot = 8,
  kPinLeft = 9,  ///< Where the bucket's sides end at its pin.
  kPinRight = 10,
  kTailLeft = 11,  ///< Centres of the counterweight's corners, at their lower end.
  kTailRight = 12,
};

/// Points that fences guard. [-; derived: number of MachinePoint's values]
inline constexpr int kMachinePointCount = 13;

struct PointMotion {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  double unsure_m = 0.0;  ///< At most so far from where it is taken to be.
};

/// All points that are looked at, by MachinePoint.
struct MachineMotion {
  ReachStatus status = ReachStatus::kNotFinite;     ///< Anything but kOk: nothing else is set.
  Eigen::Vector3d left = Eigen::Vector3d::UnitY();  ///< Across the machine, of length 1.
  std::array<PointMotion, kMachinePointCount> point;

  [[nodiscard]] const PointMotion& at(MachinePoint which) const {
    return point[static_cast<unsigned>(which)];
  }
};

/// Where the points are and how they move, from the drives and their velocities (or rates by any
/// parameter), of drives that may each be off by `unsure` (0 or more): a point then by the sum of
/// what each does to it. Closed form; strokes up to 1 um outside their range.
[[nodiscard]] MachineMotion machine_motion(const SwingKinematics& kinematics,
                                           const DriveVector& drive, const DriveVector& velocity,
                                           const DriveVector& unsure = DriveVector::Zero());

}  // namespace graben
