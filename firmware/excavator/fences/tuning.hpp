// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about fences: each was chosen.

namespace graben {

// Planes (fence.cpp)

/// Vertical part of a plane's normal below which it is a wall, which the counterweight may hit; on
/// what is flatter the machine stands. [-; chosen: steeper than 60 deg; not tried]
inline constexpr double kWallUprightMost = 0.5;

// Boxes and cylinders (keep_out.cpp)

/// Squared length of an axis below which it has no direction: its edges are parallel. [-; chosen:
/// far above rounding; not tried]
inline constexpr double kNoAxisSquared = 1e-12;
/// Corners of a part that are no farther from a keep-out than its nearest by this count as nearest
/// too: an edge or a face is. [m; chosen: not tried]
inline constexpr double kAsNearCorner_m = 1e-3;

}  // namespace graben
