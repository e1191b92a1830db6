// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where a machine's cutting edge is, and the way that it goes.

#include <Eigen/Core>

#include "firmware/core/time.hpp"

namespace graben::ground {

/// Ends of the edge in the machine's ground frame, m: an excavator's as swing_kinematics.hpp has
/// it, a dozer's world (dozer_signals.hpp) with y to the left of its track.
struct EdgePlace {
  Eigen::Vector3d left_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d right_m = Eigen::Vector3d::Zero();
  double outwards_m = 0.0;  ///< Of an excavator's teeth from its swing axis.
  /// Level force of the ground on an excavator's teeth, away from the machine, as its controller
  /// knows it, and its standard deviation; both 0: not known.
  double level_n = 0.0;
  double deviation_n = 0.0;
  bool at_work = false;  ///< At the ground; an excavator's: see work_sweeps.hpp.
};

/// Where the edge went from one moment to the next; `from` and `to` are parted by no gap.
struct EdgeStep {
  EdgePlace from;
  EdgePlace to;
  double time_s = 0.0;  ///< Of `to`, s since 1970 by the machine's clock, where it has one.

  /// Of the edge's middle.
  [[nodiscard]] double way_m() const {
    return 0.5 * (to.left_m + to.right_m - from.left_m - from.right_m).norm();
  }
};

inline constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
/// Places farther apart in time are not joined.
inline constexpr TimeUs kGap_us = 200 * kMillisecondUs;
/// Nor in space: no edge goes so far in a cycle.
inline constexpr double kLeap_m = 0.3;

// A dozer's edge is at work where the machine goes ahead as fast as this with its edge no more
// than so much over the line that its tracks stand on.
inline constexpr double kAtWork_mps = 0.05;
inline constexpr double kAtWorkOverTracks_m = 0.15;

}  // namespace graben::ground
