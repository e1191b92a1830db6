#pragma once
/// How far the machine's parts are from a box or an upright cylinder that it must not touch.

#include "firmware/excavator/tasks/fence.hpp"

namespace graben {

/// Parts of the machine, each convex. The counterweight comes last: not every profile has one.
enum class MachinePart : std::uint8_t {
  kBucketPart = 0,  ///< Prism over edge, heel and pin, as wide as the edge.
  kArmPart = 1,     ///< Line of its pins, with its radius.
  kBoomPart = 2,    ///< Triangle of its pins and its bend, with its radius.
  kTailPart = 3,    ///< The counterweight.
};

inline constexpr int kMachinePartCount = 4;

/// The part as wide as the widest gap that a plane between both shows. The planes that are tried
/// are those of the separating axis theorem: faces of both, and across an edge of each. So it is 0
/// where an edge, a corner or a face of the part meets a box; a round side of a part or a cylinder
/// meets corners up to 0.41 of its radius early. It closes as fast as the part's point nearest to
/// that plane. Of what is farther than `far_m` any distance beyond that may be told.
[[nodiscard]] FenceGap keep_out_gap(const Fence& keep_out, const ExcavatorBody& body,
                                    const MachineMotion& motion, MachinePart part, double far_m);

}  // namespace graben
