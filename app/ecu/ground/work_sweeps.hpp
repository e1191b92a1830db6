// SPDX-License-Identifier: Apache-2.0
#pragma once
/// When an excavator's edge was at work, by the force on its teeth.
///
/// Ground holds back an edge that is drawn through it, level and against its way; a load that pours
/// out, or that is misjudged, only weighs. So the edge was at work in a sweep, a way inwards or
/// outwards in one go, in which the level force against the way was beyond what it may be off for
/// as long as kStrong_s; from the first to the last moment of the sweep at which it was felt at
/// all. A cut that is lighter is not known by itself (CellGrid::add knows where it goes under
/// ground that is known).

#include <cstddef>
#include <functional>
#include <vector>

#include "app/ecu/ground/edge_place.hpp"

namespace graben::ground {

/// That much for each metre of the edge, N/m, inwards: more than was told in the air of machines as
/// found. Outwards a bucket is opened: a load that pours out showed up to 6 kN/m level.
inline constexpr double kStrong_npm = 5e3;
inline constexpr double kStrongOutwards_npm = 1e4;
/// And so many deviations.
inline constexpr double kStrong_deviations = 2.0;
inline constexpr double kStrong_s = 0.15;  ///< Two frames.
/// Felt at all.
inline constexpr double kFelt_deviations = 1.5;
/// Slower it neither goes inwards nor outwards; for so long the sweep goes on.
inline constexpr double kSweep_mps = 0.03;
inline constexpr double kPause_s = 0.5;

/// Steps of a sweep that are kept; of one that takes longer two become one, the oldest first, so
/// that it stays whole: 20 s as they came, minutes in steps of some hundredths of a second.
inline constexpr std::size_t kMostSteps = 2048;

class WorkSweeps {
 public:
  using Take = std::function<void(const EdgeStep&)>;
  /// `take` gets the steps, in their order, with `to.at_work` as it was found.
  /// Allocates here, and nowhere else.
  explicit WorkSweeps(const Take& take) : take_(take) { step_.reserve(kMostSteps); }

  void add(const EdgeStep& step);
  /// Where the edge's way is interrupted, and after the last step.
  void end();

 private:
  void make_room();

  const Take& take_;
  std::vector<EdgeStep> step_;  ///< Of the sweep that goes on.
  double way_ = 0.0;            ///< +1 outwards, -1 inwards; 0: not known yet.
  double speed_mps_ = 0.0;      ///< Outwards, smoothed.
  double before_s_ = 0.0;
  double went_s_ = 0.0;  ///< When it went last.
  bool any_ = false;
};

}  // namespace graben::ground
