// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the machine must not pass: a ceiling, a floor, a wall, a design surface; and what it must
/// not touch: boxes and upright cylinders. All in the ground frame of swing_kinematics.hpp.

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/fences/design_surface.hpp"
#include "firmware/excavator/fences/machine_points.hpp"

namespace graben {

enum class FenceGuard : std::uint8_t {
  kTeeth = 0,    ///< The edge alone: a design surface, which the arm may hang over or reach below.
  kMachine = 1,  ///< All of the machine.
};

enum class FenceShape : std::uint8_t {
  kPlane = 0,     ///< A half space is left to the machine.
  kBox = 1,       ///< Upright, turned about the vertical.
  kCylinder = 2,  ///< Upright.
  kSurface = 3,   ///< Heights on a grid: what is over them is left to the teeth.
};

/// A half space that is left to the machine: normal . p <= offset; or a box or a cylinder that is
/// kept out of; or a design surface, which holds nothing beyond its border.
struct Fence {
  /// Of length 1. Of a plane: out of what is left. Of a box: level, along its first side.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset_m = 0.0;  ///< Of a plane.
  FenceGuard guard = FenceGuard::kMachine;
  FenceShape shape = FenceShape::kPlane;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< Of a box or cylinder.
  /// Half of a box's sides, the last its height; the radius of a cylinder (both) and half its
  /// height.
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();
  /// Of kSurface; the owner's, who keeps it as long as anything has this fence. Aligned so that a
  /// fence lies alike where pointers are of 4 bytes: a setup is written as bytes.
  alignas(8) const DesignSurface* surface = nullptr;

  [[nodiscard]] bool is_design() const { return guard == FenceGuard::kTeeth; }
  [[nodiscard]] bool is_surface() const { return shape == FenceShape::kSurface; }
  [[nodiscard]] bool is_plane() const { return shape == FenceShape::kPlane; }
};

/// Most fences of a task, its design surface among them. [-; size: of FenceSet]
inline constexpr int kFenceMost = 8;

struct FenceSet {
  std::array<Fence, kFenceMost> fence;
  int count = 0;
};

/// Where the machine stands in the frame in which its task's design is given: turned to the left
/// against that by `turn_rad`, with its ground frame's origin at `origin_m` there.
struct FrameShift {
  /// A direction of the machine's swing is so much farther to the left than in that frame.
  double turn_rad = 0.0;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
};

/// Fences that hold now; set and shift have to outlive it.
struct FenceView {
  FenceView() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a set is one as it is.
  FenceView(const FenceSet& fences) : set(&fences), count(fences.count) {}

  const FenceSet* set = nullptr;  ///< Null: there are none.
  int count = 0;
  const FrameShift* shift = nullptr;  ///< Of the design; null: it lies as it is given.

  [[nodiscard]] const Fence& at(int number) const {
    return set->fence[static_cast<unsigned>(number)];
  }
};

/// Something of the machine before a fence.
struct FenceGap {
  double distance_m = 0.0;   ///< Negative: beyond it.
  double closing_mps = 0.0;  ///< Positive: towards it.
  MachinePoint point = MachinePoint::kTeeth;
};

/// A point before a plane.
[[nodiscard]] inline FenceGap fence_gap(const Fence& plane, const PointMotion& point) {
  return {plane.offset_m - plane.normal.dot(point.position_m),
          plane.normal.dot(point.velocity_mps)};
}

/// Most of gap_count(), of any fence. [-; derived: all points but the middle of the edge, which is
/// between its corners]
inline constexpr int kGapMost = kMachinePointCount - 1;

/// Gaps that have to be looked at between the machine and a fence, each by itself: of a plane those
/// of its points, of a design those of the edge's corners, of a surface also that of its middle,
/// of a keep-out those of the machine's parts (keep_out.hpp).
[[nodiscard]] int gap_count(const Fence& fence, const ExcavatorBody& body);

/// One of them, from 0. Exact for a plane; of a surface the distance to the plane that touches it
/// under the point, kNoSurface_m where it has no height; of a keep-out never more than the distance
/// is, 0 where they touch, and whatever is beyond `far_m` may be told as that much.
[[nodiscard]] FenceGap fence_gap(const Fence& fence, const ExcavatorBody& body,
                                 const MachineMotion& motion, int gap, double far_m);

/// The fence of a surface.
[[nodiscard]] inline Fence surface_fence(const DesignSurface& surface) {
  Fence fence;
  fence.guard = FenceGuard::kTeeth;
  fence.shape = FenceShape::kSurface;
  fence.surface = &surface;
  return fence;
}

/// A plane that is to be made: no digging below it.
struct DesignPlane {
  Eigen::Vector3d through_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Of length 1, out of the ground.
  double clearance_m = 0.0;  ///< What planned digging keeps above it, along `up`.

  [[nodiscard]] double height_m(const Eigen::Vector3d& position_m) const {
    return up.dot(position_m - through_m);
  }
  [[nodiscard]] Fence fence() const {
    Fence fence;
    fence.normal = -up;
    fence.offset_m = -up.dot(through_m);
    fence.guard = FenceGuard::kTeeth;
    return fence;
  }
};

}  // namespace graben
