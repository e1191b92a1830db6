// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/fences/fence.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/fences/keep_out.hpp"
#include "firmware/excavator/fences/tuning.hpp"

namespace graben {
namespace {

/// Those of the edge first, those of the counterweight last.
constexpr std::array<MachinePoint, kGapMost> kGuarded = {
    MachinePoint::kEdgeLeft,  MachinePoint::kEdgeRight, MachinePoint::kHeelLeft,
    MachinePoint::kHeelRight, MachinePoint::kPinLeft,   MachinePoint::kPinRight,
    MachinePoint::kBucketPin, MachinePoint::kArmPin,    MachinePoint::kBoomBend,
    MachinePoint::kBoomFoot,  MachinePoint::kTailLeft,  MachinePoint::kTailRight};
/// Corners of the bucket's edge in kGuarded. [-; size: left and right]
constexpr int kEdgeCorners = 2;
/// Places of the edge before a surface: its corners and its middle, over which a ridge may stand.
/// [-; size: left, right and middle]
constexpr int kEdgePlaces = 3;
/// Corners of the counterweight in kGuarded. [-; size: left and right]
constexpr int kTailCorners = 2;

/// Of what is round a point.
double radius_m(const ExcavatorBody& body, MachinePoint point) {
  switch (point) {
    case MachinePoint::kBucketPin:
      return body.arm_radius_m;
    case MachinePoint::kArmPin:
      return std::max(body.arm_radius_m, body.boom_radius_m);
    case MachinePoint::kBoomBend:
    case MachinePoint::kBoomFoot:
      return body.boom_radius_m;
    case MachinePoint::kTailLeft:
    case MachinePoint::kTailRight:
      return body.counterweight.corner_m;
    default:
      return 0.0;
  }
}

FenceGap surface_gap(const DesignSurface& surface, const MachineMotion& motion, int gap) {
  FenceGap result;
  result.point = gap < kEdgeCorners ? kGuarded[static_cast<unsigned>(gap)] : MachinePoint::kTeeth;
  const PointMotion& point = motion.at(result.point);
  const SurfacePlace under = surface.at(point.position_m.head<2>());
  result.distance_m = kNoSurface_m;
  if (under.known) {
    const Eigen::Vector3d up = under.up();
    result.distance_m = up.z() * (point.position_m.z() - under.height_m);
    result.closing_mps = -up.dot(point.velocity_mps);
  }
  return result;
}

bool is_wall(const Fence& plane) { return std::abs(plane.normal.z()) < kWallUprightMost; }

}  // namespace

int gap_count(const Fence& fence, const ExcavatorBody& body) {
  if (fence.guard == FenceGuard::kTeeth) {
    return fence.is_surface() ? kEdgePlaces : kEdgeCorners;
  }
  const bool has_tail = body.counterweight.known();
  if (!fence.is_plane()) {
    return has_tail ? kMachinePartCount : kMachinePartCount - 1;
  }
  return has_tail && is_wall(fence) ? kGapMost : kGapMost - kTailCorners;
}

FenceGap fence_gap(const Fence& fence, const ExcavatorBody& body, const MachineMotion& motion,
                   int gap, double far_m) {
  if (fence.is_surface()) {
    return surface_gap(*fence.surface, motion, gap);
  }
  if (!fence.is_plane()) {
    return keep_out_gap(fence, body, motion, static_cast<MachinePart>(gap), far_m);
  }
  const MachinePoint point = kGuarded[static_cast<unsigned>(gap)];
  FenceGap result = fence_gap(fence, motion.at(point));
  result.distance_m -= radius_m(body, point);
  result.point = point;
  return result;
}

}  // namespace graben
