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

// Design surfaces (design_surface.cpp)

/// Time for which a corner of the edge is followed ahead on a surface, as it moves now. [s; chosen:
/// at 1 m/s and 1 m/s2 it takes 1 s to stop; not tried]
inline constexpr double kSurfaceAhead_s = 1.0;
/// Places on that way that are looked at. [-; size: 0.33 m apart at 1 m/s]
inline constexpr int kSurfaceAheadSteps = 3;
/// Depth by which what lies ahead counts as deeper than where the corner is. [m; chosen: sensors'
/// noise and rounding of heights; not tried]
inline constexpr double kSurfaceDeeper_m = 2e-3;
/// Distance of what a surface says nothing of: it holds nothing there. [m; chosen: no machine
/// reaches so far; not tried]
inline constexpr double kNoSurface_m = 1e3;
/// Error of the length of a surface's direction, which has to be 1. [-; chosen: rounding; not
/// tried]
inline constexpr double kSurfaceTurnOff = 1e-6;

// Where the machine stands on its site (site_frame.cpp)

/// Distance from where the site or its design has a point up to which a touch agrees. [m; chosen:
/// as site.bound's own value; not tried]
inline constexpr double kSiteBound_m = 0.03;
/// Time in which a turn of the tracks is forgotten. [s; chosen: a gyro's zero off by 0.3 deg/s then
/// makes a turn of 3 deg; not tried]
inline constexpr double kTracksForget_s = 10.0;
/// Turn of the tracks from which on they have moved: 5 deg. [rad; chosen: above that, and above a
/// gyro's scale off by 1 % over half a turn of the swing; not tried]
inline constexpr double kTracksTurned_rad = 0.09;

}  // namespace graben
