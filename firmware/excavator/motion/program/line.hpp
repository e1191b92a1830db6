// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A straight line of the bucket's teeth in space, by the share of it that is done; and the walk
/// along it that finds where the machine can't follow.

#include "firmware/excavator/kinematics/swing_kinematics.hpp"

namespace graben {

/// Position and attitude linear in the share (0 .. 1). Evaluated where it is wanted, never stored
/// point by point.
struct TeethLine {
  TeethPose from;
  TeethPose change;  ///< To the line's end.

  [[nodiscard]] TeethPose at(double share) const;
};

/// The attitudes are taken in the turn that the machine has them in, so that a line of the bucket
/// does not go round by a full turn because its ends are written so.
[[nodiscard]] TeethLine line_between(const SwingKinematics& kinematics, const TeethPose& from,
                                     const TeethPose& to);

/// From the straight line through both ends, m, ground frame; from its place where the line only
/// turns the bucket.
[[nodiscard]] double line_distance_m(const TeethLine& line, const Eigen::Vector3d& teeth_m);

/// How far the teeth go, or the bucket pin about them, whichever is more, m: what speed and
/// acceleration of a plan are measured on.
[[nodiscard]] double way_m(const SwingKinematics& kinematics, const TeethLine& line);

/// Drives at this share of the line, with their derivatives by the share.
[[nodiscard]] DriveMotion line_motion(const SwingKinematics& kinematics, const TeethLine& line,
                                      double share);

/// The first place of a line where the machine can't be.
struct BlindPlace {
  BlindSpot blind;     ///< kNone: there is none.
  double share = 0.0;  ///< To 1e-12 where it begins.
  TeethPose teeth;
};

/// Intervals that a line or a step is walked in. [-; size: of the walk]
inline constexpr int kWalkSteps = 128;
/// Halvings of an interval. [-; size: 1 / 128 / 2^40 of the way is the last digit]
inline constexpr int kWalkHalvings = 40;

/// Walks the line in kWalkSteps steps, and looks between them wherever a stroke turns and where the
/// teeth pass the swing axis, so that no range is left for less than a step either. A constant
/// bound on the number of poses: at most some 20000, typically 150.
[[nodiscard]] BlindPlace first_blind_place(const SwingKinematics& kinematics,
                                           const TeethLine& line);

}  // namespace graben
