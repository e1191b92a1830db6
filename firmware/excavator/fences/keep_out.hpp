// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far the machine's parts are from a box or an upright cylinder that it must not touch.

#include "firmware/excavator/fences/fence.hpp"

namespace graben {

/// Parts of the machine, each convex. The counterweight comes last: not every profile has one.
enum class MachinePart : std::uint8_t {
  kBucketPart = 0,    ///< Prism over edge, heel and pin, as wide as the edge.
  kArmPart = 1,       ///< Line of its pins, with its radius.
  kBoomFootPart = 2,  ///< Line from the boom's foot to its bend, with its radius,
  kBoomEndPart = 3,   ///< and from there to the arm's pin.
  kTailPart = 4,      ///< The counterweight.
};

/// Parts of the machine. [-; derived: number of MachinePart's values]
inline constexpr int kMachinePartCount = 5;

/// The widest gap that a plane between both shows, less the part's radius: never more than the
/// distance is. The planes that are tried are those of the separating axis theorem, faces of both
/// and across an edge of each, and from where an edge of the part is nearest: all that can be the
/// widest before a box. A cylinder's rim is met by a face up to some millimetres early. It closes
/// as fast as the part's point nearest to that plane. Of what is farther than `far_m` any distance
/// beyond that may be told.
[[nodiscard]] FenceGap keep_out_gap(const Fence& keep_out, const ExcavatorBody& body,
                                    const MachineMotion& motion, MachinePart part, double far_m);

}  // namespace graben
