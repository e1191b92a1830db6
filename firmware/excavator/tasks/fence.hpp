#pragma once
/// Planes that points of the machine must not pass: a ceiling, a floor, a wall, a design surface.
/// All in the ground frame of swing_kinematics.hpp.

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "firmware/drives/velocity_cap.hpp"
#include "firmware/excavator/kinematics/swing_kinematics.hpp"

namespace graben {

/// Points of the machine that fences guard.
enum class MachinePoint : std::uint8_t {
  kTeeth = 0,
  kBucketPin = 1,
  kArmPin = 2,  ///< Boom's end, where the arm hangs.
};

inline constexpr int kMachinePointCount = 3;

enum class FenceGuard : std::uint8_t {
  kTeeth = 0,    ///< The teeth alone: a design surface, which the arm may hang over or reach below.
  kMachine = 1,  ///< Every MachinePoint.
};

/// A half space that is left to the machine: normal . p <= offset.
struct Fence {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< Of length 1, out of what is left.
  double offset_m = 0.0;
  FenceGuard guard = FenceGuard::kMachine;

  /// How many of the points, in their order, it holds for.
  [[nodiscard]] int guarded() const { return guard == FenceGuard::kTeeth ? 1 : kMachinePointCount; }
};

inline constexpr int kFenceMost = 8;

struct FenceSet {
  std::array<Fence, kFenceMost> fence;
  int count = 0;
};

struct PointMotion {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
};

/// All points that are looked at, by MachinePoint.
struct MachineMotion {
  ReachStatus status = ReachStatus::kNotFinite;  ///< Anything but kOk: nothing else is set.
  std::array<PointMotion, kMachinePointCount> point;
};

/// Where the points are and how they move, from the drives and their velocities (or rates by any
/// parameter). Closed form; strokes up to 1 um outside their range.
[[nodiscard]] MachineMotion machine_motion(const SwingKinematics& kinematics,
                                           const DriveVector& drive, const DriveVector& velocity);

/// A point before a fence.
struct FenceGap {
  double distance_m = 0.0;   ///< Negative: beyond it.
  double closing_mps = 0.0;  ///< Positive: towards it.
};

[[nodiscard]] inline FenceGap fence_gap(const Fence& fence, const PointMotion& point) {
  return {fence.offset_m - fence.normal.dot(point.position_m),
          fence.normal.dot(point.velocity_mps)};
}

/// A fence stands so far behind what it guards. At the place itself the machine may still close at
/// stroke_end_gain times it, which is what makes sliding along a fence possible, see
/// approach_ends(). A feedback weaker than stroke_end_gain towards a plan that is not beyond the
/// fence is never slowed at all. It is a part of the millimetre by which a limit may be overrun.
inline constexpr double kFenceSlack_m = 0.2e-3;

/// One factor on the whole velocity before the ends of the drives (approach_ends) and before the
/// fences, which a point of the machine is stopped at with line.acceleration_mps2. `then_m` and
/// `velocity_mps` are travels. What is not finite or can't be is 0, and no limit named.
[[nodiscard]] VelocityCap motion_cap(const ExcavatorProfile& profile, DriveRows drives,
                                     const SwingKinematics& kinematics, const FenceSet& fences,
                                     const DriveVector& then_m, const DriveVector& velocity_mps);

/// A surface that is to be made: no digging below it.
struct DesignPlane {
  Eigen::Vector3d through_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Of length 1, out of the ground.
  double clearance_m = 0.0;  ///< What planned digging keeps above it, along `up`.

  [[nodiscard]] double height_m(const Eigen::Vector3d& position_m) const {
    return up.dot(position_m - through_m);
  }
  [[nodiscard]] Fence fence() const { return {-up, -up.dot(through_m), FenceGuard::kTeeth}; }
};

}  // namespace graben
